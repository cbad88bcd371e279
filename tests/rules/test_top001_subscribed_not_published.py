"""TOP001: a node subscribes to what nobody publishes."""

import json
from pathlib import Path

import pytest
from preflight_analysis.findings.finding import Finding
from preflight_analysis.rules.registry import run_rules
from support import package_elsewhere
from support.check import apply, check, findings_of


def test_a_near_miss_through_a_remap_is_shown_at_the_remap() -> None:
    text = """
        <launch>
          <node pkg="p" type="t" name="talker"/>
          <node pkg="p" type="t" name="listener">
            <remap from="chatter" to="chater"/>
                                      ^^^^^^ warning[TOP001] '/chatter', published by /talker (same type
          </node>
        </launch>
        //- interfaces
        {"/talker": {"publishers": {"chatter": "std_msgs/String"}},
         "/listener": {"subscribers": {"chatter": "std_msgs/String"}}}
    """
    (finding,) = check(text)
    assert finding.confidence == "likely"
    assert "'/chater' has no publisher (subscriber: /listener)" in finding.message
    assert [related.message for related in finding.related] == ["/talker publishes /chatter"]
    (fix,) = finding.fixes
    assert fix.preferred
    assert '<remap from="chatter" to="chatter"/>' in apply(text, fix.edits)["/main.launch"]


def test_a_near_miss_of_a_topic_that_is_made_on_demand_is_no_warning() -> None:
    (finding,) = check("""
        <launch>
          <node pkg="p" type="t" name="talker"/>
          <node pkg="p" type="t" name="lazy">
            <remap from="chatter" to="chater"/>
                                      ^^^^^^ info[TOP001] '/chatter', published by /talker (same type
          </node>
        </launch>
        //- interfaces
        {"/talker": {"publishers": {"chatter": "std_msgs/String"}},
         "/lazy": {"subscribers": {"chatter": "std_msgs/String"}, "on_demand": ["chatter"]}}
    """)
    assert finding.confidence == "possible"


@pytest.mark.parametrize(("other", "severity"), [("map", "warning"), ("odom", "info")])
def test_a_near_miss_of_a_topic_that_may_not_be_made(other: str, severity: str) -> None:
    found = findings_of(f"""
        <launch>
          <node pkg="p" type="t" name="base"/>
          <node pkg="p" type="t" name="filter"/>
          <node pkg="p" type="t" name="rviz"/>
        </launch>
        //- interfaces
        {{"/base": {{"publishers": {{"odom": "x/O"}}}},
         "/filter": {{"subscribers": {{"odoom": "x/O"}}, "similar": ["odoom"]}},
         "/rviz": {{"subscribers": {{"{other}": "x/O"}}}}}}
    """)
    assert [each.severity for each in found if "odoom" in each.message] == [severity]


def test_a_near_miss_through_the_publishers_remap_is_shown_there() -> None:
    text = """
        <launch>
          <group ns="robot">
            <node pkg="p" type="t" name="talker">
              <remap from="out" to="/robot/chater"/>
                                    ^^^^^^^^^^^^^ warning[TOP001] '/robot/chater', published by /robot/talker: did you
            </node>
            <node pkg="p" type="t" name="listener"/>
          </group>
        </launch>
        //- interfaces
        {"/robot/talker": {"publishers": {"out": "std_msgs/String"}},
         "/robot/listener": {"subscribers": {"chatter": "std_msgs/String"}}}
    """
    (finding,) = check(text)
    assert 'to="/robot/chatter"' in apply(text, finding.fixes[0].edits)["/main.launch"]


def _of_one_side(monitor: str, type_: str = "x/Level", other: str = "") -> str:
    said = {
        "/sensor": {"publishers": {"level": "x/Level"}},
        f"{monitor}": {"subscribers": {"level": type_}},
        **({"/other": {"publishers": {"level": "x/Level"}}} if other else {}),
    }
    space, _, name = monitor.rpartition("/")
    return f"""
        <launch>
          <node pkg="p" type="t" name="sensor"><remap from="level" to="raw_level"/></node>
          <node pkg="p" type="t" name="{name}" ns="{space or "/"}"/>
          {other}
        </launch>
        //- interfaces
        {json.dumps(said)}
    """


