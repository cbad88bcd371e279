"""URD002: a joint between links of which one does not exist."""

import pytest
from support.check import apply, check
from support.robot_launch import of_urdf, robot

_URDF = """<link name="base_link"/><link name="lidar"/><joint name="j" type="fixed"><parent link="{}"/>
<child link="lidar"/></joint>""".replace("\n", "")


def test_a_slip_in_a_xacro_file() -> None:
    text = of_urdf(
        _URDF.format("base_lnk"),
        robot(
            '<link name="base_link"/>',
            '<parent link="base_lnk"/>',
            "              ^^^^^^^^ error[URD002] 'base_lnk' does not exist: it is the parent of joint 'j'",
        ),
    )
    (found,) = check(text)
    assert '<parent link="base_link"/>' in apply(text, found.fixes[0].edits)["/p/arm.xacro"]
    assert [related.message for related in found.related] == ["robot_description of this launch"]


def test_without_the_place_it_is_told_at_the_parameter() -> None:
    launch = """<launch>
      <param name="robot_description" command="xacro arm"/>
                   ^^^^^^^^^^^^^^^^^ error[URD002] link 'elsewhere' does not exist
    </launch>"""
    check(of_urdf(_URDF.format("elsewhere"), launch=launch))


def test_no_link_at_all() -> None:
    written = robot('<joint name="${p}j">', "             ^^^^^ error[URD002] joint 'j' has no parent link")
    check(of_urdf(_URDF.replace('<parent link="{}"/>', ""), written))


@pytest.mark.silent
def test_links_that_exist() -> None:
    check(of_urdf(_URDF.format("base_link")))
