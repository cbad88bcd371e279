"""Topics that parameters name."""

from pathlib import Path

import pytest
from preflight_analysis.findings.finding import Finding
from preflight_analysis.workspace.workspace import Analysis
from support.package_elsewhere import analysed

EKF = """
<launch>
  <node pkg="robot_localization" exec="ekf_node" name="ekf"><param from="$(dirname)/ekf.yaml"/></node>
  <node pkg="wheels" exec="driver" name="driver">
    <!-- <topics><topic name="/odom" type="nav_msgs/msg/Odometry" class="pub"/></topics> -->
  </node>
</launch>
"""
PARAMS = """ekf:
  ros__parameters:
    odom0: /odmo
    imu0: imu/data
    imu0_config: [true]
"""


def ends(analysis: Analysis, node: str) -> list[tuple[str, str, str | None, str | None]]:
    """Role, name, type and parameter of each end that a parameter names."""
    graph = analysis.graph
    assert graph is not None
    at = next(at for at, each in enumerate(graph.tree.nodes) if each.name == node)
    found = graph.interfaces[at].endpoints
    return [(e.role, e.name, e.type, e.named_by.parameter) for e in found if e.named_by is not None]


def finding(analysis: Analysis, rule: str) -> Finding:
    (found,) = [each for each in analysis.findings if each.rule == rule and "odm" in each.message]
    return found


def test_they_are_known_by_what_the_parameters_mean(tmp_path: Path) -> None:
    analysis = analysed(tmp_path, EKF, "a.launch.xml", distro="jazzy", **{"ekf.yaml": PARAMS})
    assert sorted(ends(analysis, "/ekf")) == [
        ("subscriber", "/odmo", "nav_msgs/msg/Odometry", "odom0"),
        ("subscriber", "imu/data", "sensor_msgs/msg/Imu", "imu0"),
    ]


def test_of_a_distribution_that_the_catalogue_does_not_have_in_its_types(tmp_path: Path) -> None:
    launch = """
    <launch>
      <node pkg="robot_localization" type="ekf_localization_node" name="ekf">
        <param name="odom3" value="/odom"/>
      </node>
    </launch>
    """
    analysis = analysed(tmp_path, launch, distro="noetic")
    assert ends(analysis, "/ekf") == [("subscriber", "/odom", "nav_msgs/Odometry", "/ekf/odom3")]


def test_a_finding_is_at_the_parameter_and_mends_it(tmp_path: Path) -> None:
    analysis = analysed(tmp_path, EKF, "a.launch.xml", distro="jazzy", **{"ekf.yaml": PARAMS})
    found = finding(analysis, "TOP001")
    text = analysis.documents[found.location.file].text
    assert text[slice(*found.location.span)] == "odom0"
    (fix,) = found.fixes
    (edit,) = fix.edits
    assert (fix.title, text[slice(*edit.location.span)]) == ("Replace '/odmo' with '/odom'", "/odmo")


def test_a_parameter_of_any_node_that_says_so_by_its_name(tmp_path: Path) -> None:
    launch = """
    <launch>
      <node pkg="mine" type="reader" name="reader">
        <param name="scan_topic" value="/scan"/>
        <param name="frame" value="laser"/>
      </node>
    </launch>
    """
    settings = (
        "nodes: [{package: mine, executable: reader, topics: [{name: /scan, type: sensor_msgs/LaserScan, class: sub}, "
        "{name: laser, type: sensor_msgs/LaserScan, class: sub}]}]"
    )
    analysis = analysed(tmp_path, launch, **{"../../.ros-preflight.yaml": settings})
    assert ends(analysis, "/reader") == [("subscriber", "/scan", "sensor_msgs/LaserScan", "/reader/scan_topic")]


