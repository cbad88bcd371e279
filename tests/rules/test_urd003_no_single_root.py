"""URD003: links that are not one tree."""

import pytest
from support.check import check
from support.robot_launch import of_urdf, robot

_JOINT = '<joint name="{0}" type="fixed"><parent link="{1}"/><child link="{2}"/></joint>'


def test_a_link_without_a_joint() -> None:
    check(
        of_urdf(
            '<link name="lidar"/><link name="base"/><link name="arm"/>' + _JOINT.format("j", "base", "arm"),
            robot(
                '<link name="lidar"/>',
                "            ^^^^^ error[URD003] link 'lidar' is not the child of any joint; 'base' is also a root",
            ),
        )
    )


def test_a_cycle() -> None:
    check(
        of_urdf(
            '<link name="a"/><link name="b"/>' + _JOINT.format("j", "a", "b") + _JOINT.format("k", "b", "a"),
            robot('<link name="a"/>', "            ^ error[URD003] link 'a' is in a cycle of joints"),
        )
    )


@pytest.mark.silent
def test_one_root() -> None:
    check(of_urdf('<link name="a"/><link name="b"/>' + _JOINT.format("j", "a", "b")))


@pytest.mark.silent
def test_a_single_link() -> None:
    check(of_urdf('<link name="a"/>'))
