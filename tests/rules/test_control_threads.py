"""What is said of the configurations that people ask about in public threads: names and structure are theirs."""

from __future__ import annotations

from dataclasses import replace

import pytest
from preflight_analysis.rules.registry import run_rules
from support.check import analyse, read_fixture
from support.control_threads import hardware, launch, manager, publisher, spawner, urdf, workspace

_ARM = ("joint1", "joint2")
_JTC = "joint_trajectory_controller"
_ROBOT = publisher(urdf(_ARM, hardware(_ARM)))


def _said(fixture: str, distro: str = "jazzy") -> list[str]:
    """The findings that are more than hints, each as `severity RULE message`, without what is said of runs."""
    context = analyse(read_fixture(fixture))
    used = replace(context, environment=replace(context.environment, distro=distro))
    found = (each for each in run_rules(used) if each.severity != "hint" and each.rule != "TRC004")
    return [f"{each.severity} {each.rule} {each.message}" for each in found]


def _types(*controllers: str, below: str = "controller_manager") -> str:
    lines = "".join(
        f"\n    {each}: {{type: joint_trajectory_controller/JointTrajectoryController}}" for each in controllers
    )
    return f"{below}:\n  ros__parameters:\n    update_rate: 100{lines}\n"


def _trajectories(name: str, joints: str = "[joint1, joint2]", interface: str = "position") -> str:
    return (
        f"{name}:\n  ros__parameters:\n    joints: {joints}\n    command_interfaces: [{interface}]\n"
        "    state_interfaces: [position]\n"
    )


def _not_set(controller: str, there: str, manager: str = "/controller_manager") -> str:
    return (
        f"warning PRM019 parameter '{controller}.type' of {manager} is not set: the controller is not loaded; {there}"
    )


@pytest.mark.parametrize(
    ("params", "said"),
    [
        # https://github.com/ros-controls/ros2_control/issues/168
        (
            _types()
            + "joint_state_controller:\n  ros__parameters: {type: joint_state_controller/JointStateController}",
            "section 'joint_state_controller' sets it, which has no effect there",
        ),
        # https://github.com/ros-controls/ros2_controllers/issues/153
        (_types("joint_state_broadcaster"), "it has types for 'joint_state_broadcaster'"),
        # https://github.com/ros-controls/roscon2022_workshop/issues/16
        (_types(), "it has no types of controllers"),
    ],
)
def test_a_type_that_the_manager_does_not_have(params: str, said: str) -> None:
    fixture = workspace(launch(_ROBOT, manager(), spawner("joint_state_controller")), {"/p/controllers.yaml": params})
    assert _said(fixture) == [_not_set("joint_state_controller", said)]


def test_a_file_of_the_spawner_for_the_manager() -> None:
    """https://github.com/ros-controls/ros2_control/issues/1506"""
    tags = launch(
        publisher(urdf(_ARM, hardware(_ARM)), "/panther"),
        manager(None, "/panther"),
        spawner(f"{_JTC} -c controller_manager --namespace panther --param-file /p/ur_control.yaml"),
    )
    file = f"""
        /**:
          controller_manager:
            ros__parameters:
              {_JTC}: {{type: joint_trajectory_controller/JointTrajectoryController}}
          {_JTC}:
            ros__parameters: {{joints: [joint1, joint2]}}
    """
    said = _not_set(
        _JTC, "section '/**/controller_manager' sets it, which has no effect there", "/panther/controller_manager"
    )
    assert _said(workspace(tags, {"/p/ur_control.yaml": file})) == [said]


