"""PRM019: a controller that its manager knows nothing of."""

import pytest
from support.check import apply, check, findings_of

_MANAGER = """<node pkg="controller_manager" exec="ros2_control_node" name="controller_manager">
            <param from="/p/controllers.yaml"/>
          </node>"""
_FILES = """//- /controller_manager/package.xml
        <package><name>controller_manager</name></package>
        //- /p/controllers.yaml
        controller_manager:
          ros__parameters:
            update_rate: 100
            twist_controller:
              type: picknik_twist_controller/PicknikTwistController
            joint_state_broadcaster:
              type: joint_state_broadcaster/JointStateBroadcaster"""


def test_one_that_no_file_has() -> None:
    check(f"""
        //- /robot.launch.xml
        <launch>
          {_MANAGER}
          <node pkg="controller_manager" exec="spawner" name="s" args="streaming_controller -c /controller_manager"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[PRM019] parameter 'streaming_controller.type' of /controller_manager is not set
          <node pkg="controller_manager" exec="spawner" name="t" args="--inactive twist_controler"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[PRM019] did you mean 'twist_controller'?
        </launch>
        {_FILES}
    """)  # noqa: E501


def test_what_moveit_is_told_of_controllers_is_none_of_the_managers() -> None:
    """As in KarolineH/gen3_6dof_vision_moveit_config."""
    (found,) = findings_of(f"""
        //- /robot.launch.xml
        <launch>
          {_MANAGER}
          <node pkg="controller_manager" exec="spawner" name="s" args="streaming_controller"/>
        </launch>
        {_FILES}
            moveit_simple_controller_manager:
              arm_controller:
                type: FollowJointTrajectory
    """)
    assert found.message.endswith("it has types for 'twist_controller' and 'joint_state_broadcaster'")


def test_a_manager_that_the_launch_does_not_name() -> None:
    check(f"""
        //- /robot.launch.xml
        <launch>
          {_MANAGER.replace(' name="controller_manager"', "")}
          <node pkg="controller_manager" exec="spawner" name="s" args="twist_controller other"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[PRM019] 'other.type'
        </launch>
        {_FILES}
    """)  # noqa: E501


_SIMULATED = """//- /ros_gz_sim/package.xml
        <package><name>ros_gz_sim</name></package>
        //- /robot_state_publisher/package.xml
        <package><name>robot_state_publisher</name></package>
        //- /p/urdf.yaml
        /**:
          ros__parameters:
            robot_description: >
              <robot><gazebo><plugin filename="gz_ros2_control-system" name="g">
              <parameters>{}</parameters></plugin></gazebo></robot>"""
_ROBOT = """<node pkg="robot_state_publisher" exec="robot_state_publisher" name="r"><param from="/p/urdf.yaml"/></node>
          <node pkg="ros_gz_sim" exec="create" name="c" args="-topic robot_description"/>"""


def test_a_manager_in_a_simulator() -> None:
    check(f"""
        //- /robot.launch.xml
        <launch>
          {_ROBOT}
          <node pkg="controller_manager" exec="spawner" name="s" args="twist_controller other"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[PRM019] 'other.type'
        </launch>
        {_FILES}
        {_SIMULATED.format("/p/controllers.yaml")}
    """)  # noqa: E501


@pytest.mark.silent
def test_a_manager_in_a_simulator_whose_file_is_not_here() -> None:
    check(f"""
        //- /robot.launch.xml
        <launch>
          {_ROBOT}
          <node pkg="controller_manager" exec="spawner" name="s" args="twist_controller other"/>
        </launch>
        {_FILES}
        {_SIMULATED.format("/p/controllers.yaml</parameters><parameters>/p/another.yaml")}
    """)


def test_a_manager_in_a_program_of_the_projects_own() -> None:
    manager = _MANAGER.replace(' name="controller_manager"', "").replace("ros2_control_node", "own_control_node")
    check(f"""
        //- /robot.launch.xml
        <launch>
          {manager.replace('pkg="controller_manager"', 'pkg="p"')}
          <node pkg="controller_manager" exec="spawner" name="s" args="other"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[PRM019] 'other.type'
        </launch>
        {_FILES}
    """)


