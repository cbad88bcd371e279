"""CTL006: a controller asks for another hardware interface than the joint has in Gazebo."""

import pytest
from support.planned_robot import messages

_ROBOT = (
    "<robot name='r'><link name='a'/><link name='b'/><link name='c'/>"
    "<joint name='elbow' type='continuous'><parent link='a'/><child link='b'/></joint>"
    "<joint name='wrist' type='continuous'><parent link='b'/><child link='c'/></joint>"
    "<transmission name='t'>"
    "<joint name='elbow'><hardwareInterface>{interface}</hardwareInterface></joint></transmission>"
    "<gazebo><plugin name='control' filename='libgazebo_ros_control.so'>{more}</plugin></gazebo></robot>"
)
_EFFORT = "hardware_interface/EffortJointInterface"


def _launch(interface: str = _EFFORT, more: str = "", type_: str = "effort_controllers", joint: str = "elbow") -> str:
    urdf = _ROBOT.format(interface=interface, more=more).replace("<", "&lt;")
    return f"""
        <launch>
          <param name="robot_description" value="{urdf}"/>
          <rosparam ns="arm">{{type: {type_}/JointPositionController, joint: {joint}}}</rosparam>
          <node pkg="gazebo_ros" type="spawn_model" name="spawn" args="-urdf -param robot_description -model r"/>
          <node pkg="controller_manager" type="spawner" name="s" args="arm"/>
        </launch>
        //- /gazebo_ros/package.xml
        <package><name>gazebo_ros</name></package>
        //- /controller_manager/package.xml
        <package><name>controller_manager</name></package>
    """


def test_another_interface() -> None:
    assert messages(_launch(type_="position_controllers"), "CTL006") == [
        "joint 'elbow' has interface 'EffortJointInterface': '/arm' (position_controllers/JointPositionController) "
        "asks for 'PositionJointInterface'"
    ]
    assert len(messages(_launch(interface="PositionJointInterface"), "CTL006")) == 1


def test_no_transmission() -> None:
    assert messages(_launch(joint="wrist"), "CTL006") == [
        "joint 'wrist' has no transmission: '/arm' (effort_controllers/JointPositionController) asks for "
        "'EffortJointInterface'"
    ]


@pytest.mark.silent
def test_the_same_interface() -> None:
    assert not messages(_launch(), "CTL006")
    assert not messages(_launch(interface="EffortJointInterface"), "CTL006")


@pytest.mark.silent
def test_another_simulation() -> None:
    other = "<robotSimType>own/RobotHWSim</robotSimType>"
    assert not messages(_launch(more=other, type_="position_controllers"), "CTL006")


@pytest.mark.silent
def test_a_controller_of_another_package() -> None:
    assert not messages(_launch(type_="own_controllers"), "CTL006")
