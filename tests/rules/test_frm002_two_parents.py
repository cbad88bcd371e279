"""FRM002: a frame that two nodes publish."""

import pytest
from support.check import check, findings_of
from support.frame_launch import below, fixture, robot, static

_EKF = '<node pkg="robot_localization" exec="ekf_node" name="ekf">'
_BASE = '<param name="base_link_frame" value="base_link"/></node>'


def test_a_link_below_another_one_and_below_odometry() -> None:
    said = "warning[FRM002] frame 'base_link' has two parents: 'base_footprint' from /rsp (joint j0), 'odom' from /ekf"
    check(fixture(f"{robot(('base_footprint', 'base_link'))}\n{_EKF}\n{_BASE}\n{below(13, 15, said)}"))


def test_two_static_transforms_to_one_frame() -> None:
    node = static("two", "mast", "laser")
    said = "warning[FRM002] frame 'laser' has two parents: 'base' from /one, 'mast' from /two"
    check(fixture(f"{static('one', 'base', 'laser')}\n{node}\n{below(0, len(node.partition('>')[0]) + 1, said)}"))


def test_two_who_publish_the_same() -> None:
    driver = '<node pkg="p" exec="drive" name="drive"/>'
    said = "warning[FRM002] frame 'base_link' has two publishers: /drive (seen in a run) and /ekf"
    nodes = f"{driver}\n{_EKF}\n{_BASE}\n{below(13, 15, said)}"
    check(fixture(nodes, {"/drive": {"frames": [["odom", "base_link"]]}}))


def test_a_joint_that_is_published_again() -> None:
    node = static("again", "base", "laser")
    said = "info[FRM002] frame 'laser' has two publishers: /rsp (joint j0) and /again"
    check(fixture(f"{robot(('base', 'laser'))}\n{node}\n{below(0, len(node.partition('>')[0]) + 1, said)}"))


_PLUGIN = (
    "&lt;gazebo>&lt;plugin filename='libgazebo_ros_diff_drive.so' name='drive'>"
    "&lt;odometry_frame>odom&lt;/odometry_frame>&lt;robot_base_frame>base_link&lt;/robot_base_frame>&lt;/plugin>&lt;/gazebo>&lt;/robot>"
)
_GAZEBO = "\n//- /gazebo_ros/package.xml\n<package><name>gazebo_ros</name></package>"


def test_a_plugin_of_the_simulator() -> None:
    driven = robot(("base_link", "laser")).replace("&lt;/robot>", _PLUGIN)
    said = "info[FRM002] frame 'base_link' has two publishers: /rsp (drive) and /ekf"
    spawn = '<node pkg="gazebo_ros" exec="spawn_entity.py" name="spawn"/>'
    check(fixture(f"{driven}\n{spawn}\n{_EKF}\n{_BASE}\n{below(13, 15, said)}", None, _GAZEBO))
    told = driven.replace("&lt;odometry_frame>", "&lt;publish_odom_tf>true&lt;/publish_odom_tf>&lt;odometry_frame>")
    said = said.replace("info", "warning")
    check(fixture(f"{told}\n{spawn}\n{_EKF}\n{_BASE}\n{below(13, 15, said)}", None, _GAZEBO))
    check(fixture(f"{driven}\n{_EKF}\n{_BASE}"))  # on the robot it does nothing
    system = driven.replace("name='drive'", "name='gz::sim::systems::DiffDrive'")
    check(fixture(f"{system}\n{spawn}\n{_EKF}\n{_BASE}", None, _GAZEBO))


@pytest.mark.silent
@pytest.mark.parametrize(
    "nodes",
    [
        robot(("base_footprint", "base_link"), ("base_link", "laser")),
        static("one", "base", "laser") + static("two", "base", "camera"),
        static("one", "base", "laser", '<remap from="/tf" to="/one/tf"/>') + static("two", "mast", "laser"),
    ],
)
def test_one_parent(nodes: str) -> None:
    check(fixture(nodes))


def test_one_tag_for_two_robots() -> None:
    text = """
        <launch>
          <include file="/ekf.launch" ns="one"/>
          <include file="/ekf.launch" ns="two"/>
        </launch>
        //- /ekf.launch
        <launch>
          <node pkg="robot_localization" type="ekf_localization_node" name="ekf"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ info[FRM002] frame
        </launch>
        //- /robot_localization/package.xml
        <package><name>robot_localization</name></package>
    """
    (found,) = check(text)
    assert found.confidence == "likely"


def test_a_joint_that_moves_and_a_static_transform() -> None:
    """As in blue_bringup: nobody publishes the state of the joints."""
    node = static("again", "base", "thruster")
    said = "info[FRM002] frame 'thruster' has two publishers: /rsp (joint j0) and /again"
    moving = robot(("base", "thruster")).replace("type=&quot;fixed", "type=&quot;continuous")
    (found,) = check(fixture(f"{moving}\n{node}\n{below(0, len(node.partition('>')[0]) + 1, said)}"))
    assert found.confidence == "possible"


@pytest.mark.silent
def test_a_floating_joint_is_published_by_others() -> None:
    floating = robot(("odom", "base_link")).replace("type=&quot;fixed", "type=&quot;floating")
    check(fixture(f"{floating}\n{_EKF}\n{_BASE}"))


@pytest.mark.parametrize(
    ("params", "severities"), [("/p/a.yaml", ["warning"]), ("$(find-pkg-share missing)/a.yaml", [])]
)
def test_a_node_whose_parameter_file_is_not_known(params: str, severities: list[str]) -> None:
    """It may tell the node not to broadcast."""
    found = findings_of(f"""
        //- /a.launch.xml
        <launch>
          <node pkg="slam_toolbox" exec="sync_slam_toolbox_node" name="slam_toolbox"><param from="{params}"/></node>
          <node pkg="tf2_ros" exec="static_transform_publisher" name="s"
                args="--frame-id map --child-frame-id odom"/>
        </launch>
        //- /p/a.yaml
        slam_toolbox:
          ros__parameters:
            odom_frame: odom
    """)
    assert [each.severity for each in found if each.rule == "FRM002"] == severities
