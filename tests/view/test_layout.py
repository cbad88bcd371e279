"""Where things stand in the picture."""

from __future__ import annotations

from itertools import combinations
from pathlib import Path

import pytest
from preflight_analysis.view import engine
from preflight_analysis.view.labels import columns, label
from preflight_analysis.view.layout import Box, Layout, lay_out
from preflight_analysis.view.model import GraphView
from support import sample_graphs

EMPTY = GraphView("/empty.launch", 1, (), (), (), (), ())


def overlapping(layout: Layout) -> list[tuple[Box, Box]]:
    def apart(a: Box, b: Box) -> bool:
        return a.x + a.width <= b.x or b.x + b.width <= a.x or a.y + a.height <= b.y or b.y + b.height <= a.y

    return [(a, b) for a, b in combinations(layout.boxes, 2) if not apart(a, b)]


def is_inside(layout: Layout) -> bool:
    corners = [(b.x, b.y) for b in layout.boxes] + [(b.x + b.width, b.y + b.height) for b in layout.boxes]
    points = [*corners, *(point for route in layout.routes for point in route.points)]
    return all(0 <= x <= layout.width and 0 <= y <= layout.height for x, y in points)


@pytest.mark.parametrize(
    "view",
    [sample_graphs.robot(), sample_graphs.hostile(), sample_graphs.large(40, 160)],
    ids=["robot", "hostile", "large"],
)
def test_nothing_overlaps_and_all_is_inside(view: GraphView) -> None:
    layout = lay_out(view)
    assert overlapping(layout) == []
    assert is_inside(layout)


def test_lines_begin_and_end_at_their_boxes_and_go_with_the_messages() -> None:
    view = sample_graphs.robot()
    layout = lay_out(view)

    def touches(box: Box, point: tuple[float, float]) -> bool:
        x, y = point
        return box.x - 1 <= x <= box.x + box.width + 1 and box.y - 1 <= y <= box.y + box.height + 1

    for route in layout.routes:
        assert touches(layout.boxes[route.source], route.points[0])
        assert touches(layout.boxes[route.target], route.points[-1])
        for edge in (view.edges[i] for i in route.edges):
            out = edge.role in ("publisher", "client", "action_client")
            assert (layout.boxes[route.source].node == edge.node) is out


def test_channels_with_the_same_ends_share_a_box_unless_something_is_wrong_with_one() -> None:
    view = sample_graphs.robot().without_builtin()
    stacks = [{view.channels[i].name for i in box.channels} for box in lay_out(view).boxes if box.channels]
    assert {"/camera/image_raw/compressed", "/camera/image_raw/theora", "/camera/parameter_updates"} in stacks
    assert {"/battery"} in stacks, "said to be without a subscriber"
    assert {"/joint_states"} in stacks


def test_the_same_graph_has_the_same_layout() -> None:
    assert lay_out(sample_graphs.large(30, 90)) == lay_out(sample_graphs.large(30, 90))


def test_a_graph_of_nothing() -> None:
    assert lay_out(EMPTY).boxes == ()


def test_without_the_engine_everything_has_a_place_all_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(engine, "_PROGRAM", "raise SystemExit(1)")
    layout = lay_out(sample_graphs.robot())
    assert overlapping(layout) == []
    assert is_inside(layout)
    assert all(len(route.points) == 2 for route in layout.routes)


def test_nothing_of_the_folder_that_we_are_in_is_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("graphlay", "json"):
        (tmp_path / f"{name}.py").write_text("raise SystemExit(1)")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    assert any(len(route.points) > 2 for route in lay_out(sample_graphs.robot()).routes)


def test_an_engine_that_is_not_installed_is_done_without(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(engine, "find_spec", lambda name: None)
    assert overlapping(lay_out(sample_graphs.robot())) == []


def test_an_engine_that_does_not_end_is_given_up(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(engine, "_PROGRAM", "import time\nwhile True: time.sleep(1)")
    monkeypatch.setattr(engine, "PATIENCE", 0.2)
    assert overlapping(lay_out(sample_graphs.robot())) == []


@pytest.mark.parametrize("text", [*sample_graphs.HOSTILE, "/ordinary/name"])
def test_a_label_is_one_short_line(text: str) -> None:
    shown = label(text)
    assert columns(shown) <= 38
    assert "\n" not in shown
    assert all(character.isprintable() for character in shown)


def test_a_long_name_keeps_both_ends() -> None:
    shown = label("/a_robot/with/a/very/long/name/of/its/front_camera_driver")
    assert shown.startswith("/a_robot")
    assert shown.endswith("front_camera_driver")
