"""Which ROS a launch file in XML is for."""

from pathlib import Path

import pytest
from preflight_analysis.documents.reading import Unreadable
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace


def marked_generation(path: str, text: str) -> int:
    """Of a text that an editor has of the file."""
    sources = Sources()
    sources.open(path, text)
    found = sources.launch_file(path)
    assert not isinstance(found, Unreadable)
    return found.generation


OLD = '<node pkg="p" type="t" name="n" ns="x"/><include file="$(find robot)/launch/base.launch"/>'
OLDER = '<launch><include file="$(find robot)/launch/base.launch"/></launch>'


@pytest.mark.parametrize(
    ("build", "name", "generation"),
    [
        ("ament_python", "robot.launch.xml", 2),
        ("ament_python", "robot.launch", 1),
        ("catkin", "robot.launch.xml", 1),
    ],
)
def test_the_package_decides(build: str, name: str, generation: int, tmp_path: Path) -> None:
    manifest = f"<package><name>robot</name><buildtool_depend>{build}</buildtool_depend></package>"
    (tmp_path / "package.xml").write_text(manifest)
    (tmp_path / "launch").mkdir()
    assert marked_generation(str(tmp_path / "launch" / name), OLDER) == generation


@pytest.mark.parametrize(
    "tag",
    [
        '<let name="a" value="b"/>',
        '<group><push-ros-namespace namespace="a"/></group>',
        '<group>\n<push_ros_namespace namespace="a"/></group>',
        '<arg name="a" default="b"\n description="what it is"/>',
        '<node pkg="p" exec="e"/>',
    ],
)
def test_what_roslaunch_never_had_decides_in_a_loose_file(tag: str, tmp_path: Path) -> None:
    for name in ("a.launch.xml", "a.launch"):
        assert marked_generation(str(tmp_path / name), f"<launch>{tag}{OLD}</launch>") == 2
        assert marked_generation(str(tmp_path / name), f"<launch>{tag}</launch>") == 2
        assert marked_generation(str(tmp_path / name), f"<launch>{OLD}<!-- {tag} --></launch>") == 1


@pytest.mark.parametrize(("version", "generation"), [("1", 1), ("2", 2)])
def test_where_nothing_decides_what_is_sourced_does(version: str, generation: int, tmp_path: Path) -> None:
    path = tmp_path / "a.launch.xml"
    path.write_text('<launch><arg name="a" default="b"/></launch>')
    sources = Sources()
    Workspace(detect_environment(str(tmp_path), {"ROS_VERSION": version}, root=str(tmp_path)), sources)
    found = sources.launch_file(str(path))
    assert not isinstance(found, Unreadable)
    assert found.generation == generation