def test_a_remap_at_one_of_two_ends_that_have_one_name() -> None:
    text = _of_one_side("/monitor")
    (finding,) = findings_of(text)
    assert (finding.rule, finding.severity) == ("TOP001", "warning")
    assert finding.message.startswith("'/raw_level', published by /sensor: did you mean '/level'? /monitor subscribes")
    assert "both have the name '/level' before the remap at /sensor" in finding.message
    assert [fix.title for fix in finding.fixes] == ["Remap 'level' to 'raw_level' in /monitor"]
    mended = apply(text, finding.fixes[0].edits)["/main.launch"]
    assert findings_of(mended + "\n//- interfaces" + text.partition("//- interfaces")[2]) == []


@pytest.mark.parametrize(
    ("file", "around", "severity"),
    [
        ("config/mux.yaml", "topics:\n- {name: tank, topic: raw_level, priority: 10}\n", "info"),
        ("config/mux.yaml", "topics:\n- {name: tank, topic: other, priority: 10}\n", "warning"),
        ("launch/more.launch", "<launch><remap from='level' to='raw_level'/></launch>", "info"),
        ("launch/more.launch", "<launch><remap from='level' to='other'/></launch>", "warning"),
    ],
)
def test_a_multiplexer_or_node_of_another_launch_may_have_the_name(
    tmp_path: Path, file: str, around: str, severity: str
) -> None:
    ends = "<topics><topic name='level' type='x/Level' class='{}'/></topics>"
    text = (
        f"<launch><node pkg='p' type='t' name='sensor'>{ends.format('pub')}<remap from='level' to='raw_level'/></node>"
        f"<node pkg='p' type='t' name='monitor'>{ends.format('sub')}</node></launch>"
    )
    analysis = package_elsewhere.analysed(tmp_path, text, **{file: around})
    assert [each.severity for each in run_rules(analysis.context) if each.rule == "TOP001"] == [severity]