@pytest.mark.silent
def test_what_is_known_or_may_be() -> None:
    check(f"""
        //- /robot.launch.xml
        <launch>
          {_MANAGER}
          <node pkg="controller_manager" exec="spawner" name="a" args="twist_controller joint_state_broadcaster"/>
          <node pkg="controller_manager" exec="spawner" name="b" args="x -c /robot/controller_manager"/>
          <node pkg="controller_manager" exec="spawner" name="c" args="other --param-file other"/>
          <node pkg="controller_manager" exec="spawner" name="d" args="other -t a/Type"/>
          <node pkg="controller_manager" exec="spawner" name="f" args="--switch-timeout 5 twist_controller --ros-args"/>
        </launch>
        {_FILES}
    """)


_ROS1 = """
    <launch>
      <group ns="arm">
        <rosparam>
          elbow_controller: {type: effort_controllers/JointPositionController, joint: elbow}
          gripper: {type: position_controllers/GripperActionController}
        </rosparam>
        <node pkg="controller_manager" type="spawner" name="s" args="--timeout 5 gripper %s"/>
      </group>
      %s
    </launch>
    //- /controller_manager/package.xml
    <package><name>controller_manager</name></package>
"""


@pytest.mark.parametrize(
    ("args", "more", "said"),
    [
        ("elbowf_controller", "", "did you mean 'elbow_controller'?"),
        ("wrist", "", "parameter '/arm/wrist/type' is not set"),
        ("elbowf_controller", '<include file="$(find elsewhere)/a.launch"/>', "did you mean 'elbow_controller'?"),
        ("wrist", '<include file="$(find elsewhere)/a.launch"/>', "info: parameter '/arm/wrist/type' is not set"),
        ("elbow_controller", "", None),
        ("--namespace /arm wrist", "", "parameter '/arm/wrist/type' is not set"),
        ("--namespace /other wrist", "", "did you mean '/arm/gripper/type'?"),
    ],
)
def test_a_controller_of_ros_1(args: str, more: str, said: str | None) -> None:
    told = [each for each in findings_of(_ROS1 % (args, more)) if each.rule == "PRM019"]
    severity, _, message = (said or "").rpartition(": ")
    assert [each.severity for each in told] == ([severity or "warning"] if said else [])
    assert all(message in each.message for each in told)
    fixes = [fix.title for each in told for fix in each.fixes]
    assert fixes == (["Replace 'elbowf_controller' with 'elbow_controller'"] if "elbow_" in message else [])


@pytest.mark.silent
def test_a_controller_that_is_remapped() -> None:
    """https://github.com/code-iai/iai_pr2: the manager reads the parameters under the other name."""
    fixture = _ROS1 % ("arm_controller", "")
    remap = '<remap from="/arm/arm_controller" to="/arm/elbow_controller"/>'
    assert [each.rule for each in findings_of(fixture.replace('<group ns="arm">', f'<group ns="arm">{remap}'))] == []


@pytest.mark.parametrize(("file", "severity"), [("$(arg robot)", "info"), ("arm6", "warning")])
def test_a_branch_that_goes_with_another_file_of_parameters(file: str, severity: str) -> None:
    check(
        f"""
        <launch>
          <arg name="robot" default="arm6"/>
          <arg name="is7dof" default="false"/>
          <param name="robot" value="$(arg robot)"/>
          <rosparam file="/{file}.yaml"/>
          <node if="$(arg is7dof)" pkg="controller_manager" type="spawner" name="s" args="joint_7"/>
          {"^" * 90} {severity}[PRM019] '/joint_7/type'
        </launch>
        //- /arm6.yaml
        joint_6: {{type: position_controllers/JointPositionController}}
        //- /controller_manager/package.xml
        <package><name>controller_manager</name></package>
        """,
        branches=True,
    )


@pytest.mark.parametrize(
    ("args", "after"),
    [
        ("-c /controller_manager twist_controler", "-c /controller_manager twist_controller"),
        ("twist_controler twist_controler", None),
        ("twist_controler twist_controller", None),  # which one is it then?
    ],
)
def test_a_slip_is_mended_in_the_arguments(args: str, after: str | None) -> None:
    launch = f"""
        //- /robot.launch.xml
        <launch>
          {_MANAGER}
          <node pkg="controller_manager" exec="spawner" name="t" args="{args}"/>
        </launch>
        {_FILES}
    """
    fixes = [fix for each in findings_of(launch) if each.rule == "PRM019" for fix in each.fixes]
    texts = [apply(launch, fix.edits)["/robot.launch.xml"] for fix in fixes]
    assert [f'args="{after}"' in text for text in texts] == ([True] if after is not None else [])
