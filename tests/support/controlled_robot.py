"""A launch file of a robot with ros2_control, for `check`."""

from __future__ import annotations

import textwrap

_URDF = (
    "<robot name='r'><link name='base'/><link name='left'/><link name='right'/>"
    "<joint name='left_wheel' type='continuous'><parent link='base'/><child link='left'/></joint>"
    "<joint name='right_wheel' type='continuous'><parent link='base'/><child link='right'/></joint>"
    "<ros2_control name='wheels' type='system'><hardware><plugin>mock_components/GenericSystem</plugin></hardware>"
    "{}{}</ros2_control></robot>"
)
_JOINT = "<joint name='{}_wheel'><command_interface name='{}'/><state_interface name='velocity'/></joint>"
_PACKAGES = """//- /controller_manager/package.xml
<package><name>controller_manager</name></package>
//- /robot_state_publisher/package.xml
<package><name>robot_state_publisher</name></package>
//- /p/controllers.yaml
"""


def launch(*spawners: str, params: str, interface: str = "velocity", manager: str = "/controller_manager") -> str:
    """A fixture of a robot with two wheels: `spawners` are their tags, with what is expected below them, `params` the
    parameter file of the manager and `interface` the one by which the wheels take commands."""
    urdf = _URDF.format(_JOINT.format("left", interface), _JOINT.format("right", interface))
    namespace, _, name = manager.rpartition("/")
    tags = (
        '<node pkg="robot_state_publisher" exec="robot_state_publisher" name="rsp"><param name="robot_description" '
        f'value="{urdf.replace("<", "&lt;")}"/></node>',
        f'<node pkg="controller_manager" exec="ros2_control_node" name="{name}" namespace="{namespace or "/"}">'
        '<param from="/p/controllers.yaml"/></node>',
        *spawners,
    )
    lines = "\n".join(("//- /robot.launch.xml", "<launch>", *tags, "</launch>"))
    return f"{lines}\n{_PACKAGES}{textwrap.dedent(params).strip()}\n"


def simulated(
    *spawners: str, params: str, namespace: str = "", name: str = "", interface: str = "velocity", more: str = ""
) -> str:
    """The same robot in Gazebo, whose plugin has the manager in `namespace`, called `name`."""
    spaced = f"<ros><namespace>{namespace}</namespace></ros>" if namespace else ""
    named = f"<controller_manager_name>{name}</controller_manager_name>" if name else ""
    plugin = (
        "<gazebo><plugin filename='gz_ros2_control-system' name='gz_ros2_control::GazeboSimROS2ControlPlugin'>"
        f"<parameters>/p/controllers.yaml</parameters>{spaced}{named}</plugin></gazebo></robot>"
    )
    urdf = _URDF.format(_JOINT.format("left", interface), _JOINT.format("right", interface))
    tags = (
        '<node pkg="robot_state_publisher" exec="robot_state_publisher" name="rsp"><param name="robot_description" '
        f'value="{urdf.replace("</robot>", plugin).replace("<", "&lt;")}"/></node>',
        '<node pkg="ros_gz_sim" exec="create" name="create" args="-topic robot_description"/>',
        *spawners,
    )
    lines = "\n".join(("//- /robot.launch.xml", "<launch>", *tags, "</launch>"))
    package = "//- /ros_gz_sim/package.xml\n<package><name>ros_gz_sim</name></package>"
    return f"{lines}\n{package}\n{_PACKAGES}{textwrap.dedent(params).strip()}\n{more}"


def spawner(args: str, name: str = "s", program: str = "spawner") -> str:
    """The tag of a spawner."""
    return f'<node pkg="controller_manager" exec="{program}" name="{name}" args="{args}"/>'