def all_ends(
    folder: Path, node: str, distro: str, files: dict[str, str] | None = None
) -> set[tuple[str, str, str | None]]:
    """Role, name as the node gave it and type of each end of the only node of a launch file."""
    name = "a.launch" if distro == "noetic" else "a.launch.xml"
    graph = analysed(folder, f"<launch>{node}</launch>", name, distro, **(files or {})).graph
    assert graph is not None
    return {(end.role, end.name, end.type) for end in graph.interfaces[0].endpoints if not end.builtin}


@pytest.mark.parametrize("args", ["-topic robot_description -name r -z -0.5", "--topic=robot_description -name r"])
def test_an_option_of_a_command_line_names_a_topic(tmp_path: Path, args: str) -> None:
    node = f'<node pkg="ros_gz_sim" exec="create" name="spawn" args="{args}"/>'
    assert ("subscriber", "robot_description", "std_msgs/msg/String") in all_ends(tmp_path, node, "jazzy")


@pytest.mark.parametrize(
    ("distro", "given"),
    [
        ("humble", 'args="compressed raw"/>'),
        ("jazzy", '><param name="in_transport" value="compressed"/><param name="out_transport" value="raw"/></node>'),
    ],
)
def test_a_transport_is_part_of_the_name(tmp_path: Path, distro: str, given: str) -> None:
    node = f'<node pkg="image_transport" exec="republish" name="r" {given}'
    found = all_ends(tmp_path, node, distro)
    assert ("subscriber", "in/compressed", "sensor_msgs/msg/CompressedImage") in found
    assert ("publisher", "out", "sensor_msgs/msg/Image") in found


SERVO = """
<launch>
  <node pkg="moveit_servo" exec="{}" name="servo"><param from="$(dirname)/servo.yaml"/></node>
</launch>
"""
SERVO_PARAMS = """servo:
  ros__parameters:
    moveit_servo:
      command_out_topic: /arm_controller/{}
      command_out_type: {}
      planning_frame: base_link
"""


def topics_of(analysis: Analysis, role: str) -> dict[str, str | None]:
    assert analysis.graph is not None
    return {end.name: end.type for end in analysis.graph.interfaces[0].endpoints if end.role == role}


@pytest.mark.parametrize(("executable", "distro"), [("servo_node", "jazzy"), ("servo_node_main", "humble")])
def test_a_topic_has_its_parameter_in_the_place_of_the_default(tmp_path: Path, executable: str, distro: str) -> None:
    params = SERVO_PARAMS.format("joint_trajectory", "trajectory_msgs/JointTrajectory")
    analysis = analysed(tmp_path, SERVO.format(executable), "a.launch.xml", distro, **{"servo.yaml": params})
    published = topics_of(analysis, "publisher")
    assert published["/arm_controller/joint_trajectory"] == "trajectory_msgs/msg/JointTrajectory"
    assert "/panda_arm_controller/joint_trajectory" not in published
    assert topics_of(analysis, "subscriber")["~/delta_twist_cmds"] == "geometry_msgs/msg/TwistStamped"


def test_without_the_parameter_it_is_the_default(tmp_path: Path) -> None:
    analysis = analysed(tmp_path, SERVO.format("servo_node"), "a.launch.xml", "jazzy", **{"servo.yaml": "servo: {}"})
    assert "/panda_arm_controller/joint_trajectory" in topics_of(analysis, "publisher")


def test_a_type_that_a_parameter_has(tmp_path: Path) -> None:
    params = SERVO_PARAMS.format("commands", "std_msgs/Float64MultiArray")
    analysis = analysed(tmp_path, SERVO.format("servo_node"), "a.launch.xml", "jazzy", **{"servo.yaml": params})
    assert topics_of(analysis, "publisher")["/arm_controller/commands"] == "std_msgs/msg/Float64MultiArray"


KEYS = """
<launch>
  <node pkg="teleop_twist_keyboard" type="teleop_twist_keyboard.py" name="keys">
    <param name="stamped" value="{}"/>
  </node>
</launch>
"""


