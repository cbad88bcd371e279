"""URD007: a joint that ros2_control or a transmission names and the robot does not have."""

import pytest
from support.check import apply, check
from support.robot_launch import of_urdf, robot

_URDF = """<link name="a"/><link name="b"/>
<joint name="shoulder_joint" type="continuous"><parent link="a"/><child link="b"/></joint>
<ros2_control name="hw" type="system"><joint name="{}"/></ros2_control>
<transmission name="t"><joint name="{}"/></transmission>""".replace("\n", "")


def test_a_slip() -> None:
    text = of_urdf(
        _URDF.format("shoulder_jnt", "shoulder_joint"),
        robot(
            '<joint name="shoulder_jnt"/>',
            '<ros2_control name="hw"><joint name="shoulder_jnt"/></ros2_control>',
            "                                     ^^^^^^^^^^^^ warning[URD007] joint 'shoulder_jnt' does not exist",
        ),
    )
    (found,) = check(text)
    assert '<joint name="shoulder_joint"/></ros2_control>' in apply(text, found.fixes[0].edits)["/p/arm.xacro"]


def test_a_transmission() -> None:
    check(
        of_urdf(
            _URDF.format("shoulder_joint", "elbow"),
            robot(
                '<transmission name="t">',
                "                    ^ warning[URD007] joint 'elbow' does not exist: <transmission name=\"t\"> uses it",
                "</transmission>",
            ),
        )
    )


@pytest.mark.silent
def test_joints_that_exist() -> None:
    check(of_urdf(_URDF.format("shoulder_joint", "shoulder_joint")))