@pytest.mark.parametrize(
    ("file", "key"),
    [
        # https://github.com/ros-controls/ros2_control_demos/issues/605, https://github.com/ros-controls/ros2_control/issues/2049
        ("{0}:\n  ros__parameters: {{type: a/B}}", "{0}"),
        ("rrbot_1:\n  {0}:\n    ros__parameters: {{type: a/B}}", "rrbot_1/{0}"),
        ("/rrbot_1/{0}:\n  ros__parameters: {{type: a/B}}", None),
        ("/**:\n  {0}:\n    ros__parameters: {{type: a/B}}", None),
        ("/**/{0}:\n  ros__parameters: {{type: a/B}}", None),
        ("/**:\n  ros__parameters: {{type: a/B}}", None),
    ],
)
def test_a_section_that_the_spawner_does_not_find(file: str, key: str | None) -> None:
    tags = launch(manager("/p/c.yaml", "/rrbot_1"), spawner(f"{_JTC} -p /p/own.yaml", "/rrbot_1"))
    files = {"/p/c.yaml": _types("other", below="/rrbot_1/controller_manager"), "/p/own.yaml": file.format(_JTC)}
    said = f"section '{(key or '').format(_JTC)}' sets it, which has no effect there"
    assert _said(workspace(tags, files)) == ([_not_set(_JTC, said, "/rrbot_1/controller_manager")] if key else [])


def test_a_type_in_a_namespace_that_is_lacking() -> None:
    """https://github.com/clearpathrobotics/clearpath_robot/issues/289"""
    space = "/a200_0968/manipulators"
    tags = launch(manager("/p/control.yaml", space), spawner("arm_0_joint_trajectory_controller", space))
    file = """
        a200_0968/manipulators:
          controller_manager:
            ros__parameters:
              update_rate: 500
              joint_state_broadcaster: {type: joint_state_broadcaster/JointStateBroadcaster}
          arm_0_joint_trajectory_controller:
            ros__parameters: {joints: [arm_0_elbow_joint]}
    """
    said = _not_set(
        "arm_0_joint_trajectory_controller", "it has types for 'joint_state_broadcaster'", f"{space}/controller_manager"
    )
    assert _said(workspace(tags, {"/p/control.yaml": file})) == [said]


def test_two_managers_in_two_namespaces() -> None:
    """https://github.com/ros-controls/ros2_control/issues/1452, and the names of
    https://github.com/UniversalRobots/Universal_Robots_ROS2_Driver/issues/866"""
    tags = launch(
        *(publisher(urdf(_ARM, hardware(_ARM)), each) for each in ("/ur5e", "/ur10e")),
        *(manager("/p/controllers.yaml", each) for each in ("/ur5e", "/ur10e")),
        spawner(f"{_JTC} --controller-manager /controller_manager --controller-manager-timeout 10", "/ur5e", "a"),
        spawner(_JTC, "/ur10e", "b"),
    )
    params = _types(_JTC, below="/**/controller_manager") + _trajectories(f"/**/{_JTC}")
    assert _said(workspace(tags, {"/p/controllers.yaml": params})) == [
        "warning CTL004 controller manager '/controller_manager' is not in this launch: /ur5e/a waits for it; the "
        "launch has '/ur10e/controller_manager' and '/ur5e/controller_manager'"
    ]


def test_a_simulated_manager_in_a_namespace() -> None:
    """https://github.com/ros-controls/gz_ros2_control/issues/39"""
    plugin = (
        "<gazebo><plugin filename='libign_ros2_control-system.so' name='ign_ros2_control::IgnitionROS2ControlPlugin'>"
        "<ros><namespace>/model/bot</namespace></ros><parameters>/p/controllers.yaml</parameters></plugin></gazebo>"
    )
    tags = launch(
        publisher(urdf(_ARM, plugin + hardware(_ARM))),
        '<node pkg="ros_gz_sim" exec="create" name="create" args="-topic robot_description"/>',
        spawner(_JTC),
    )
    params = _types(_JTC, below="/**/controller_manager") + _trajectories(f"/**/{_JTC}")
    assert _said(workspace(tags, {"/p/controllers.yaml": params})) == [
        "warning CTL004 controller manager '/controller_manager' is not in this launch: /s waits for it; the launch "
        "has '/model/bot/controller_manager'"
    ]


def _of_ros1(
    namespace: str, params: str, more: str = "", joints: tuple[str, ...] = _ARM, controller: str = "arm"
) -> str:
    escaped = urdf(joints, more).replace("<", "&lt;")
    return workspace(
        launch(
            f'<param name="robot_description" value="{escaped}"/>',
            '<node name="spawn" pkg="gazebo_ros" type="spawn_model" args="-urdf -model r -param robot_description"/>',
            '<rosparam file="/p/control.yaml"/>',
            f'<node name="c" pkg="controller_manager" type="spawner" ns="{namespace}" args="{controller}"/>',
        ),
        {"/p/control.yaml": params},
        name="/main.launch",
    )


