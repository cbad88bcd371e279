"""What is missing on this machine."""

from __future__ import annotations

import pytest
from preflight_analysis.documents.span import Location
from preflight_analysis.findings.lack import Lack, commands, in_words, missing

PLACE = Location.of_file("/a.launch")


def test_commands_are_put_together() -> None:
    found = missing(
        (Lack(kind, name, remedy), PLACE)
        for kind, name, remedy in (
            ("package", "b", "apt install ros-noetic-b"),
            ("package", "a", "apt install liba-dev a-tools"),
            ("build", "c", "colcon build --packages-select c"),
            ("variable", "ROS_DISTRO", "source /opt/ros/jazzy/setup.bash"),
            ("module", "torch", None),
        )
    )
    assert commands(found) == (
        "apt install a-tools liba-dev ros-noetic-b",
        "colcon build --packages-select c",
        "source /opt/ros/jazzy/setup.bash",
    )
    assert list(in_words(found, most=1)) == [
        "2 packages: a and 1 more",
        "1 package that is not built: c",
        "1 Python module: torch",
        "1 environment variable: ROS_DISTRO",
    ]


@pytest.mark.parametrize("name", ["a; reboot", "a\nreboot", "$(reboot)", "`reboot`", "$HOME", "'a'", "a&", "a>b"])
def test_a_name_that_a_shell_would_take_for_more_has_no_command(name: str) -> None:
    assert Lack("build", name, f"catkin build {name}").remedy is None
