"""BTR006: a library of behaviour tree nodes that bt_navigator cannot load, or loads twice."""

from pathlib import Path

import pytest
from preflight_analysis.findings.finding import Finding
from preflight_analysis.rules.registry import run_rules
from support import package_elsewhere

_LAUNCH = """<launch><node pkg="nav2_bt_navigator" exec="bt_navigator" name="bt_navigator">
<param from="$(dirname)/nav2.yaml"/></node></launch>"""


def _found(folder: Path, distro: str | None, *libraries: str, **files: str) -> list[Finding]:
    listed = "".join(f"\n      - {each}" for each in libraries)
    params = f"bt_navigator:\n  ros__parameters:\n    plugin_lib_names:{listed}\n"
    analysis = package_elsewhere.analysed(folder, _LAUNCH, "a.launch.xml", distro, **{"nav2.yaml": params, **files})
    return [each for each in run_rules(analysis.context) if each.rule == "BTR006"]


def test_those_that_are_loaded_by_default(tmp_path: Path) -> None:
    """As in PickNikRobotics/moveit_pro_example_ws, pull request 809."""
    libraries = ("nav2_compute_path_to_pose_action_bt_node", "nav2_follow_path_action_bt_node", "my_door_bt_node")
    (found,) = _found(tmp_path, "jazzy", *libraries)
    assert found.message == (
        "'plugin_lib_names' of /bt_navigator lists 2 libraries that bt_navigator of jazzy loads itself: it stops with "
        "'ID [ComputePathToPose] already registered'"
    )
    assert found.severity == "error"


def test_one_of_them(tmp_path: Path) -> None:
    (found,) = _found(tmp_path, "kilted", "nav2_wait_action_bt_node")
    assert "lists 'nav2_wait_action_bt_node' that bt_navigator of kilted loads itself" in found.message


def test_one_that_is_listed_twice(tmp_path: Path) -> None:
    (found,) = _found(tmp_path, "humble", *("nav2_wait_action_bt_node", "nav2_spin_action_bt_node") * 2)[:1]
    assert "lists 'nav2_wait_action_bt_node' twice" in found.message
    assert found.severity == "error"


def test_a_slip_of_a_library(tmp_path: Path) -> None:
    (found,) = _found(tmp_path, None, "nav2_wait_action_bt_nod", "my_door_bt_node")
    assert found.message == (
        "'plugin_lib_names' of /bt_navigator lists the unknown library 'nav2_wait_action_bt_nod'; "
        "did you mean 'nav2_wait_action_bt_node'?"
    )
    assert (found.severity, found.fixes[0].edits[0].text) == ("warning", "nav2_wait_action_bt_node")


@pytest.mark.parametrize(
    ("distro", "library", "hint"),
    [
        ("humble", "nav2_are_error_codes_active_condition_bt_node", ""),
        (
            "lyrical",
            "nav2_path_expiring_timer_condition",
            "; did you mean 'nav2_path_expiring_timer_condition_bt_node'?",
        ),
    ],
)
def test_one_of_another_distribution(tmp_path: Path, distro: str, library: str, hint: str) -> None:
    (found,) = _found(tmp_path, distro, library)
    assert found.message == (
        f"'plugin_lib_names' of /bt_navigator lists '{library}', which Nav2 of {distro} does not have{hint}"
    )


_OWN = {"../nav2_behavior_tree/package.xml": "<package><name>nav2_behavior_tree</name></package>"}


@pytest.mark.silent
@pytest.mark.parametrize(
    ("distro", "libraries"),
    [
        ("humble", ("nav2_wait_action_bt_node", "nav2_spin_action_bt_node", "my_door_bt_node")),
        (None, ("nav2_wait_action_bt_node", "nav2_are_error_codes_active_condition_bt_node")),
        ("jazzy", ("my_door_bt_node", "opennav_dock_action_bt_node")),
        ("jazzy", ("nav2_nothing_like_it_bt_node",)),
    ],
)
def test_lists_that_load(tmp_path: Path, distro: str | None, libraries: tuple[str, ...]) -> None:
    assert not _found(tmp_path, distro, *libraries)


@pytest.mark.silent
def test_a_nav2_of_the_workspace_may_load_others(tmp_path: Path) -> None:
    assert not _found(tmp_path, "jazzy", "nav2_wait_action_bt_node", **_OWN)