def _gazebo(namespace: str) -> str:
    return (
        "<gazebo><plugin name='gazebo_ros_control' filename='libgazebo_ros_control.so'>"
        f"<robotNamespace>{namespace}</robotNamespace></plugin></gazebo>"
    )


@pytest.mark.parametrize(("named", "said"), [("/rrbot", True), ("rrbot", True), ("robot", False), ("/robot", False)])
def test_the_namespace_of_a_robot_in_gazebo(named: str, said: bool) -> None:
    """https://github.com/ros-controls/ros_control/issues/243,
    https://github.com/ros-simulation/gazebo_ros_demos/issues/28,
    https://github.com/syuntoku14/fusion2urdf/issues/61"""
    params = "robot: {arm: {type: effort_controllers/JointPositionController, joint: joint1}}"
    found = [each for each in _said(_of_ros1("/robot", params, _gazebo(named)), "noetic") if "CTL004" in each]
    assert found == (
        [
            "warning CTL004 controller manager '/robot/controller_manager' is not in this launch: /robot/c waits for "
            "it; the launch has '/rrbot/controller_manager'"
        ]
        if said
        else []
    )


def test_parameters_in_another_namespace() -> None:
    """https://github.com/qboticslabs/mastering_ros/issues/10"""
    params = "robot: {joint_state_controller: {type: joint_state_controller/JointStateController}}"
    fixture = _of_ros1("/dd_robot", params, controller="joint_state_controller")
    assert _said(fixture, "noetic") == [
        "warning PRM019 parameter '/dd_robot/joint_state_controller/type' is not set, and the controller manager reads "
        "it: the controller is not loaded; did you mean '/robot/joint_state_controller/type'?"
    ]


def test_a_joint_that_the_simulated_robot_lacks() -> None:
    """https://github.com/philwall3/UR5-with-Robotiq-Gripper-and-Kinect/issues/1"""
    params = (
        "gripper: {type: position_controllers/GripperActionController, "
        "joint: simple_gripper_robotiq_85_left_knuckle_joint}"
    )
    joints = ("simple_arm_wrist_1_joint", "simple_gripper_gripper_finger1_joint")
    fixture = _of_ros1("/", params, _gazebo("/"), joints, controller="gripper")
    assert _said(fixture, "noetic") == [
        "warning CTL001 joint 'simple_gripper_robotiq_85_left_knuckle_joint' does not exist: '/gripper' "
        "(position_controllers/GripperActionController) uses it"
    ]


@pytest.mark.parametrize(
    ("in_hardware", "said"),
    [
        # https://github.com/ros-controls/ros2_control/issues/1539
        (
            ("joint1", "joint_2"),
            "error URD007 joint 'joint_2' does not exist: <ros2_control name=\"hw\"> uses it; did you mean 'joint2'?",
        ),
        # https://github.com/Kinovarobotics/ros2_kortex/issues/264
        (
            ("joint1", "robotiq_85_left_knuckle_joint"),
            "error URD007 joint 'robotiq_85_left_knuckle_joint' does not exist: <ros2_control name=\"hw\"> uses it",
        ),
    ],
)
def test_a_joint_that_the_urdf_lacks(in_hardware: tuple[str, ...], said: str) -> None:
    assert _said(workspace(launch(publisher(urdf(_ARM, hardware(in_hardware)))), {})) == [said]


def test_an_interface_that_the_joint_lacks() -> None:
    """https://github.com/ros-controls/ros2_control/issues/1921"""
    params = _types("effort_controllers") + _trajectories("effort_controllers", "[joint1]", "effort")
    fixture = workspace(launch(_ROBOT, manager(), spawner("effort_controllers")), {"/p/controllers.yaml": params})
    assert _said(fixture) == [
        "error CTL002 joint 'joint1' has no command interface 'effort', which 'effort_controllers' "
        "(joint_trajectory_controller/JointTrajectoryController) claims; it has 'position'"
    ]


