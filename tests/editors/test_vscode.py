"""The packaged extension in the VS Code workbench of code-server, driven through Chromium."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
from pathlib import Path
from typing import Any

import pytest
from support.editor_harness import ROOT, Harness
from support.editor_launch_files import create_description, create_formats, create_robot
from support.live_harness import Ros1System, registered
from support.waiting import until

pytestmark = [pytest.mark.editor, pytest.mark.vscode]

HERE = Path(__file__).with_name("vscode")
VSIX = ROOT / "out/ros-preflight.vsix"
SCREENSHOTS = ROOT / "out/screenshots"


def drive(harness: Harness, scenario: str, **more: Any) -> dict[str, Any]:
    if not (HERE / "node_modules/.installed").exists():
        pytest.fail("code-server is missing: run tests/editors/install.sh")
    if not VSIX.exists():
        pytest.fail(f"{VSIX} is missing: run make vsix")
    chromium = shutil.which("chromium")
    if chromium is None:
        pytest.fail("chromium is missing: apt-get install chromium")
    log = harness.home / "code-server.log"
    given = {
        "home": str(harness.home),
        "workspace": str(harness.workspace),
        "launchFile": str(harness.launch_file),
        "sandboxRecord": str(harness.sandbox_record),
        "vsix": str(VSIX),
        "screenshots": str(SCREENSHOTS),
        "chromium": chromium,
        "log": str(log),
        "server": str(harness.server),
        **more,
    }
    done = subprocess.run(
        ["node", str(HERE / "drive.mjs"), scenario, json.dumps(given)],
        env=harness.environment,
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        timeout=400,
        check=False,
    )
    logs = "".join(f"\n--- {p}\n{p.read_text()}" for p in sorted(harness.home.glob("data/logs/**/*ROS Preflight.log")))
    assert done.returncode == 0, f"{done.stderr}{done.stdout}{logs}"
    seen: dict[str, Any] = json.loads(done.stdout)
    print(json.dumps(seen["seconds"]))
    return seen


def test_finding_is_seen_and_fixed(trusted_harness: Harness) -> None:
    original = trusted_harness.launch_file.read_text()

    seen = drive(trusted_harness, "fix")

    assert "/chatter" in seen["hoverOnTopic"]
    assert "std_msgs/String" in seen["hoverOnNode"]
    assert "chatter" in seen["quickFix"]
    assert seen["fixed"] == original.replace('to="chater"', 'to="chatter"')
    assert trusted_harness.sandbox_starts() > 0


TREE = [
    "base/",
    "  odometry ① preflight_demo/talker.py",
    "left/",
    "  driver ② preflight_demo/talker.py",
    "  monitor ② preflight_demo/listener.py",
    "right/",
    "  driver ② preflight_demo/talker.py",
    "  monitor ② preflight_demo/listener.py",
    "Includes 2",
    "  arm.launch ② 2 nodes  rate:=5  launch",
    "  arm.launch ② 2 nodes  rate:=20  launch",
    "Shared parameters 1",
    "Not started 2",
    "  group if $(arg sim) is false",
    "    simulator",
    "  include $(dirname)/gripper.launch if $(eval rate > 10) is False",
]
"""Lines of the tree of nodes."""


def test_tree_leads_to_the_files_and_names_are_renamed_across_them(trusted_harness: Harness) -> None:
    folder = create_robot(trusted_harness)

    seen = drive(trusted_harness, "tree", tree=TREE)

    assert seen["tree"] == TREE
    assert seen["badges"] == 2
    assert 'name="frequency" default="1"' in (folder / "arm.launch").read_text()
    robot = (folder / "robot.launch").read_text()
    assert robot.count('name="frequency"') == 2
    assert '<topic name="chatter" type="std_msgs/String" class="pub"/>' in robot


def test_a_robot_description_is_served_alone(trusted_harness: Harness) -> None:
    path = create_description(trusted_harness)
    text = path.read_text()

    seen = drive(trusted_harness, "handedOver")

    assert "Path" in seen["hover"] or "Root of its tree" in seen["hover"]
    assert path.read_text() == text


def test_each_format_of_ros_2_shows_its_finding(trusted_harness: Harness) -> None:
    create_formats(trusted_harness)

    seen = drive(trusted_harness, "formats")

    assert set(seen["problems"]) == {"first.launch.xml", "second.launch.yaml", "third.launch.py"}
    for problems in seen["problems"].values():
        assert "argument 'sped' is not declared; did you mean 'speed'?" in problems[0]


def test_the_first_minutes_lead_from_the_welcome_view_to_the_log(trusted_harness: Harness) -> None:
    seen = drive(trusted_harness, "start")

    assert any("Open Launch File" in text and "walkthrough" in text for text in seen["welcome"])
    assert "node listener, preflight_demo/listener.py" in seen["spoken"]
    assert "1 finding, warning" in seen["spoken"]
    assert seen["steps"][0] == "Open a launch file"
    assert len(seen["steps"]) == 7
    assert {"Restart server", "Clear cache"} <= set(seen["buttons"])
    assert any("Save it" in text for text in seen["unsaved"])
    (log,) = trusted_harness.home.glob("data/logs/**/*ROS Preflight.log")
    assert re.search(r"Ran 2 nodes in the sandbox in \d+\.\d s", log.read_text())


def test_server_is_installed_where_there_is_none(harness_without_server: Harness) -> None:
    harness_without_server.environment["PIP_FIND_LINKS"] = str(ROOT / "out/tools/wheels")
    # Trusted or not, the workspace has no say in what is started without a sandbox.
    started = harness_without_server.home / "started"
    hostile = ["sh", "-c", f"touch {started}"]
    settings = harness_without_server.workspace / ".vscode/settings.json"
    settings.parent.mkdir()
    settings.write_text(json.dumps({"rosPreflight.server.command": hostile, "rosPreflight.server.install": False}))

    seen = drive(harness_without_server, "installs")

    python, *arguments = seen["command"]
    assert python.startswith(str(harness_without_server.home))
    assert arguments == ["-I", "-m", "preflight_server", "lsp"]
    assert not started.exists()


def test_tree_shows_what_the_running_robot_does(trusted_harness: Harness, tmp_path: Path) -> None:
    system = Ros1System(tmp_path, elsewhere=trusted_harness.workspace)
    trusted_harness.environment["ROS_MASTER_URI"] = system.environment["ROS_MASTER_URI"]
    trusted_harness.environment["ROS_IP"] = "127.0.0.1"
    try:
        system.launch(trusted_harness.launch_file)
        victims: list[int] = []
        until(lambda: registered(system, "/talker") and registered(system, "/listener", victims))

        seen = drive(trusted_harness, "watch", victim=victims[0])
    finally:
        system.close()

    assert "as it should be" in seen["healthy"]
    assert "/listener" in seen["broken"]
    assert len(seen["listed"]) == 2, "in the list and at the node"
    assert all("/listener" in line for line in seen["listed"])


def test_set_ups_are_sourced(trusted_harness: Harness) -> None:
    setup = trusted_harness.home / "overlay.bash"
    setup.write_text("echo sourcing\nexport ROS_PACKAGE_PATH=/opt/of/the/overlay\n")

    seen = drive(trusted_harness, "setups", setup=str(setup))

    assert "does not exist" in seen["missing"]
    assert f"{setup}, sourced" in seen["doctor"]
    assert "/opt/of/the/overlay" in seen["doctor"]


def test_untrusted_workspace_says_why_and_trust_needs_no_restart(untrusted_harness: Harness) -> None:
    seen = drive(untrusted_harness, "untrusted")

    assert any("not trusted" in problem for problem in seen["problems"])
    assert seen["sandboxStarts"] == 0
    assert seen["sameServer"]
    assert untrusted_harness.sandbox_starts() > 0


def test_server_is_asked_for_and_started_again_when_it_dies(harness_without_server: Harness) -> None:
    seen = drive(harness_without_server, "restarts")

    assert "No matching distribution found" in seen["missing"]
    assert {"Show Log", "Choose Python", "Set Path"} <= set(seen["buttons"])
    assert seen["told"] == 1


def test_the_graph_is_shown_leads_to_lines_and_follows(trusted_harness: Harness) -> None:
    seen = drive(trusted_harness, "graph")

    assert seen["shown"] == [
        "node /listener",
        "node /talker",
        "topic /chater, warning",
        "topic /chatter, warning",
    ]
    assert "std_msgs/String" in seen["hover"]
    assert "TOP001" in seen["hover"]
    assert any("Quick fix: Replace 'chater' with 'chatter'" in row for row in seen["why"])
    assert [label.split(",")[0] for label in seen["followed"]] == ["node /listener", "node /talker", "topic /chatter"]
    assert "<text" in seen["saved"]
    assert seen["restored"] == "listener"
