"""TOP003: publisher and subscriber of a topic have different types."""

from pathlib import Path

import pytest
from preflight_analysis.findings.finding import Finding
from preflight_analysis.rules.registry import run_rules
from support import package_elsewhere
from support.action_interfaces import server
from support.check import check, findings_of


def test_goals_sent_without_a_client_are_a_topic() -> None:
    check(f"""
        <launch>
          <node pkg="p" type="t" name="base"/>
          <node pkg="p" type="t" name="patrol"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ error[TOP003] type mismatch on '/move_base/goal': /base publishes
        </launch>
        //- interfaces
        {{"/patrol": {server("move_base", "m/MoveBaseAction")},
         "/base": {{"publishers": {{"move_base/goal": "geometry_msgs/PoseStamped"}}}}}}
    """)


def test_types_that_differ() -> None:
    text = """
        <launch>
          <node pkg="p" type="t" name="a"/>
          <node pkg="p" type="t" name="b">
            <remap from="in" to="pose"/>
                                 ^^^^ error[TOP003] type mismatch on '/pose': /a publishes x/Pose, /b subscribes to
          </node>
        </launch>
        //- interfaces
        {"/a": {"publishers": {"pose": "x/Pose"}}, "/b": {"subscribers": {"in": "x/PoseStamped"}}}
    """
    (finding,) = check(text)
    assert finding.confidence == "certain"
    assert finding.related[0].message == "/a publishes /pose"


@pytest.mark.parametrize(
    ("type_", "severity"), [("rtabmap_msgs/Data", "info"), ("other_msgs/Data", "error"), ("rtabmap_msgs/Map", "error")]
)
def test_a_message_that_another_version_has_in_another_package(type_: str, severity: str) -> None:
    found = findings_of(f"""
        <launch><node pkg="p" type="t" name="own"/><node pkg="p" type="t" name="slam"/></launch>
        //- interfaces
        {{"/own": {{"publishers": {{"/data": "rtabmap_ros/Data"}}}},
         "/slam": {{"subscribers": {{"/data": "{type_}"}}, "catalogued": "noetic"}}}}
    """)
    assert [each.severity for each in found if each.rule == "TOP003"] == [severity]


def test_one_type_of_two_definitions() -> None:
    (finding,) = findings_of("""
        <launch><node pkg="p" type="t" name="a"/><node pkg="p" type="t" name="b"/></launch>
        //- interfaces
        {"/a": {"publishers": {"pose": "x/Pose"}, "md5": {"pose": "11"}},
         "/b": {"subscribers": {"pose": "x/Pose"}, "md5": {"pose": "22"}}}
    """)
    assert finding.rule == "TOP003"
    assert "MD5 sums 11 and 22" in finding.message


@pytest.mark.silent
def test_any_type_fits_and_so_does_an_unknown_one() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="a"/>
          <node pkg="p" type="t" name="b"/>
          <node pkg="p" type="t" name="c">
            <!-- <topics><topic name="pose" class="sub"/></topics> -->
          </node>
        </launch>
        //- interfaces
        {"/a": {"publishers": {"pose": "x/Pose"}, "md5": {"pose": "11"}},
         "/b": {"subscribers": {"pose": "*"}, "md5": {"pose": "*"}}}
    """)


def test_two_types_of_one_node() -> None:
    found = findings_of("""
        <launch>
          <node pkg="p" type="t" name="simulator"><remap from="throttle" to="mast"/></node>
          <node pkg="p" type="t" name="other"/>
        </launch>
        //- interfaces
        {"/simulator": {"subscribers": {"mast": "x/Position", "throttle": "x/Throttle", "any": "*"}},
         "/other": {"subscribers": {"mast": "x/Velocity"}}}
    """)
    (finding,) = (each for each in found if each.rule == "TOP003")
    assert (finding.severity, finding.confidence) == ("error", "certain")
    assert finding.message == "type mismatch on '/mast': /simulator subscribes to both x/Position and x/Throttle"


@pytest.mark.silent
def test_a_type_as_either_generation_spells_it() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="a"/>
          <node pkg="p" type="t" name="b"/>
        </launch>
        //- interfaces
        {"/a": {"publishers": {"/pose": "x/msg/Pose"}}, "/b": {"subscribers": {"/pose": "x/Pose"}}}
    """)