def test_hardware_that_is_not_read() -> None:
    """https://github.com/ros-controls/ros2_control/issues/1602"""
    assert _said(workspace(launch(publisher(urdf(_ARM, f"<gazebo>{hardware(_ARM)}</gazebo>"))), {})) == [
        'error CTL008 <ros2_control name="hw"> is inside <gazebo>: ros2_control reads only elements below <robot>'
    ]


@pytest.mark.parametrize(("distro", "refused"), [("jazzy", True), ("humble", False)])
def test_a_mimic_joint_with_a_command_interface(distro: str, refused: bool) -> None:
    """https://github.com/PickNikRobotics/moveit_pro_example_ws/pull/915"""
    knuckles = ("robotiq_85_left_knuckle_joint", "robotiq_85_right_knuckle_joint")
    follows = {knuckles[1]: f"type='continuous'><mimic joint='{knuckles[0]}'/>"}
    robot = publisher(urdf(knuckles, hardware(knuckles), types=follows))
    assert _said(workspace(launch(robot), {}), distro) == (
        [
            f"error CTL008 joint '{knuckles[1]}' mimics '{knuckles[0]}' and has a command interface in "
            '<ros2_control name="hw">, which ros2_control refuses'
        ]
        if refused
        else []
    )


@pytest.mark.parametrize(("distro", "affected"), [("humble", True), ("jazzy", False)])
def test_a_colon_in_a_comment(distro: str, affected: bool) -> None:
    """https://github.com/ros-controls/gazebo_ros2_control/issues/295,
    https://github.com/joshnewans/articubot_one/issues/38,
    https://github.com/IFRA-Cranfield/ros2_RobotSimulation/issues/27"""
    plugin = "<gazebo><plugin filename='libgazebo_ros2_control.so' name='g'/></gazebo>\n<!-- TODO: check it -->\n"
    text = urdf(_ARM, plugin + hardware(_ARM)).replace("\n", "\n      ")
    file = f"/**:\n  ros__parameters:\n    robot_description: |\n      {text}\n"
    tag = (
        '<node pkg="robot_state_publisher" exec="robot_state_publisher" name="rsp"><param from="/p/urdf.yaml"/></node>'
    )
    assert _said(workspace(launch(tag), {"/p/urdf.yaml": file}), distro) == (
        ["warning CTL009 gazebo_ros2_control cannot pass on a description with ': ' in it: '<!-- TODO: check it -->'"]
        if affected
        else []
    )


@pytest.mark.parametrize(
    ("name", "said"),
    [
        # https://github.com/moveit/moveit/issues/2433
        ("", "MoveIt controller '' has no action server '/follow_joint_trajectory'"),
        # https://github.com/PickNikRobotics/abb_ros2/issues/27, https://github.com/justagist/panda_simulator/issues/57
        (
            "compliance_controller",
            "MoveIt controller 'compliance_controller' has no action server "
            "'/compliance_controller/follow_joint_trajectory'",
        ),
    ],
)
def test_a_controller_of_moveit_that_nobody_offers(name: str, said: str) -> None:
    escaped = urdf(_ARM).replace("<", "&lt;")
    tags = launch(
        f'<param name="robot_description" value="{escaped}"/>',
        '<rosparam file="/p/arm_controllers.yaml"/>',
        '<node name="s" pkg="controller_manager" type="spawner" args="scaled_pos_traj_controller"/>',
        '<node name="move_group" pkg="moveit_ros_move_group" type="move_group">',
        '<param name="moveit_controller_manager" '
        'value="moveit_simple_controller_manager/MoveItSimpleControllerManager"/>',
        '<rosparam file="/p/controllers.yaml"/></node>',
    )
    files = {
        "interfaces": "{}",
        "/p/arm_controllers.yaml": (
            "scaled_pos_traj_controller: "
            "{type: position_controllers/JointTrajectoryController, joints: [joint1, joint2]}"
        ),
        "/p/controllers.yaml": (
            f'controller_list:\n  - {{name: "{name}", action_ns: follow_joint_trajectory, type: FollowJointTrajectory, '
            "joints: [joint1, joint2]}"
        ),
    }
    assert _said(workspace(tags, files, name="/main.launch"), "noetic") == [
        f"warning MVT001 {said}; did you mean 'scaled_pos_traj_controller', which moves the same joints?"
    ]
