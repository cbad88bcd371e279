"""URD004: two links or two joints of one name."""

import pytest
from support.check import check
from support.robot_launch import of_urdf, robot

_JOINT = '<joint name="{0}" type="fixed"><parent link="{1}"/><child link="{2}"/></joint>'
_LINKS = '<link name="a"/><link name="b"/><link name="c"/>'


def test_a_joint_that_is_written_twice() -> None:
    (found,) = check(
        of_urdf(
            _LINKS + _JOINT.format("j", "a", "b") + _JOINT.format("j", "b", "c"),
            robot(
                '<joint name="j"/>',
                '<joint name="j"/>',
                "             ^ error[URD004] duplicate joint 'j': the robot description has 2 of this name",
            ),
        )
    )
    assert [related.message for related in found.related] == ["the first joint"]


def test_a_macro_that_is_called_twice() -> None:
    check(
        of_urdf(
            '<link name="a"/><link name="a"/>',
            robot('<link name="${x}a"/>', "            ^^^^^ error[URD004] duplicate link 'a'"),
        )
    )


@pytest.mark.silent
def test_a_link_and_a_joint_of_one_name() -> None:
    check(of_urdf(_LINKS + _JOINT.format("a", "a", "b") + _JOINT.format("b", "b", "c")))
