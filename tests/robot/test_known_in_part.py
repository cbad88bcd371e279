"""Rules on a robot description that lacks a package: they speak of what is there, and not of what is not. Where the
catalogue has its structure they speak of both, and are not certain."""

import pytest
from support.check import check
from support.robot_launch import of_urdf, robot

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


_CATALOGUED = "<!-- from the catalogue of ros-preflight for {}, sensors -->"
_SENSOR = '<joint name="j" type="" preflight="sensors"><parent link="{}"/><child link="sensor"/></joint>'
_LINKS = '<link name="base_link"/><link name="sensor" preflight="sensors"/>'


def _by_catalogue(text: str, distro: str) -> str:
    return text.replace("<robot name", f"{_CATALOGUED.format(distro)}<robot name")


@pytest.mark.parametrize(("distro", "said", "sure"), [("noetic", "error", "likely"), ("jazzy", "info", "possible")])
def test_what_the_catalogue_has_is_not_certain(distro: str, said: str, sure: str) -> None:
    written = robot(
        "<xacro:sensor parent='base_lnk'/>",
        f"                      ^^^^^^^^ {said}[URD002] link 'base_lnk' does not exist: it is the parent of joint 'j'; "
        "did you mean 'base_link'?",
    )
    (found,) = check(_by_catalogue(of_urdf(_LINKS + _SENSOR.format("base_lnk"), written), distro))
    assert found.confidence == sure


@pytest.mark.silent
def test_a_type_that_the_catalogue_does_not_have_is_no_mistake() -> None:
    check(_by_catalogue(of_urdf(_LINKS + _SENSOR.format("base_link")), "noetic"))
