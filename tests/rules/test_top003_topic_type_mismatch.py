"""TOP003: publisher and subscriber of a topic have different types."""

from pathlib import Path

import pytest
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
    assert (finding.severity, finding.confidence) == ("error", "likely")
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