@pytest.mark.parametrize(
    ("stamped", "expected"), [("true", "geometry_msgs/TwistStamped"), ("false", "geometry_msgs/Twist")]
)
def test_a_type_that_depends_on_a_parameter_counts_before_that_of_the_catalogue(
    tmp_path: Path, stamped: str, expected: str
) -> None:
    analysis = analysed(tmp_path, KEYS.format(stamped), distro="noetic")
    assert topics_of(analysis, "publisher")["cmd_vel"] == expected


def test_arguments_that_name_topics_of_markers(tmp_path: Path) -> None:
    launch = """
    <launch>
      <node pkg="ar_track_alvar" type="individualMarkersNoKinect" name="tags"
        args="4.4 0.08 0.2 /camera/image_raw /camera/camera_info /base_link"/>
    </launch>
    """
    assert topics_of(analysed(tmp_path, launch, distro="melodic"), "subscriber") == {
        "/camera/image_raw": "sensor_msgs/Image",
        "/camera/camera_info": "sensor_msgs/CameraInfo",
    }


CONTROLLED = """
<launch>
  <node pkg="controller_manager" exec="ros2_control_node" name="controller_manager">
    <param from="$(dirname)/controllers.yaml"/>
  </node>
  <node pkg="controller_manager" exec="spawner" name="spawner" args="base"/>
</launch>
"""
CONTROLLERS = """controller_manager:
  ros__parameters:
    base: {{type: diff_drive_controller/DiffDriveController}}
base:
  ros__parameters:
    left_wheel_names: [left]
    right_wheel_names: [right]
    use_stamped_vel: {}
"""


@pytest.mark.parametrize(
    ("distro", "stamped", "expected"),
    [
        ("humble", "true", {"~/cmd_vel": "geometry_msgs/msg/TwistStamped"}),
        ("humble", "false", {"~/cmd_vel_unstamped": "geometry_msgs/msg/Twist"}),
        ("jazzy", "false", {"~/cmd_vel": "geometry_msgs/msg/TwistStamped"}),
        # Nothing says which distribution it is, but Humble's alone has the parameter.
        (None, "false", {"~/cmd_vel_unstamped": "geometry_msgs/msg/Twist"}),
    ],
)
def test_a_topic_of_velocities_by_distribution(
    tmp_path: Path, distro: str | None, stamped: str, expected: dict[str, str]
) -> None:
    files = {"controllers.yaml": CONTROLLERS.format(stamped)}
    analysis = analysed(tmp_path, CONTROLLED, "a.launch.xml", distro, **files)
    graph = analysis.graph
    assert graph is not None
    at = next(at for at, node in enumerate(graph.tree.nodes) if node.name == "/base")
    ends = graph.interfaces[at].endpoints
    assert {end.name: end.type for end in ends if end.role == "subscriber" and "cmd_vel" in end.name} == expected


FUSED = """
<launch>
  <push_ros_namespace namespace="robot"/>
  <node pkg="robot_localization" exec="ekf_node" name="ekf"><param from="$(dirname)/ekf.yaml"/></node>
  <node pkg="wheels" exec="driver" name="driver">
    <!-- <topics><topic name="odom" type="nav_msgs/msg/Odometry" class="pub"/></topics> -->
  </node>
</launch>
"""


@pytest.mark.parametrize(("topic", "found"), [("/odom", 1), ("odom", 0)])
def test_a_topic_in_a_parameter_is_not_in_the_namespace_of_its_publisher(
    tmp_path: Path, topic: str, found: int
) -> None:
    """As in threads of robot_localization: what a remap would change stands in a parameter."""
    params = f"/**: {{ros__parameters: {{odom0: {topic}}}}}"
    analysis = analysed(tmp_path, FUSED, "a.launch.xml", "jazzy", **{"ekf.yaml": params})
    findings = [each for each in analysis.findings if each.rule == "TOP001" and "odom" in each.message]
    assert len(findings) == found
    for each in findings:
        assert "did you mean '/robot/odom'" in each.message
        assert analysis.documents[each.location.file].path.endswith("ekf.yaml")
        assert [edit.text for fix in each.fixes for edit in fix.edits] == ["/robot/odom"]
