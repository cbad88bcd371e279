"""Launch files of a robot with MoveIt and the controllers that it sends trajectories to, for `check`."""

from __future__ import annotations

import textwrap

from support.check import findings_of

_JOINT = "<joint name='{}' type='continuous'><parent link='{}'/><child link='{}'/></joint>"
URDF = (
    "<robot name='r'><link name='base'/><link name='upper'/><link name='tool'/>"
    f"{_JOINT.format('shoulder', 'base', 'upper')}{_JOINT.format('elbow', 'upper', 'tool')}</robot>"
)
_PACKAGES = """//- interfaces
{}
//- /controller_manager/package.xml
<package><name>controller_manager</name></package>
//- /moveit_ros_move_group/package.xml
<package><name>moveit_ros_move_group</name></package>
"""
CONTROLLERS = """
    /**:
      controller_manager:
        ros__parameters:
          arm: {type: joint_trajectory_controller/JointTrajectoryController}
      arm:
        ros__parameters:
          joints: [shoulder, elbow]
          command_interfaces: [position]
          state_interfaces: [position]
"""
MOVEIT = """
    /**:
      ros__parameters:
        moveit_controller_manager: moveit_simple_controller_manager/MoveItSimpleControllerManager
        moveit_simple_controller_manager:
          controller_names: [arm]
          arm: {type: FollowJointTrajectory, action_ns: follow_joint_trajectory, joints: [shoulder, elbow]}
"""
LIST = """
    controller_list:
      - {name: arm, action_ns: follow_joint_trajectory, type: FollowJointTrajectory, joints: [shoulder, elbow]}
"""


def ros2(moveit: str = MOVEIT, controllers: str = CONTROLLERS, srdf: str = "", namespace: str = "/") -> str:
    """A launch of ROS 2: `namespace` is that of the controller manager."""
    semantic = f'<param name="robot_description_semantic" value="{srdf.replace("<", "&lt;")}"/>' if srdf else ""
    manager = 'pkg="controller_manager" exec="ros2_control_node" name="controller_manager"'
    tags = (
        f'<node {manager} namespace="{namespace}"><param from="/p/controllers.yaml"/></node>',
        f'<node pkg="controller_manager" exec="spawner" name="s" namespace="{namespace}" args="arm"/>',
        '<node pkg="moveit_ros_move_group" exec="move_group" name="move_group"><param from="/p/moveit.yaml"/>'
        f'<param name="robot_description" value="{URDF.replace("<", "&lt;")}"/>{semantic}</node>',
    )
    files = f"//- /p/controllers.yaml\n{_text(controllers)}//- /p/moveit.yaml\n{_text(moveit)}"
    return "\n".join(("//- /robot.launch.xml", "<launch>", *tags, "</launch>", f"{_PACKAGES}{files}"))


def ros1(controller_list: str = LIST, joints: str = "[shoulder, elbow]", name: str = "arm") -> str:
    """A launch of ROS 1: `name` is that of the controller which is loaded."""
    simple = "moveit_simple_controller_manager/MoveItSimpleControllerManager"
    tags = (
        f'<param name="robot_description" value="{URDF.replace("<", "&lt;")}"/>',
        f'<rosparam ns="{name}">{{type: position_controllers/JointTrajectoryController, joints: {joints}}}</rosparam>',
        f'<node pkg="controller_manager" type="spawner" name="s" args="{name}"/>',
        '<node pkg="moveit_ros_move_group" type="move_group" name="move_group"><rosparam file="/p/moveit.yaml"/>'
        f'<param name="moveit_controller_manager" value="{simple}"/></node>',
    )
    return "\n".join(
        (
            "//- /robot.launch",
            "<launch>",
            *tags,
            "</launch>",
            f"{_PACKAGES}//- /p/moveit.yaml\n{_text(controller_list)}",
        )
    )


def _text(yaml: str) -> str:
    return f"{textwrap.dedent(yaml).strip()}\n"


def messages(fixture: str, rule: str) -> list[str]:
    """What a rule says of a fixture."""
    return [each.message for each in findings_of(fixture) if each.rule == rule]