def test_a_display_of_another_type_is_a_warning(tmp_path: Path) -> None:
    config = (
        "Visualization Manager: {Displays: [{Class: rviz_default_plugins/Path, Enabled: true, Topic: {Value: /scan}}]}"
    )
    bridge = '<node pkg="ros_gz_bridge" exec="parameter_bridge" args="/scan@sensor_msgs/msg/LaserScan[gz.C"/>'
    text = f'<launch>{bridge}<node pkg="rviz2" exec="rviz2" name="rviz" args="-d $(dirname)/a.rviz"/></launch>'
    analysis = package_elsewhere.analysed(tmp_path, text, "a.launch.xml", **{"a.rviz": config})
    (finding,) = (each for each in run_rules(analysis.context) if each.rule == "TOP003")
    assert (finding.severity, finding.confidence) == ("warning", "likely")
    assert finding.location.file.endswith("/a.rviz")


@pytest.mark.silent
def test_one_definition_in_two_packages() -> None:
    check("""
        <launch><node pkg="p" type="t" name="a"/><node pkg="p" type="t" name="b"/></launch>
        //- interfaces
        {"/a": {"publishers": {"/tf": "tf/tfMessage"}}, "/b": {"subscribers": {"/tf": "tf2_msgs/TFMessage"}}}
    """)


_MANAGER = """<node pkg="controller_manager" exec="ros2_control_node" name="controller_manager">
<param from="$(dirname)/c.yaml"/></node><node pkg="controller_manager" exec="spawner" args="base"/>"""
_BASE = """controller_manager: {ros__parameters: {base: {type: diff_drive_controller/DiffDriveController}}}
base: {ros__parameters: {left_wheel_names: [a], right_wheel_names: [b]}}
t: {ros__parameters: {STAMPED}}
"""


def _teleop(folder: Path, package: str, executable: str, stamped: str, distro: str) -> list[Finding]:
    node = f'<node pkg="{package}" exec="{executable}" name="t"><param from="$(dirname)/c.yaml"/>'
    text = f'<launch>{_MANAGER}{node}<remap from="cmd_vel" to="/base/cmd_vel"/></node></launch>'
    files = {"c.yaml": _BASE.replace("STAMPED", stamped)}
    analysis = package_elsewhere.analysed(folder, text, "a.launch.xml", distro, **files)
    return [each for each in run_rules(analysis.context) if each.rule == "TOP003"]


_TELEOPS = [
    ("teleop_twist_keyboard", "teleop_twist_keyboard", "stamped"),
    ("teleop_twist_joy", "teleop_node", "publish_stamped_twist"),
]


@pytest.mark.parametrize(("package", "executable", "param"), _TELEOPS)
@pytest.mark.parametrize("set_to", ["", "False"])
def test_a_velocity_without_a_stamp(tmp_path: Path, package: str, executable: str, param: str, set_to: str) -> None:
    (found,) = _teleop(tmp_path, package, executable, f"{param}: {set_to}" if set_to else "", "jazzy")
    assert found.message.endswith(f"/base subscribes to geometry_msgs/msg/TwistStamped; set '{param}' of /t to true")
    assert (found.severity, found.confidence) == ("error", "likely")
    assert [fix.title for fix in found.fixes] == (["Replace 'False' with 'True'"] if set_to else [])


@pytest.mark.silent
@pytest.mark.parametrize(("package", "executable", "param"), _TELEOPS)
def test_a_velocity_with_a_stamp(tmp_path: Path, package: str, executable: str, param: str) -> None:
    assert not _teleop(tmp_path, package, executable, f"{param}: true", "jazzy")


_NAVIGATION = """<node pkg="nav2_controller" exec="controller_server" name="controller_server">{}</node>
<node pkg="turtlebot3_node" exec="turtlebot3_ros"/>"""


