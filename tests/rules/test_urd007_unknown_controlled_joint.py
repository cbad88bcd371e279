"""URD007: a joint that ros2_control or a transmission names and the robot does not have."""

from dataclasses import replace

import pytest
from preflight_analysis.rules.registry import run_rules
from support.check import analyse, apply, check, findings_of, read_fixture
from support.robot_launch import of_urdf, robot

_HARDWARE = "<hardware><plugin>mock_components/GenericSystem</plugin></hardware>"
_URDF = """<link name="a"/><link name="b"/>
<joint name="shoulder_joint" type="continuous"><parent link="a"/><child link="b"/></joint>
<ros2_control name="hw" type="system">HW<joint name="{}"><command_interface name="position"/></joint></ros2_control>
<transmission name="t"><joint name="{}"/></transmission>""".replace("\n", "").replace("HW", _HARDWARE)


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


def test_many_that_are_like_none_have_one_cause() -> None:
    tags = "".join(
        f'<transmission name="t{at}"><joint name="{joint}"/></transmission>' for at, joint in enumerate("uvwxy")
    )
    (found,) = check(
        of_urdf(
            _URDF.format("shoulder_joint", "shoulder_joint") + tags,
            robot(
                '<transmission name="t0">',
                "                    ^^ warning[URD007] joint 'u' and 4 more do not exist: <transmission name=\"t0\">",
                "</transmission>",
            ),
        )
    )
    assert found.fixes == ()


def test_newer_distributions_refuse_the_description() -> None:
    """https://github.com/ros-controls/ros2_control/issues/1539"""
    escaped = f"<robot>{_URDF.format('wheel_joint', 'shoulder_joint')}</robot>".replace("<", "&lt;").replace(
        '"', "&quot;"
    )
    fixture = read_fixture(f"""
        //- /main.launch.xml
        <launch><node pkg="p" exec="rsp" name="rsp"><param name="robot_description" value="{escaped}"/></node></launch>
    """)
    context = analyse(fixture)
    for distro, severity in (("humble", "warning"), ("jazzy", "error")):
        used = replace(context, environment=replace(context.environment, distro=distro))
        assert [each.severity for each in run_rules(used) if each.rule == "URD007"] == [severity]


@pytest.mark.silent
def test_joints_that_exist() -> None:
    check(of_urdf(_URDF.format("shoulder_joint", "shoulder_joint")))


def test_a_transmission_of_ros2_is_not_read() -> None:
    escaped = f"<robot>{_URDF.format('shoulder_joint', 'elbow')}</robot>".replace("<", "&lt;").replace('"', "&quot;")
    found = findings_of(f"""
        //- /main.launch.xml
        <launch><node pkg="p" exec="rsp" name="rsp"><param name="robot_description" value="{escaped}"/></node></launch>
    """)
    assert [(each.rule, each.severity) for each in found] == [("URD007", "info")]


def test_an_actuator_without_interfaces() -> None:
    """https://github.com/bitmeal/youbot_ros2: the hardware has actuators beside the joints."""
    actuator = '<ros2_control name="hw"><joint name="actuator_1"><param name="id">1</param></joint></ros2_control>'
    found = findings_of(of_urdf(f"{_URDF.format('shoulder_joint', 'shoulder_joint')}{actuator}"))
    assert [(each.rule, each.severity) for each in found] == [("URD007", "info")]


def test_a_description_for_the_controller_manager_alone() -> None:
    hardware = (
        '<link name="base"/><ros2_control name="hw"><joint name="lift"><command_interface name="position"/></joint>'
    )
    found = findings_of(of_urdf(f"{hardware}</ros2_control>"))
    assert [(each.rule, each.severity) for each in found] == [("URD007", "info")]