def test_a_remap_at_the_subscriber_alone() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="camera" ns="front"/>
          <node pkg="p" type="t" name="view" ns="front"><remap from="image" to="/stereo/left"/></node>
                                                                                ^^^^^^^^^^^^ warning[TOP001] both have
        </launch>
        //- interfaces
        {"/front/camera": {"publishers": {"image": "sensor_msgs/Image"}},
         "/front/view": {"subscribers": {"image": "sensor_msgs/Image"}}}
    """)


@pytest.mark.parametrize(
    "text",
    [
        _of_one_side("/monitor", "x/Other"),
        _of_one_side("/tank/monitor"),
        # Which of the two was meant is not known.
        _of_one_side("/monitor", other='<node pkg="p" type="t" name="other"><remap from="level" to="oil"/></node>'),
        # Somebody else has the name.
        _of_one_side("/monitor", other='<node pkg="p" type="t" name="other"/>'),
    ],
)
def test_a_remap_at_one_end_that_is_apart_from_the_other(text: str) -> None:
    assert all("before the remap" not in each.message for each in findings_of(text))


def test_a_relative_remap_stays_relative_and_works_in_an_included_file() -> None:
    text = """
        <launch>
          <group ns="robot"><include file="/inc.launch"/></group>
        </launch>
        //- /inc.launch
        <launch>
          <node pkg="p" type="t" name="talker"/>
          <node pkg="p" type="t" name="listener">
            <remap from="in" to="sub/chater"/>
                                 ^^^^^^^^^^ warning[TOP001] '/robot/sub/chatter'
          </node>
        </launch>
        //- interfaces
        {"/robot/talker": {"publishers": {"sub/chatter": "std_msgs/String"}},
         "/robot/listener": {"subscribers": {"in": "std_msgs/String"}}}
    """
    (finding,) = check(text)
    assert 'to="sub/chatter"' in apply(text, finding.fixes[0].edits)["/inc.launch"]
    assert finding.related[-1].message == "included here"


def test_a_node_that_ended_well_or_waited_leaves_the_evidence_as_it_is() -> None:
    for said in ('"status": "exited", "exit_code": 0', '"answers": ["the service of which it waits was made up"]'):
        found = findings_of(
            """
            <launch>
              <group ns="arm"><node pkg="p" type="t" name="driver"/></group>
              <node pkg="p" type="t" name="watch"/>
              <node pkg="p" type="t" name="third"/>
            </launch>
            //- interfaces
            {"/arm/driver": {"publishers": {"joints": "sensor_msgs/JointState"}},
             "/watch": {"subscribers": {"joints": "sensor_msgs/JointState"}}, "/third": {SAID}}
            """.replace("SAID", said)
        )
        assert [(f.severity, f.confidence) for f in found if f.rule == "TOP001"] == [("warning", "possible")]


def test_names_from_source_code_get_a_remap() -> None:
    text = """
        <launch>
          <node pkg="p" type="t" name="lane_select"/>
          <node pkg="p" type="t" name="velocity_set"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[TOP001] did you mean '/base_waypoints'
        </launch>
        //- interfaces
        {"/lane_select": {"publishers": {"base_waypoints": "nav_msgs/Path"}},
         "/velocity_set": {"subscribers": {"base_waypoint": "nav_msgs/Path"}}}
    """
    (finding,) = check(text)
    here, there = (apply(text, fix.edits)["/main.launch"] for fix in finding.fixes)
    assert (
        '<node pkg="p" type="t" name="velocity_set">\n'
        '    <remap from="base_waypoint" to="base_waypoints"/>\n'
        "  </node>" in here
    )
    assert '<remap from="base_waypoints" to="base_waypoint"/>' in there


def test_the_fix_mends_the_finding() -> None:
    text = """
        <launch>
          <node pkg="p" type="t" name="a" ns="x"/>
          <node pkg="p" type="t" name="b" ns="x"/>
        </launch>
        //- interfaces
        {"/x/a": {"publishers": {"scan_raw": "sensor_msgs/LaserScan"}},
         "/x/b": {"subscribers": {"~scan_row": "sensor_msgs/LaserScan"}}}
    """
    (finding,) = [f for f in findings_of(text.replace("~", "")) if f.rule == "TOP001"]
    mended = apply(text.replace("~", ""), finding.fixes[0].edits)["/main.launch"]
    assert findings_of(mended + "\n//- interfaces\n" + text.partition("interfaces\n")[2].replace("~", "")) == []


def test_a_publisher_with_other_subscribers_is_not_offered_to_be_moved() -> None:
    (finding,) = findings_of("""
        <launch>
          <node pkg="p" type="t" name="a"/><node pkg="p" type="t" name="b"/><node pkg="p" type="t" name="c"/>
        </launch>
        //- interfaces
        {"/a": {"publishers": {"scan_raw": "sensor_msgs/LaserScan"}},
         "/b": {"subscribers": {"scan_raw": "sensor_msgs/LaserScan"}},
         "/c": {"subscribers": {"scan_row": "sensor_msgs/LaserScan"}}}
    """)
    assert [fix.title for fix in finding.fixes] == ["Remap 'scan_row' to 'scan_raw' in /c"]


def test_like_words_of_a_specific_type_are_enough_where_both_ends_dangle() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="laser"/>
          <node pkg="p" type="t" name="amcl"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[TOP001] did you mean '/narrow_scan', published by /laser
        </launch>
        //- interfaces
        {"/laser": {"publishers": {"narrow_scan": "sensor_msgs/LaserScan"}},
         "/amcl": {"subscribers": {"scan": "sensor_msgs/LaserScan"}}}
    """)


