"""What a robot description says."""

from preflight_analysis.robot.model import ControlJoint, ControlSystem, Joint, Transmission
from preflight_analysis.robot.parse import parse_description

_ARM = """<?xml version="1.0"?>
<robot name="arm">
  <link name="base"/><link name="elbow"><visual><geometry><mesh filename="package://arm/e.stl"/></geometry></visual>
  <collision><geometry><mesh filename="package://arm/e.stl"/></geometry></collision></link>
  <!-- <link name="away"/> -->
  <joint name="turn" type="revolute"><parent link="base"/><child link="elbow"/><limit effort="1"/></joint>
  <joint name="copy" type="continuous"><mimic joint="turn"/></joint>
  <ros2_control name="hw" type="system"><hardware><plugin>a/B</plugin></hardware>
    <joint name="turn"><command_interface name="position"/><state_interface name="velocity"/></joint>
    <sensor name="imu"><state_interface name="x"/></sensor>
  </ros2_control>
  <transmission name="t"><joint name="turn"><hardwareInterface>h/E</hardwareInterface></joint></transmission>
  <gazebo reference="elbow"><sensor><plugin name="p" filename="lib.so"><ros><namespace>/a</namespace></ros>
    <frame_name> elbow </frame_name></plugin></sensor></gazebo>
</robot>
"""


def test_a_robot_is_read() -> None:
    arm = parse_description(_ARM)
    assert (arm.kind, arm.name, arm.links, arm.roots) == ("robot", "arm", ("base", "elbow"), ("base",))
    assert arm.joints == (
        Joint("turn", "revolute", "base", "elbow", None, True),
        Joint("copy", "continuous", "", "", "turn"),
    )
    assert arm.meshes == ("package://arm/e.stl",)
    joint, imu = ControlJoint("turn", ("position",), ("velocity",)), ControlJoint("imu", (), ("x",))
    assert arm.systems == (ControlSystem("hw", "system", "a/B", (joint,), (imu,)),)
    assert arm.transmissions == (Transmission("t", (ControlJoint("turn", ("h/E",)),)),)
    (plugin,) = arm.plugins
    assert (plugin.name, plugin.filename, plugin.reference) == ("p", "lib.so", "elbow")
    assert plugin.params == {"namespace": "/a", "frame_name": "elbow"}


def test_what_is_no_robot() -> None:
    assert parse_description('<sdf version="1.7"/>').kind == "sdf"
    broken = parse_description("\n<robot>\n<link>\n</robot>").malformed
    assert broken is not None
    assert broken.line == 4
    assert "line" not in broken.message.partition(" line ")[2]


def test_what_xacro_has_yet_to_make_a_robot_of() -> None:
    for within in ("<xacro:arm/>", '<link name="l"><xacro:box/></link>', '<link name="${side}_l"/>'):
        raw = parse_description(f'<robot name="r" xmlns:xacro="http://wiki.ros.org/xacro">{within}</robot>')
        assert (raw.kind, raw.links) == ("xacro", ())
    assert parse_description('<robot xmlns:xacro="http://wiki.ros.org/xacro"><link name="l"/></robot>').kind == "robot"


def test_entities_are_not_expanded() -> None:
    bomb = '<!DOCTYPE r [<!ENTITY a "aaaa"><!ENTITY b "&a;&a;">]><robot name="&b;"><link name="l">&b;</link></robot>'
    assert parse_description(bomb).links in ((), ("l",))
    secret = '<!DOCTYPE r [<!ENTITY x SYSTEM "file:///etc/passwd">]><robot><link name="l">&x;</link></robot>'
    assert parse_description(secret).links == ("l",)