@pytest.mark.parametrize(
    ("set_to", "distro", "severities"),
    [
        ("true", None, []),
        ("true", "jazzy", ["error"]),
        ("true", "kilted", []),
        ("false", "jazzy", []),
        ("", "jazzy", []),
        ("", "kilted", []),
    ],
)
def test_velocities_of_navigation(tmp_path: Path, set_to: str, distro: str | None, severities: list[str]) -> None:
    """What Kilted does without the parameter is not known: its default is another one."""
    param = f'<param name="enable_stamped_cmd_vel" value="{set_to}"/>' if set_to else ""
    text = f"<launch>{_NAVIGATION.format(param)}</launch>"
    analysis = package_elsewhere.analysed(tmp_path, text, "a.launch.xml", distro)
    found = [each for each in run_rules(analysis.context) if each.rule == "TOP003"]
    assert [each.severity for each in found] == severities
    assert all("set 'enable_stamped_cmd_vel' of /controller_server to false" in each.message for each in found)


def test_behaviors_have_the_types_of_their_server(tmp_path: Path) -> None:
    server = '<node pkg="nav2_behaviors" exec="behavior_server"><param name="enable_stamped_cmd_vel" value="true"/>'
    text = f'<launch>{server}</node><node pkg="turtlebot3_node" exec="turtlebot3_ros"/></launch>'
    analysis = package_elsewhere.analysed(tmp_path, text, "a.launch.xml", "jazzy")
    assert analysis.graph is not None
    assert {end.endpoint.type for end in analysis.graph.topics["/cmd_vel"].providers} == {
        "geometry_msgs/msg/TwistStamped"
    }


_BRIDGED = """
<launch>
  <node pkg="ros_gz_bridge" exec="parameter_bridge" name="bridge">
    <param name="config_file" value="$(dirname)/bridge.yaml"/>
  </node>
  <node pkg="teleop_twist_keyboard" exec="teleop_twist_keyboard" name="teleop">{}</node>
</launch>
"""
_BRIDGES = """
- ros_topic_name: cmd_vel
  gz_topic_name: cmd_vel
  ros_type_name: geometry_msgs/msg/{}
  gz_type_name: gz.msgs.Twist
  direction: ROS_TO_GZ
"""


def test_a_bridge_for_another_type_than_the_keyboard_sends(tmp_path: Path) -> None:
    """https://github.com/ROBOTIS-GIT/turtlebot3/issues/1135: the robot stays where it is."""
    launch = _BRIDGED.format("")
    files = {"bridge.yaml": _BRIDGES.format("TwistStamped")}
    analysis = package_elsewhere.analysed(tmp_path, launch, "a.launch.xml", "jazzy", **files)
    (found,) = [each for each in analysis.findings if each.rule == "TOP003"]
    assert "/cmd_vel" in found.message and "set 'stamped' of /teleop to true" in found.message


@pytest.mark.silent
@pytest.mark.parametrize(("param", "type_"), [("", "Twist"), ('<param name="stamped" value="true"/>', "TwistStamped")])
def test_a_bridge_for_the_type_that_the_keyboard_sends(tmp_path: Path, param: str, type_: str) -> None:
    files = {"bridge.yaml": _BRIDGES.format(type_)}
    analysis = package_elsewhere.analysed(tmp_path, _BRIDGED.format(param), "a.launch.xml", "jazzy", **files)
    assert not [each for each in analysis.findings if each.rule == "TOP003"]


@pytest.mark.parametrize(("file", "count"), [("$(find-pkg-share not_here)/a.yaml", 0), ("$(dirname)/c.yaml", 1)])
def test_a_type_that_a_file_which_is_not_here_may_decide(tmp_path: Path, file: str, count: int) -> None:
    node = f'<node pkg="teleop_twist_keyboard" exec="teleop_twist_keyboard" name="t"><param from="{file}"/>'
    text = f'<launch>{_MANAGER}{node}<remap from="cmd_vel" to="/base/cmd_vel"/></node></launch>'
    files = {"c.yaml": _BASE.replace("STAMPED", "")}
    analysis = package_elsewhere.analysed(tmp_path, text, "a.launch.xml", "jazzy", **files)
    assert len([each for each in analysis.findings if each.rule == "TOP003"]) == count