def test_like_words_of_a_topic_that_is_in_use_are_not() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="laser"/>
          <node pkg="p" type="t" name="amcl"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ hint[TOP001] '/scan' (sensor_msgs/LaserScan) has no publisher in this
          <node pkg="p" type="t" name="docking"/>
        </launch>
        //- interfaces
        {"/laser": {"publishers": {"narrow_scan": "sensor_msgs/LaserScan"}},
         "/docking": {"subscribers": {"narrow_scan": "sensor_msgs/LaserScan"}},
         "/amcl": {"subscribers": {"scan": "sensor_msgs/LaserScan"}}}
    """)


def test_a_like_name_of_another_type_is_no_near_miss() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="talker"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ hint[TOP002] '/chatter' has no subscriber in this launch (publisher:
          <node pkg="p" type="t" name="listener"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ hint[TOP001] '/chater' (std_msgs/Int32) has no publisher in this
        </launch>
        //- interfaces
        {"/talker": {"publishers": {"chatter": "std_msgs/String"}},
         "/listener": {"subscribers": {"chater": "std_msgs/Int32"}}}
    """)


def test_numbered_names_are_no_typos_of_each_other() -> None:
    findings = findings_of("""
        <launch><node pkg="p" type="t" name="a"/><node pkg="p" type="t" name="b"/></launch>
        //- interfaces
        {"/a": {"publishers": {"camera1/image": "sensor_msgs/Image"}},
         "/b": {"subscribers": {"camera2/image": "sensor_msgs/Image"}}}
    """)
    assert {finding.severity for finding in findings} == {"hint"}


def test_what_a_node_takes_in_and_gives_out_are_no_near_miss() -> None:
    findings = findings_of("""
        <launch><node pkg="p" type="t" name="filter"/></launch>
        //- interfaces
        {"/filter": {"publishers": {"imu/data": "sensor_msgs/Imu"}, "subscribers": {"imu/data_raw": "sensor_msgs/Imu"}}}
    """)
    assert {finding.severity for finding in findings} == {"hint"}


def test_the_only_topic_of_the_type_is_named_in_the_hint() -> None:
    (finding,) = [
        f
        for f in findings_of("""
            <launch><node pkg="p" type="t" name="truth"/><node pkg="p" type="t" name="controller"/></launch>
            //- interfaces
            {"/truth": {"publishers": {"/ground_truth/state": "nav_msgs/Odometry"}},
             "/controller": {"subscribers": {"/pose_estimate": "nav_msgs/Odometry"}}}
        """)
        if f.rule == "TOP001"
    ]
    assert finding.severity == "hint"
    assert "'/ground_truth/state', published by /truth, has the same type and no subscriber" in finding.message


def test_in_an_incomplete_graph_a_near_miss_is_less_sure_and_says_why() -> None:
    (finding,) = [
        f
        for f in findings_of("""
            <launch>
              <node pkg="p" type="t" name="a"/><node pkg="p" type="t" name="b"/><node pkg="p" type="t" name="c"/>
            </launch>
            //- interfaces
            {"/a": {"publishers": {"scan_raw": "sensor_msgs/LaserScan"}},
             "/b": {"subscribers": {"scan_row": "sensor_msgs/LaserScan"}}}
        """)
        if f.rule == "TOP001"
    ]
    assert (finding.severity, finding.confidence) == ("warning", "possible")
    assert "; 1 of 3 nodes not fully analysed)" in finding.message


