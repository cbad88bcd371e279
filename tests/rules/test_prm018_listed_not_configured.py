"""PRM018: a plugin that is listed and not configured."""

from pathlib import Path

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.findings.finding import Finding
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace
from support.check import check

_START = """//- /robot.launch.xml
        <launch>
          <node pkg="p" exec="e" name="costmap">
            <param from="/p/costmap.yaml"/>{more}
          </node>
        </launch>
        //- /p/costmap.yaml
        costmap:
          ros__parameters:
            rate: 1.0"""


def test_another_name_than_that_of_the_section() -> None:
    (found,) = check(f"""
        {_START.format(more="")}
            plugins: ["static_layer", "voxel_layer"]
                                       ^^^^^^^^^^^ warning[PRM018] 'voxel_layer' in 'plugins' has no parameter
            static_layer:
              plugin: "a::Static"
            obstacle_layer:
              plugin: "a::Obstacle"
    """)
    assert "'obstacle_layer' is configured but not listed" in found.message
    assert [each.message for each in found.related][:1] == ["'obstacle_layer' is configured here"]


def test_below_another_name() -> None:
    check(f"""
        {_START.format(more="")}
            follow.critics: [near, far]
                             ^^^^ warning[PRM018] no parameter 'follow.near.type'
            follow.far.type: "a::Far"
    """)


@pytest.mark.silent
def test_what_is_configured_elsewhere_or_needs_nothing() -> None:
    check(f"""
        {_START.format(more='<param name="voxel_layer.plugin" value="a::Voxel"/>')}
            plugins: ["static_layer", "voxel_layer"]
            behaviors: ["spin", "backup", "drive_on_heading", "wait"]
            critics: ["near", "far"]
            frames: ["map", "static_layer odom"]
            static_layer:
              plugin: "a::Static"
            spin:
              plugin: "a::Spin"
    """)


LOOSE = """
costmap:
  ros__parameters:
    plugins: ["static_layer", "voxel_layer"]
    static_layer: {plugin: "a::Static"}
"""


def _with_files(folder: Path, *files: str) -> list[Finding]:
    """What is said of parameter files that no node gets, of a repository with one package."""
    texts = {
        "package.xml": "<package><name>p</name></package>",
        "a.launch.xml": '<launch><node pkg="p" exec="x" name="costmap"/></launch>',
    }
    own = {f"src/robot/p/{name}": text for name, text in texts.items()}
    for place, text in {**own, **dict.fromkeys(files, LOOSE)}.items():
        path = folder / place
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    environment = detect_environment(str(folder), {"ROS_VERSION": "2"}, root=str(folder / "nowhere"))
    workspace = Workspace(environment, Sources())
    static = workspace.static(str(folder / "src/robot/p/a.launch.xml"))
    return [each for each, _ in workspace.branches(static).findings if each.rule == "PRM018"]


@pytest.mark.parametrize("place", ["src/robot/p/config/nav.yaml", "src/robot/config/nav.yaml", "params/nav.yaml"])
def test_a_file_of_the_package_or_beside_it_that_no_node_gets(tmp_path: Path, place: str) -> None:
    (finding,) = _with_files(tmp_path, place)
    assert (finding.severity, finding.confidence) == ("warning", "likely")
    assert finding.location.file == str(tmp_path / place)


@pytest.mark.silent
def test_a_file_that_changes_some_of_another_one(tmp_path: Path) -> None:
    base = LOOSE + '    voxel_layer: {plugin: "a::Voxel", enabled: true}\n'
    for name, text in {"base.yaml": base, "nav.yaml": LOOSE}.items():
        path = tmp_path / "src/robot/p/config" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    assert not _with_files(tmp_path)


@pytest.mark.silent
def test_a_file_that_is_of_something_else(tmp_path: Path) -> None:
    assert not _with_files(
        tmp_path, "src/robot/docs/nav.yaml", "docs/config/nav.yaml", "src/robot/p/test/config/nav.yaml"
    )


def test_a_controller_of_moveit_without_a_section() -> None:
    check("""
        //- /robot.launch.xml
        <launch><node pkg="p" exec="e" name="move_group"><param from="/p/controllers.yaml"/></node></launch>
        //- /p/controllers.yaml
        move_group:
          ros__parameters:
            moveit_simple_controller_manager:
              controller_names: ["arm_trajectory_controller"]
              ^^^^^^^^^^^^^^^^ warning[PRM018] 'arm_trajectory_controller' in
              arm:
                type: FollowJointTrajectory
              other:
                type: GripperCommand
            other_manager:
              controller_names: ["leg"]
    """)
