"""URD010: links and joints that `<gazebo>` elements name and that the robot does not have."""

import pytest
from support.check import apply, check, findings_of
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