def test_a_namespace_of_a_word_more_is_evidence_even_where_not_all_nodes_are_known() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="ekf"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[TOP001] did you mean '/robot_xl_base_controller/odom'
          <node pkg="p" type="t" name="robot_xl_base_controller"/>
          <node pkg="p" type="t" name="unknown"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ info[TRC004]
        </launch>
        //- interfaces
        {"/ekf": {"subscribers": {"/robot_base_controller/odom": "nav_msgs/Odometry"}},
         "/robot_xl_base_controller": {"publishers": {"~odom": "nav_msgs/Odometry"}}}
    """)


@pytest.mark.silent
def test_what_lives_outside_of_most_launches_may_dangle() -> None:
    check("""
        <launch><node pkg="p" type="t" name="n"/></launch>
        //- interfaces
        {"/n": {"publishers": {"/tf": "tf2_msgs/TFMessage", "/rosout": "rosgraph_msgs/Log",
                               "/diagnostics": "diagnostic_msgs/DiagnosticArray",
                               "image/compressed": "sensor_msgs/CompressedImage",
                               "dock/result": "x/DockActionResult"},
                "subscribers": {"/clock": "rosgraph_msgs/Clock", "initialpose": "x/Pose", "/mine": "x/Y",
                                "dock/goal": "x/DockActionGoal"},
                "builtin": ["/mine"]}}
    """)


@pytest.mark.silent
def test_without_interfaces_nothing_is_said_of_topics() -> None:
    check('<launch><node pkg="p" type="t" name="n"/></launch>')


def test_a_leading_slash_is_evidence_even_of_a_generic_type() -> None:
    text = """
        <launch>
          <group ns="robot">
            <node pkg="p" type="t" name="talker"/>
            <node pkg="p" type="t" name="listener"/>
            ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[TOP001] '/chatter' has no publisher (subscriber:
          </group>
        </launch>
        //- interfaces
        {"/robot/talker": {"publishers": {"chatter": "std_msgs/String"}},
         "/robot/listener": {"subscribers": {"/chatter": "std_msgs/String"}}}
    """
    (finding,) = check(text)
    assert "did you mean '/robot/chatter', published by /robot/talker (same type std_msgs/String;" in finding.message
    assert '<remap from="/chatter" to="/robot/chatter"/>' in apply(text, finding.fixes[0].edits)["/main.launch"]


def test_a_leading_slash_in_a_remap_is_shown_there() -> None:
    check("""
        <launch>
          <group ns="fleet"><group ns="a">
            <node pkg="p" type="t" name="laser"/>
            <node pkg="p" type="t" name="amcl">
              <remap from="in" to="/scan"/>
                                   ^^^^^ warning[TOP001] '/scan' has no publisher (subscriber: /fleet/a/amcl); did you
            </node>
          </group></group>
        </launch>
        //- interfaces
        {"/fleet/a/laser": {"publishers": {"scan": "sensor_msgs/LaserScan"}},
         "/fleet/a/amcl": {"subscribers": {"in": "sensor_msgs/LaserScan"}}}
    """)


def test_a_namespace_more_on_one_side_is_evidence() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="talker" ns="robot"/>
          <node pkg="p" type="t" name="listener"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[TOP001] '/chatter' has no publisher (subscriber:
        </launch>
        //- interfaces
        {"/robot/talker": {"publishers": {"chatter": "std_msgs/String"}},
         "/listener": {"subscribers": {"chatter": "std_msgs/String"}}}
    """)


def test_a_namespace_is_no_evidence_where_several_could_be_meant_or_somebody_else_listens() -> None:
    several = findings_of("""
        <launch>
          <node pkg="p" type="t" name="talker" ns="a"/><node pkg="p" type="t" name="talker" ns="b"/>
          <node pkg="p" type="t" name="listener"/>
        </launch>
        //- interfaces
        {"/a/talker": {"publishers": {"chatter": "std_msgs/String"}},
         "/b/talker": {"publishers": {"chatter": "std_msgs/String"}},
         "/listener": {"subscribers": {"chatter": "std_msgs/String"}}}
    """)
    used = findings_of("""
        <launch>
          <node pkg="p" type="t" name="talker" ns="a"/><node pkg="p" type="t" name="logger" ns="a"/>
          <node pkg="p" type="t" name="listener"/>
        </launch>
        //- interfaces
        {"/a/talker": {"publishers": {"chatter": "std_msgs/String"}},
         "/a/logger": {"subscribers": {"chatter": "std_msgs/String"}},
         "/listener": {"subscribers": {"chatter": "std_msgs/String"}}}
    """)
    assert {f.severity for f in (*several, *used)} == {"hint"}


def test_a_namespace_is_only_a_hint_where_not_all_nodes_are_known() -> None:
    findings = findings_of("""
        <launch>
          <node pkg="p" type="t" name="talker" ns="robot"/><node pkg="p" type="t" name="listener"/>
          <node pkg="p" type="t" name="other"/>
        </launch>
        //- interfaces
        {"/robot/talker": {"publishers": {"chatter": "std_msgs/String"}},
         "/listener": {"subscribers": {"chatter": "std_msgs/String"}}}
    """)
    assert {f.severity for f in findings if f.rule == "TOP001"} == {"hint"}


