"""What a launch file of ROS 2 that speaks the language of ROS 1 by mistake is read as."""

from pathlib import Path

import pytest
from preflight_analysis.launch.read import generation_of

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
    assert generation_of(str(tmp_path / "launch" / name), OLDER) == generation
