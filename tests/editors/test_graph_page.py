"""The page of `graph --format html` in a real browser."""

from __future__ import annotations

import json
import shutil
import subprocess
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest
from lxml import etree
from preflight_analysis.view.graph_page import graph_page
from support import sample_graphs
from support.editor_harness import ROOT

# The browser's driver is installed with VS Code's.
pytestmark = [pytest.mark.editor, pytest.mark.vscode]

HERE = Path(__file__).with_name("vscode")


@pytest.fixture(scope="module")
def seen(tmp_path_factory: pytest.TempPathFactory) -> Mapping[str, Any]:
    """What a reader saw, step by step."""
    chromium = shutil.which("chromium")
    if chromium is None or not (HERE / "node_modules/.installed").exists():
        pytest.fail("run tests/editors/install.sh")
    folder = tmp_path_factory.mktemp("pages")
    pages = {}
    for name, view in {
        "robot": sample_graphs.robot(),
        "hostile": sample_graphs.hostile(),
        "large": sample_graphs.large(150, 600),
    }.items():
        pages[name] = str(folder / f"{name}.html")
        Path(pages[name]).write_text(graph_page(view, "/"), encoding="utf-8")
    given = {"pages": pages, "screenshots": str(ROOT / "out/screenshots"), "browser": chromium}
    done = subprocess.run(
        ["node", str(HERE / "page.mjs"), json.dumps(given)],
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        timeout=400,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    result: Mapping[str, Any] = json.loads(done.stdout)
    return result


def test_nothing_goes_wrong_and_nothing_is_fetched(seen: Mapping[str, Any]) -> None:
    assert seen["wrong"] == []


def test_everything_is_shown_but_what_every_node_has(seen: Mapping[str, Any]) -> None:
    assert seen["all"] == 9 + 19
    assert seen["status"] == "9 nodes, 19 topics, services and actions"
    assert seen["builtin"] == ["topic /rosout"]


def test_the_filter_takes_namespaces_patterns_and_what_is_left_out(seen: Mapping[str, Any]) -> None:
    assert [label for label in seen["filter"]["shown"] if label.startswith("node")] == [
        "node /camera/detector",
        "node /camera/driver",
    ]
    assert "topic /camera/image_raw, hint" in seen["filter"]["shown"]
    assert seen["filter"]["context"] == []
    assert "topic /people, hint" in seen["filter"]["shown"], "what they are connected to"
    assert seen["filter"]["status"] == "2 of 9 nodes, 7 of 19 topics, services and actions"
    assert seen["glob"] == {"shown": ["topic /map"], "context": ["node /planner", "node /slam"]}
    assert [label for label in seen["without"] if "camera" in label or "teleop" in label] == []
    assert "node /base" in seen["without"]
    assert seen["nothing"] == {"shown": [], "marked": 1}
    assert seen["cleared"] == {"value": "", "all": seen["all"]}


def test_the_search_marks_what_fits_and_goes_from_one_to_the_next(seen: Mapping[str, Any]) -> None:
    search = seen["search"]
    assert search["first"] == "1 of 2: topic /scan"
    assert search["marked"] == ["topic /scan, warning", "topic /scann, warning"]
    assert search["all"] == seen["all"], "nothing is hidden"
    assert (search["second"], search["back"]) == ("2 of 2: topic /scann", "1 of 2: topic /scan")
    assert (search["escaped"], search["left"]) == ("topic /scann, warning", 0)


def test_a_namespace_is_a_box_that_folds(seen: Mapping[str, Any]) -> None:
    fold = seen["fold"]
    assert fold["open"] == {"label": "namespace /camera, 2 nodes", "state": "true"}
    assert fold["inside"] == "driver", "the box says where"
    assert (fold["folded"], fold["hidden"]) == ("false", False)
    assert "/camera/detector" in fold["hint"]
    assert fold["unfolded"] == "true"
    assert fold["byAll"] == "true", "the search unfolds what it goes to"


def test_a_neighbourhood_is_shown_alone(seen: Mapping[str, Any]) -> None:
    focus = seen["focus"]
    assert {label for label in focus["shown"] if label.startswith("topic")} == {
        "topic /map",
        "topic /odom, error",
        "topic /scan, warning",
        "topic /tf",
    }
    assert "node /teleop" not in focus["shown"]
    assert "node /laser" in focus["shown"]
    assert focus["button"] == "Only around node /slam ✕"
    assert focus["all"] == seen["all"]


def test_files_have_numbers_too_and_the_legend_folds(seen: Mapping[str, Any]) -> None:
    assert seen["legend"] == {"numbers": ["1", "2", "3"], "onNode": "3", "folded": False, "open": True}


def test_kinds_and_what_is_in_order_can_be_hidden(seen: Mapping[str, Any]) -> None:
    assert seen["kinds"] == []
    assert seen["problems"] == {
        "shown": ["node /recorder, info", "topic /odom, error", "topic /scan, warning", "topic /scann, warning"],
        "context": ["node /base", "node /laser", "node /planner", "node /slam"],
    }


def test_hover_tells_types_qos_and_what_is_wrong(seen: Mapping[str, Any]) -> None:
    for text in (seen["hover"]["topic"], seen["hover"]["edge"]):
        assert "/base publishes" in " ".join(text.split())
        assert "nav_msgs/Odometry" in text
        assert "latch true, queue_size 10" in text
        assert "error TOP003 type mismatch on '/odom'" in text


def test_a_click_shows_all_of_a_node_and_leads_on(seen: Mapping[str, Any]) -> None:
    text = seen["click"]["text"]
    assert "navigation.launch:3" in text
    assert "remapped from scan" in text
    assert "did you mean '/scan'" in text
    assert (seen["click"]["followed"], seen["click"]["focused"]) == ("/map", "topic /map")


def test_the_graph_can_be_walked_by_keyboard(seen: Mapping[str, Any]) -> None:
    assert seen["keyboard"] == {
        "closed": False,
        "right": "service /base/reset",
        "along": "node /base",
        "back": "service /base/reset",
        "down": "topic /scann, warning",
        "opened": "/scann",
        "filter": "filter",
        "escaped": "topic /scann, warning",
    }
    first, second, _ = seen["tab"]
    assert first == "canvas" or first.startswith(("node", "topic", "service", "action"))
    assert not second.startswith(("node", "topic", "service", "action"))


def test_zoom_and_colours(seen: Mapping[str, Any]) -> None:
    assert seen["zoom"] == pytest.approx(1.25)
    assert seen["dark"] == {"dark": "rgb(23, 26, 33)", "light": "rgb(255, 255, 255)"}


def test_what_is_saved_is_a_picture_by_itself(seen: Mapping[str, Any]) -> None:
    assert seen["saved"]["name"] == "graph.svg"
    root = etree.fromstring(seen["saved"]["text"].encode())
    names = {element.get("aria-label") for element in root.iter() if element.get("aria-label")}
    assert "topic /odom, error" in names
    assert "topic /people, hint" not in names, "what the filter hides"
    (style,) = root.iter("{http://www.w3.org/2000/svg}style")
    assert "--paper: #ffffff;" in style.text
    assert "var(--vscode" not in style.text


def test_in_an_editor_clicks_lead_to_lines(seen: Mapping[str, Any]) -> None:
    assert seen["editor"] == [
        ["ready", None, None],
        ["open", "/navigation.launch", 2],
        ["open", "/robot.launch", 3],
        ["open", "/src/base.py", 12],
    ]


def test_what_is_not_so_on_the_running_robot_is_marked(seen: Mapping[str, Any]) -> None:
    live = seen["live"]
    assert live["missing"] == ["node /base", "node /laser"]
    assert live["wrong"] == ["topic /odom, error"]
    assert live["said"] == "Running robot: 2 of 3 nodes not there, also there: /stranger"
    assert "not there on the running robot" in live["hint"]
    assert live["marked"] == 1, "the endpoint's line"
    assert live["list"] == ["/slam /slam subscribes to /odom as std_msgs/String (since 12:04:17)"]
    assert live["jumped"] == "node /slam"
    assert live["after"] == 0


def test_names_stay_texts(seen: Mapping[str, Any]) -> None:
    assert seen["hostile"] == 2, "the page's own data and script"


def test_a_large_graph_is_shown_and_filtered(seen: Mapping[str, Any]) -> None:
    assert seen["large"]["all"] == 750
    assert seen["large"]["inView"] > 5, "it opens where there is something to see"
    before, after = seen["large"]["map"]
    assert before < after, "a click on the overview goes there"
    assert seen["large"]["shown"] == 60, "ten nodes and their topics"
    assert seen["large"]["status"].startswith("10 of 150 nodes, 0 of 600 topics")


def test_in_a_narrow_window_all_parts_of_the_page_are_seen(seen: Mapping[str, Any]) -> None:
    narrow = seen["large"]["narrow"]
    assert narrow["footer"] == 800
    assert narrow["canvas"] < 800
    assert narrow["map"]