def test_a_name_of_which_the_node_uses_both_is_no_slip() -> None:
    (finding,) = [
        f
        for f in findings_of("""
            <launch><node pkg="p" type="t" name="source"/><node pkg="p" type="t" name="sink"/></launch>
            //- interfaces
            {"/source": {"publishers": {"status": "std_msgs/String"}},
             "/sink": {"subscribers": {"status": "std_msgs/String", "stats": "std_msgs/String"}}}
        """)
        if f.rule == "TOP001"
    ]
    assert finding.severity == "hint"
    assert "did you mean" not in finding.message


def test_of_several_cameras_none_is_the_one_elsewhere() -> None:
    def severities(cameras: list[str]) -> set[str]:
        nodes = "".join(f'<group ns="{name}"><node pkg="p" type="t" name="cam"/></group>' for name in cameras)
        made = ", ".join(f'"/{name}/cam": {{"publishers": {{"image_raw": "sensor_msgs/Image"}}}}' for name in cameras)
        found = findings_of(f"""
            <launch>{nodes}<node pkg="p" type="t" name="stream"/></launch>
            //- interfaces
            {{{made}, "/stream": {{"subscribers": {{"external/image_raw": "sensor_msgs/Image"}}}}}}
        """)
        return {f.severity for f in found if f.rule == "TOP001"}

    assert severities(["left"]) == {"warning"}
    assert severities(["left", "right"]) == {"hint"}


def test_the_same_topic_of_another_node_is_only_a_hint() -> None:
    text = """
        <launch><node pkg="p" type="t" name="rectifier"/><node pkg="p" type="t" name="detector"/></launch>
        //- interfaces
        {"/rectifier": {"publishers": {"NAME": "sensor_msgs/Image"}},
         "/detector": {"subscribers": {"/camera/image": "sensor_msgs/Image"}}}
    """
    found = {name: findings_of(text.replace("NAME", name)) for name in ("~image", "rectifier/image")}
    told = {name: [f.severity for f in all_ if f.rule == "TOP001"] for name, all_ in found.items()}
    assert told == {"~image": ["hint"], "rectifier/image": ["warning"]}
    (renamed,) = findings_of(text.replace("NAME", "~image").replace("/camera", "/old_rectifier"))
    assert (renamed.rule, renamed.severity) == ("TOP001", "warning")


def test_absence_after_a_made_up_answer_is_not_sure() -> None:
    for answers, sure in (([], "likely"), (["it got an empty scan"], "possible")):
        (finding,) = findings_of(f"""
            <launch><node pkg="p" type="t" name="n"/><node pkg="p" type="t" name="m"/></launch>
            //- interfaces
            {{"/n": {{"publishers": {{"chatter": "std_msgs/String"}}, "answers": {json.dumps(answers)}}},
              "/m": {{"subscribers": {{"chater": "std_msgs/String"}}}}}}
        """)
        assert (finding.rule, finding.confidence) == ("TOP001", sure)


_DISPLAY = """
Visualization Manager:
  Displays:
    - Class: rviz_default_plugins/LaserScan
      Enabled: true
      Topic:
        Depth: 5
        Value: /scna
"""


_BRIDGE = '<node pkg="ros_gz_bridge" exec="parameter_bridge" args="/scan@sensor_msgs/msg/LaserScan[gz.C"/>'


def _findings_in_rviz(folder: Path, args: str, config: str, nodes: str = _BRIDGE) -> list[Finding]:
    text = f'<launch>{nodes}<node pkg="rviz2" exec="rviz2" name="rviz" args="{args}"/></launch>'
    analysis = package_elsewhere.analysed(folder, text, "a.launch.xml", **{"a.rviz": config})
    return [finding for finding in run_rules(analysis.context) if finding.rule == "TOP001"]


def test_a_near_miss_of_a_display_is_shown_in_the_configuration_of_rviz(tmp_path: Path) -> None:
    (finding,) = _findings_in_rviz(tmp_path, "-d $(dirname)/a.rviz", _DISPLAY)
    assert (finding.severity, finding.confidence) == ("warning", "possible")
    assert "'/scna' has no publisher (subscriber: /rviz); did you mean '/scan'" in finding.message
    (edit,) = finding.fixes[0].edits
    span = edit.location.span
    assert edit.location.file.endswith("/a.rviz")
    assert _DISPLAY[: span.start] + edit.text + _DISPLAY[span.end :] == _DISPLAY.replace("/scna", "/scan")
    assert _DISPLAY[finding.location.span.start :].startswith("Value: /scna")


