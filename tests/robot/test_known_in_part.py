"""Rules on a robot description that lacks a package: they speak of what is there, and not of what is not."""

import pytest
from support.check import check
from support.robot_launch import of_urdf

_COMMENT = "<!-- incomplete for ros-preflight without sensors -->"
_JOINT = '<joint name="{}" type="fixed"><parent link="{}"/><child link="{}"/>{}</joint>'


def _in_part(text: str) -> str:
    return text.replace("<robot name", f"{_COMMENT}<robot name")


@pytest.mark.silent
@pytest.mark.parametrize(
    "urdf",
    [
        '<link name="a"/>' + _JOINT.format("j", "a", "sensor", ""),
        '<link name="a"/><link name="b"/>',
        '<link name="a"/><link name="b"/>' + _JOINT.format("j", "a", "b", '<mimic joint="other"/>'),
        '<link name="a"/><ros2_control name="h" type="system"><joint name="other"/></ros2_control>',
        '<link name="a"/><link name="b"/><joint name="j" type="revolute"><parent link="a"/><child link="b"/></joint>',
    ],
)
def test_what_is_not_there_may_be_in_the_package(urdf: str) -> None:
    check(_in_part(of_urdf(urdf)))


def test_what_is_there_twice_is_a_mistake() -> None:
    expected = f"{' ' * 13}{'^' * 17} error[URD004] duplicate link 'a': the robot description has 2 of this name"
    launch = f'<launch>\n<param name="robot_description" command="xacro arm"/>\n{expected}\n</launch>'
    check(_in_part(of_urdf('<link name="a"/><link name="a"/>', launch=launch)))
