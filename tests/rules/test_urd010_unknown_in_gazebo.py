"""URD010: links and joints that `<gazebo>` elements name and that the robot does not have."""

import pytest
from support.check import apply, check, findings_of
from support.descriptions import said, xacro
from support.robot_launch import of_urdf, robot

_URDF = """<link name="base"/><link name="laser_link"/>
<joint name="wheel_joint" type="continuous"><parent link="base"/><child link="laser_link"/></joint>""".replace("\n", "")


def test_a_sensor_of_a_link_that_is_called_otherwise() -> None:
    """https://github.com/ros-mobile-robots/diffbot, before e585624f"""
    gazebo = '<gazebo reference="laser_lnk"><sensor name="laser"/></gazebo>'
    text = of_urdf(
        _URDF + gazebo,
        robot(
            '<gazebo reference="laser_lnk">',
            "                   ^^^^^^^^^ warning[URD010] link or joint 'laser_lnk' does not exist: <gazebo> "
            "refers to it; did you mean 'laser_link'?",
            "</gazebo>",
        ),
    )
    (found,) = check(text)
    assert '<gazebo reference="laser_link">' in apply(text, found.fixes[0].edits)["/p/arm.xacro"]


def test_a_material_alone() -> None:
    found = findings_of(of_urdf(f'{_URDF}<gazebo reference="mast"><material>Gazebo/Grey</material></gazebo>'))
    assert [(each.rule, each.severity) for each in found] == [("URD010", "info")]


@pytest.mark.parametrize("tag", ["leftJoint", "left_joint", "joint_name"])
def test_a_joint_of_a_plugin(tag: str) -> None:
    plugin = f'<gazebo><plugin name="d" filename="libdrive.so"><{tag}>weel_joint</{tag}></plugin></gazebo>'
    (found,) = findings_of(of_urdf(_URDF + plugin))
    assert (found.rule, found.severity) == ("URD010", "warning")
    assert f"<{tag}> of the plugin 'libdrive.so' names it; did you mean 'wheel_joint'?" in found.message


@pytest.mark.silent
def test_what_the_robot_has() -> None:
    plugin = '<plugin name="d" filename="libdrive.so"><joint>wheel_joint</joint><num_joints>2</num_joints></plugin>'
    check(of_urdf(f'{_URDF}<gazebo reference="wheel_joint"><mu1>1</mu1></gazebo><gazebo>{plugin}</gazebo>'))


LINKS = '<xacro:arg name="robot" default="r"/><link name="$(arg robot)/base"/><link name="lidar_link"/>'
LINKS += '<joint name="lidar_joint"/>'


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (
            '<gazebo reference="lidar_lnk"/>',
            "warning link or joint 'lidar_lnk' does not exist: <gazebo> refers to it; did you mean 'lidar_link'?",
        ),
        ('<gazebo reference="camera"/>', "info link or joint 'camera' does not exist: <gazebo> refers to it"),
        (
            '<gazebo reference="lidar_link"><preserveFixedJoint>true</preserveFixedJoint></gazebo>',
            "warning joint 'lidar_link' does not exist: <preserveFixedJoint> is about a joint",
        ),
        (
            '<gazebo><plugin name="p" filename="p3d"><body_name>base</body_name></plugin></gazebo>',
            "warning link 'base' does not exist: <body_name> of a plugin names it; did you mean '$(arg robot)/base'?",
        ),
    ],
)
def test_names_of_one_file(text: str, expected: str) -> None:
    assert said({"r.xacro": xacro(LINKS + text)}, "URD010") == [f"r.xacro:2 {expected}"]


@pytest.mark.parametrize(
    "text",
    [
        '<gazebo reference="lidar_link"/><gazebo reference="$(arg robot)/base"/><gazebo reference="r/base"/>',
        '<gazebo reference="lidar_joint"><preserveFixedJoint>true</preserveFixedJoint></gazebo>',
        '<gazebo><plugin name="p" filename="f"><frame_name>world</frame_name></plugin></gazebo>',
        '<xacro:macro name="m" params="link"><link name="${link}"/></xacro:macro><gazebo reference="camera"/>',
        '<xacro:include filename="$(find other)/a.xacro"/><gazebo reference="camera"/>',
    ],
)
def test_names_that_are_there_or_may_be(text: str) -> None:
    assert said({"r.xacro": xacro(LINKS + text)}, "URD010") == []