@pytest.mark.silent
@pytest.mark.parametrize(("args", "enabled"), [("-d $(dirname)/a.rviz", "false"), ("", "true"), ("-d /b.rviz", "true")])
def test_a_display_that_is_off_and_a_configuration_that_is_not_used(tmp_path: Path, args: str, enabled: str) -> None:
    assert _findings_in_rviz(tmp_path, args, _DISPLAY.replace("Enabled: true", f"Enabled: {enabled}")) == []


def test_a_display_without_a_publisher_is_a_hint(tmp_path: Path) -> None:
    (finding,) = _findings_in_rviz(tmp_path, "-d $(dirname)/a.rviz", _DISPLAY.replace("/scna", "/rear/points"))
    assert finding.severity == "hint"
    assert "same type" not in finding.message


@pytest.mark.silent
def test_rviz_alone(tmp_path: Path) -> None:
    assert _findings_in_rviz(tmp_path, "-d $(dirname)/a.rviz", _DISPLAY, nodes="") == []


def test_a_node_with_a_random_name_may_publish_anything() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="sub"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ hint[TOP001] 1 of 2 nodes not fully analysed
          <node pkg="p" type="t" name="pub"/>
        </launch>
        //- interfaces
        {"/sub": {"subscribers": {"topics": "std_msgs/String"}},
         "/pub": {"publishers": {"topic3": "std_msgs/String"}, "unnamed": ["topic3"]}}
    """)


_COSTMAP = """
local_costmap:
  local_costmap:
    ros__parameters:
      plugins: [obstacles]
      obstacles:
        plugin: "nav2_costmap_2d::ObstacleLayer"
        observation_sources: scan
        scan: {topic: TOPIC, data_type: LaserScan}
"""


@pytest.mark.parametrize(
    ("topic", "found"),
    [("front/scan", [("warning", True)]), ("/front/scan", []), ("rear/scan", [("hint", True)])],
)
def test_a_name_that_a_costmap_puts_below_its_own(tmp_path: Path, topic: str, found: list[tuple[str, bool]]) -> None:
    text = """
        <launch>
          <node pkg="robot" exec="scanner" name="scanner" namespace="front">
            <!-- <topics><topic name="scan" type="sensor_msgs/msg/LaserScan" class="pub"/></topics> -->
          </node>
          <node pkg="nav2_controller" exec="controller_server"><param from="$(dirname)/nav.yaml"/></node>
        </launch>
    """
    params = _COSTMAP.replace("TOPIC", topic)
    analysis = package_elsewhere.analysed(tmp_path, text, "a.launch.xml", "jazzy", **{"nav.yaml": params})
    told = [each for each in run_rules(analysis.context) if each.rule == "TOP001" and "scan'" in each.message]
    assert [(each.severity, "did you mean '/front/scan'" in each.message) for each in told] == found


@pytest.mark.parametrize("order", [(0, 1), (1, 0)])
def test_a_name_that_another_one_has_below_its_namespace(order: tuple[int, int]) -> None:
    nodes = ('<node pkg="p" type="t" name="one"/>', '<node pkg="p" type="t" name="two" ns="z"/>')
    given = {
        "/one": {"publishers": {"speed": "geometry_msgs/Twist"}},
        "/z/two": {"publishers": {"speed": "geometry_msgs/Twist"}},
        "/user": {"subscribers": {"speeed": "geometry_msgs/Twist"}},
    }
    user = '<node pkg="p" type="t" name="user"/>'
    launch = f"<launch>{''.join(nodes[at] for at in order)}{user}</launch>\n//- interfaces\n{json.dumps(given)}"
    (finding,) = [each for each in findings_of(launch) if each.rule == "TOP001"]
    assert "did you mean '/speed'" in finding.message
