"""PRM001: a parameter is set and nobody reads it."""

from pathlib import Path

import pytest
from support.check import apply, check, findings_of


def test_a_typo_is_a_warning_that_names_what_the_node_reads() -> None:
    text = """
        <launch>
          <node pkg="p" type="t" name="fake">
            <param name="publish_obejcts" value="false"/>
                         ^^^^^^^^^^^^^^^ warning[PRM001] did you mean '/fake/publish_objects', which it reads
            <param name="publish_points" value="true"/>
          </node>
        </launch>
        //- interfaces
        {"/fake": {"params": {"~publish_objects": true, "~publish_points": true, "~rate": 10}}}
    """
    (finding,) = check(text)
    assert "(default True)" in finding.message
    assert '<param name="publish_objects" value="false"/>' in apply(text, finding.fixes[0].edits)["/main.launch"]


def test_a_key_of_a_parameter_file_is_underlined_there() -> None:
    text = """
        <launch>
          <node pkg="p" type="t" name="tank">
            <rosparam command="load" file="/tank.yaml"/>
          </node>
        </launch>
        //- /tank.yaml
        limits:
          max_presure: 4
          ^^^^^^^^^^^ warning[PRM001] did you mean '/tank/limits/max_pressure'
        //- interfaces
        {"/tank": {"params": {"~limits/max_pressure": 6}}}
    """
    (finding,) = check(text)
    assert apply(text, finding.fixes[0].edits)["/tank.yaml"] == "limits:\n  max_pressure: 4\n"


def test_like_words_need_a_fitting_type() -> None:
    text = """
        <launch>
          <node pkg="p" type="t" name="sys">
            <param name="conn/system_time_rate" value="VALUE"/>
                         ^^^^^^^^^^^^^^^^^^^^^ SEVERITY[PRM001]
          </node>
        </launch>
        //- interfaces
        {"/sys": {"params": {"~conn_system_time": 0.5}}}
    """
    check(text.replace("VALUE", "1.0").replace("SEVERITY", "warning"))
    check(text.replace("VALUE", "text").replace("SEVERITY", "hint"))


def test_a_name_that_is_set_is_not_what_was_meant() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="n">
            <param name="rate" value="1"/>
            <param name="rate2" value="1"/>
                         ^^^^^ hint[PRM001] unused parameter '/n/rate2': not read by /n before its event loop, nor by
          </node>
        </launch>
        //- interfaces
        {"/n": {"params": {"~rate": 1}}}
    """)


@pytest.mark.silent
def test_reading_a_namespace_reads_all_in_it() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="n">
            <param name="pid/p" value="1"/>
            <rosparam param="gains">{i: 1, d: {x: 2}}</rosparam>
          </node>
        </launch>
        //- interfaces
        {"/n": {"params": {"~pid": null, "~gains": null}}}
    """)


@pytest.mark.silent
def test_other_nodes_may_read_a_private_parameter_and_has_counts() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="n"><param name="a" value="1"/><param name="b" value="1"/></node>
          <node pkg="p" type="t" name="m"/>
        </launch>
        //- interfaces
        {"/n": {"params": {"~b": {"access": "has"}}}, "/m": {"params": {"/n/a": 1}}}
    """)


@pytest.mark.silent
def test_a_node_that_is_not_known_to_its_end_is_not_judged() -> None:
    for status in ("crashed", "timed-out", "exited"):
        findings = findings_of(
            """
            <launch><node pkg="p" type="t" name="n"><param name="a" value="1"/></node></launch>
            //- interfaces
            {"/n": {"status": "STATUS"}}
            """.replace("STATUS", status)
        )
        assert not [f for f in findings if f.rule == "PRM001"]


@pytest.mark.silent
def test_a_node_that_lists_or_searches_parameters_is_not_judged() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="n"><param name="a" value="1"/></node>
          <node pkg="p" type="t" name="m"><param name="a" value="1"/></node>
        </launch>
        //- interfaces
        {"/n": {"params": {"": {"access": "list"}}}, "/m": {"params": {"a": {"access": "search"}}}}
    """)


@pytest.mark.silent
def test_an_annotation_without_parameters_does_not_speak_of_them() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="n">
            <param name="a" value="1"/>
            <!-- <topics><topic name="/tf" type="tf2_msgs/TFMessage" class="pub"/></topics> -->
          </node>
        </launch>
    """)


def test_a_namespace_that_no_node_has_any_more() -> None:
    text = """
        <launch>
          <param name="/lane_navi/acceleration" value="2.0"/>
                       ^^^^^^^^^^^^^^^^^^^^^^^ warning[PRM001] reads '/lane_rule/acceleration', which is not set
          <group ns="lane_navi">
            <param name="zeros_behind" value="5"/>
                         ^^^^^^^^^^^^ warning[PRM001] unused parameter '/lane_navi/zeros_behind'; /lane_rule reads
          </group>
          <node pkg="p" type="t" name="lane_rule"/>
        </launch>
        //- interfaces
        {"/lane_rule": {"params": {"/lane_rule/acceleration": 1.0, "/lane_rule/zeros_behind": 3}}}
    """
    absolute, relative = check(text)
    assert 'name="/lane_rule/acceleration"' in apply(text, absolute.fixes[0].edits)["/main.launch"]
    assert relative.fixes == ()


def test_a_typo_in_a_global_parameter() -> None:
    check("""
        <launch>
          <param name="/map_fram" value="map"/>
                       ^^^^^^^^^ warning[PRM001] /n reads '/map_frame', which is not set
          <param name="/use_sim_time" value="false"/>
          <param name="/unrelated" value="1"/>
          <node pkg="p" type="t" name="n"/>
        </launch>
        //- interfaces
        {"/n": {"params": {"/map_frame": "odom"}}}
    """)


def test_a_parameter_that_the_nodes_are_known_to_read_or_not_to_read_needs_no_guess() -> None:
    findings = findings_of("""
        <launch>
          <param name="/talkr/rate" value="10"/>
          <param name="/base/speed" value="10"/>
          <node pkg="p" type="t" name="talker"/>
        </launch>
        //- interfaces
        {"/talker": {"params": {"~rate": 5, "/base/speed": 1}}}
    """)
    assert [finding.rule for finding in findings] == ["PRM001"]


def test_a_parameter_outside_the_group_of_its_node_or_in_a_group_too_many() -> None:
    check("""
        <launch>
          <rosparam>
            base: {radius: 0.2}
                   ^^^^^^ warning[PRM001] /robot/base reads '/robot/base/radius', which is not set (default 0.1)
          </rosparam>
          <group ns="robot">
            <node pkg="p" type="t" name="base"/>
            <rosparam>
              arm: {limits: {speed: 2.0}}
                             ^^^^^ warning[PRM001] /arm reads '/arm/limits/speed', which is not set (default 1.0)
            </rosparam>
          </group>
          <node pkg="p" type="t" name="arm"/>
        </launch>
        //- interfaces
        {"/robot/base": {"params": {"~radius": 0.1}}, "/arm": {"params": {"~limits/speed": 1.0}}}
    """)


def test_a_private_parameter_that_its_node_reads_as_a_global_one() -> None:
    check("""
        <launch>
          <group ns="cob">
            <node pkg="p" type="t" name="sound"><param name="mode" value="festival"/></node>
                                                             ^^^^ warning[PRM001] did you mean '/sound/mode', which it
            <node pkg="p" type="t" name="site"><param name="robot" value="wall-e"/></node>
                                                            ^^^^^ warning[PRM001] did you mean '/cob/robot', which it
          </group>
        </launch>
        //- interfaces
        {"/cob/sound": {"params": {"/sound/mode": "espeak"}}, "/cob/site": {"params": {"robot": "robot"}}}
    """)


def test_a_typo_of_a_name_that_a_node_searches_for() -> None:
    text = """
        <launch>
          <param name="tf_prefx" value="r1"/>
                       ^^^^^^^^ warning[PRM001] did you mean '/tf_prefix', for which /ns/n searches?
          <group ns="ns"><node pkg="p" type="t" name="n"/></group>
        </launch>
        //- interfaces
        {"/ns/n": {"params": {"tf_prefix": {"access": "search"}}}}
    """
    (finding,) = check(text)
    mended = apply(text, finding.fixes[0].edits)["/main.launch"]
    assert 'name="tf_prefix"' in mended
    assert findings_of(mended + "\n//- interfaces" + text.partition("//- interfaces")[2]) == []


def test_the_right_name_in_the_wrong_namespace() -> None:
    text = """
        <launch>
          <param name="rate" value="10"/>
                       ^^^^ warning[PRM001] /talker reads '/talker/rate', which is not set and has no default
          <node pkg="p" type="t" name="talker"/>
        </launch>
        //- interfaces
        {"/talker": {"params": {"~rate": null}}}
    """
    (finding,) = check(text)
    mended = apply(text, finding.fixes[0].edits)["/main.launch"]
    assert '<param name="talker/rate" value="10"/>' in mended
    assert findings_of(mended + "\n//- interfaces" + text.partition("//- interfaces")[2]) == []


def test_the_section_of_a_controller_is_read_by_whoever_loads_it() -> None:
    """Joints have the same names in it as in what another node reads of them."""
    text = """
        <launch>
          <rosparam>
            arm_controller: {TYPE, gains: {joint1: 1, joint2: 1, joint3: 1}}
          </rosparam>
          <node pkg="p" type="t" name="gui"/>
          <node pkg="p" type="unknown" name="robot"/>
        </launch>
        //- interfaces
        {"/gui": {"params": {"~zeros/joint1": 0, "~zeros/joint2": 0, "~zeros/joint3": 0}}}
    """
    warned = [f.rule for f in findings_of(text.replace("TYPE", "limit: 3")) if f.severity == "warning"]
    assert warned == ["PRM001"] * 3
    of_plugin = findings_of(text.replace("TYPE", "type: effort_controllers/JointTrajectoryController"))
    assert [f.rule for f in of_plugin] == ["TRC004"]


def test_a_misspelt_mandatory_parameter_is_told_once_where_it_is_written() -> None:
    (finding,) = check("""
        <launch>
          <node pkg="p" type="t" name="n"><param name="sampel_rate" value="3"/></node>
                                                       ^^^^^^^^^^^ warning[PRM001] did you mean '/n/sample_rate'
        </launch>
        //- interfaces
        {"/n": {"params": {"~sample_rate": null}}}
    """)
    assert "which is not set and has no default?" in finding.message
    assert [related.message for related in finding.related] == ["/n reads /n/sample_rate"]


def test_a_parameter_beside_its_node_instead_of_in_it() -> None:
    text = """
        <launch>
          <param name="max_speed" value="0.3"/>
                       ^^^^^^^^^ warning[PRM001] /limiter reads '/limiter/max_speed', which is not set (default 1.0)
          <node pkg="p" type="t" name="limiter"/>
        </launch>
        //- interfaces
        {"/limiter": {"params": {"~max_speed": 1.0, "~ramp": 0.5}}}
    """
    (finding,) = check(text)
    assert finding.confidence == "likely"
    assert 'name="limiter/max_speed"' in apply(text, finding.fixes[0].edits)["/main.launch"]


def test_a_parameter_beside_several_nodes_that_might_have_been_meant_is_an_info() -> None:
    (finding,) = check("""
        <launch>
          <param name="rate" value="5"/>
                       ^^^^ info[PRM001] unused parameter '/rate'; /a reads '/a/rate', which is not set (default 1.0)
          <node pkg="p" type="t" name="a"/>
          <node pkg="p" type="t" name="b"/>
        </launch>
        //- interfaces
        {"/a": {"params": {"~rate": 1.0}}, "/b": {"params": {"~rate": 1.0}}}
    """)
    assert finding.confidence == "possible"
    assert finding.fixes == ()


@pytest.mark.silent
@pytest.mark.parametrize(
    ("value", "reads"),
    [
        ("10", '{"~rate": 10}'),  # it would change nothing
        ("many", '{"~rate": 10}'),
        ("20", '{"~rate": 10, "/rate": 10}'),
        ("20", '{"~rate": 10, "rate": {"access": "search"}}'),
        ("20", '{"~rate": 10, "": {"access": "list"}}'),
    ],
)
def test_a_parameter_beside_its_node_that_says_nothing(value: str, reads: str) -> None:
    text = f"""
        <launch>
          <param name="rate" value="{value}"/>
          <node pkg="p" type="t" name="n"/>
        </launch>
        //- interfaces
        {{"/n": {{"params": {reads}}}}}
    """
    assert findings_of(text) == []


def test_a_name_as_on_the_command_line() -> None:
    check("""
        <launch>
          <node pkg="p" type="unknown" name="laser"><param name="_firmware_version" value="2"/></node>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ info[TRC004]
                                                                 ^^^^^^^^^^^^^^^^^ warning[PRM001] parameter
          <node pkg="p" type="t" name="reads_it"><param name="_odd" value="2"/></node>
          <param name="_of_no_node" value="2"/>
        </launch>
        //- interfaces
        {"/reads_it": {"params": {"~_odd": 1}}}
    """)


def test_a_slip_at_a_node_that_the_catalogue_has() -> None:
    found = findings_of("""
        <launch>
          <node pkg="p" type="move_base" name="move_base">
            <rosparam>
              global_costmap: {rigin_z: 0.0, width: 3, other: 1, minimum_vel: 1.0, update_frequenzy: fast}
              controler_frequency: 3.0
            </rosparam>
          </node>
        </launch>
        //- interfaces
        {"/move_base": {"source": "catalogue", "status": "not-run", "params": {
          "~global_costmap/origin_z": 1.0, "~global_costmap/maximum_vel": 1.0, "~global_costmap/width": 1,
          "~global_costmap/update_frequency": 2.0, "~controller_frequency": null}}}
    """)
    told = [each for each in found if each.rule == "PRM001"]
    assert [(each.severity, each.confidence) for each in told] == [("warning", "possible")] * 2
    assert ["'/move_base/global_costmap/origin_z'" in each.message for each in told].count(True) == 1
    assert ["'/move_base/controller_frequency'" in each.message for each in told].count(True) == 1


_PARTLY = """
    <launch>
      <node pkg="p" type="bagger" name="bagger">
        <param name="stream_time" value="10"/>
        <param name="same_as_default" value="3"/>
        <param name="of_another_kind" value="text"/>
        <param name="given_twice" value="1"/>
        <param name="read" value="1"/>
        <param name="unknown" value="1"/>
        <param name="tpics" value="a"/>
      </node>
      <param name="given_twice" value="2"/>
    </launch>
    //- interfaces
    {"/bagger": {"source": "%s", "status": "crashed", "params": {"stream_time": 30, "same_as_default": 3,
      "of_another_kind": 1, "given_twice": 0, "read": 0, "~read": 0, "~topics": "b"%s}}}
"""


def test_a_node_whose_source_tells_that_it_reads_the_name_elsewhere() -> None:
    told = [each for each in findings_of(_PARTLY % ("source", "")) if each.rule == "PRM001"]
    assert [(each.severity, each.confidence) for each in told] == [("warning", "possible")] * 3
    assert "'/bagger/stream_time' is not read by /bagger; did you mean '/stream_time'" in told[0].message
    assert "'/bagger/same_as_default' is not read by /bagger; did you mean '/same_as_default'" in told[1].message
    assert "'/bagger/tpics' is not read by /bagger; did you mean '/bagger/topics'" in told[2].message


_BESIDE = """
    <launch>
      <param name="fieldname" value="lab"/>
      <param name="same_as_default" value="3"/>
      <param name="of_both" value="1"/>
      <node pkg="p" type="localization" name="localization"/>
      <node pkg="p" type="map" name="map"/>
    </launch>
    //- interfaces
    {"/localization": {"source": "source", "status": "crashed",
                       "params": {"~fieldname": "", "~same_as_default": 3, "~of_both": 0}},
     "/map": {"source": "%s", "status": "not-run", "publishers": {"map": "x/M"}, "params": {"~of_both": 0}}}
"""


def test_a_parameter_beside_the_node_that_its_source_tells_in_part() -> None:
    told = [each for each in findings_of(_BESIDE % "source") if each.rule == "PRM001"]
    assert [(each.severity, each.confidence) for each in told] == [("warning", "possible")]
    assert "'/fieldname'; /localization reads '/localization/fieldname', which is not set" in told[0].message


@pytest.mark.parametrize(("also", "told"), [("", 2), ('<param name="/bridge/mode" value="x"/>', 0)])
def test_a_group_of_parameters_in_the_namespace_of_no_node(also: str, told: int) -> None:
    found = findings_of(f"""
        <launch>
          <param name="/bridge/host" value="localhost"/>
          <param name="/bridge/port" value="2000"/>
          {also}
          <node pkg="p" type="publisher" name="publisher"/>
        </launch>
        //- interfaces
        {{"/publisher": {{"source": "source", "status": "not-run", "params": {{"~host": "127.0.0.1", "~port": 2000}}}}}}
    """)
    assert [each.severity for each in found if each.rule == "PRM001"] == ["warning"] * told


@pytest.mark.parametrize(
    ("name", "value", "told"), [("start_pose", "true", 1), ("start_pose", "false", 0), ("pose", "true", 0)]
)
def test_a_parameter_beside_the_node_that_has_another_value_of_its_own(name: str, value: str, told: int) -> None:
    findings = findings_of(f"""
        <launch>
          <node pkg="p" type="t" name="mapper"><param name="{name}" value="false"/></node>
          <param name="{name}" value="{value}"/>
        </launch>
        //- interfaces
        {{"/mapper": {{"source": "source", "status": "crashed", "params": {{"~{name}": false}}}}}}
    """)
    found = [finding for finding in findings if (finding.rule, finding.severity) == ("PRM001", "warning")]
    assert [f"reads '/mapper/{name}', which is set to False" in finding.message for finding in found] == [True] * told
    assert all(not finding.fixes for finding in found)


@pytest.mark.silent
def test_a_node_of_which_nothing_is_known_may_read_what_is_beside_it() -> None:
    assert "PRM001" not in {each.rule for each in findings_of(_BESIDE % "none")}


def test_the_only_parameter_that_is_left_over_on_either_side() -> None:
    launch = """
        <launch>
          <node pkg="p" type="grasp" name="grasp">
            <param name="load_threshold" value="0.01"/>
            %s
          </node>
        </launch>
        //- interfaces
        {"/grasp": {"params": {"~position_threshold": 0.0, "~rate": 1%s}}}
    """
    told = [each for each in findings_of(launch % ('<param name="rate" value="2"/>', "")) if each.rule == "PRM001"]
    assert [each.severity for each in told] == ["warning"]
    assert "did you mean '/grasp/position_threshold'" in told[0].message
    for more, reads in (("", ""), ('<param name="rate" value="2"/>', ', "~torque": 0')):
        told = [each for each in findings_of(launch % (more, reads)) if each.rule == "PRM001"]
        assert [each.severity for each in told] == ["hint"]


@pytest.mark.silent
@pytest.mark.parametrize(("source", "more"), [("trace", ""), ("source", ', "~": {"access": "list"}')])
def test_a_node_that_ended_early_or_reads_more_than_its_source_tells(source: str, more: str) -> None:
    assert "PRM001" not in {each.rule for each in findings_of(_PARTLY % (source, more))}


@pytest.mark.parametrize(
    ("ns", "also", "told"),
    [("", "", 1), ("local_costmap", "", 0), ("", "other1: 1, other2: 1, other3: 1, other4: 1, other5: 1,", 0)],
)
def test_a_file_that_is_loaded_one_namespace_too_high(ns: str, also: str, told: int) -> None:
    keys = ("frame", "width", "height", "rate")
    findings = findings_of(f"""
        <launch>
          <node pkg="p" type="t" name="base"><rosparam file="/costmap.yaml" ns="{ns}"/></node>
        </launch>
        //- /costmap.yaml
        {{{also} {", ".join(f"{key}: 2" for key in keys)}}}
        //- interfaces
        {{"/base": {{"source": "catalogue", "status": "not-run",
                     "params": {{{", ".join(f'"~local_costmap/{key}": 1' for key in keys)}}}}}}}
    """)
    found = [finding for finding in findings if "parameters of this file" in finding.message]
    assert [(finding.rule, finding.severity) for finding in found] == [("PRM001", "warning")] * told
    assert all("4 parameters of this file" in each.message for each in found)
    assert all(each.message.endswith("it reads them in 'local_costmap'") for each in found)


@pytest.mark.parametrize(("reader", "severity"), [("q", "info"), ("p", "warning")])
def test_a_parameter_that_a_plugin_of_another_package_may_read(tmp_path: Path, reader: str, severity: str) -> None:
    for name in ("p", "q"):
        (tmp_path / name).mkdir()
    (tmp_path / "p" / "main.launch").touch()
    (tmp_path / reader / "plugin.cpp").write_text('rho_ = nh_->param<double>("rho", 1.268);')
    text = f"""
        //- {tmp_path}/p/main.launch
        <launch><param name="rho" value="1.2"/><node pkg="p" type="t" name="n"/></launch>
        //- {tmp_path}/p/package.xml
        <package><name>p</name></package>
        //- {tmp_path}/q/package.xml
        <package><name>q</name></package>
        //- interfaces
        {{"/n": {{"params": {{"~rho": 1.5}}}}}}
    """
    assert [f.severity for f in findings_of(text) if f.rule == "PRM001"] == [severity]


@pytest.mark.silent
@pytest.mark.parametrize(
    ("plugin", "namespace"),
    [("gazebo_ros_control", "gazebo_ros_control"), ("own", "own"), ("own", "gazebo_ros_control")],
)
def test_parameters_of_a_plugin_of_the_simulator(plugin: str, namespace: str) -> None:
    """It reads them below its name, be others of like names read by a node."""
    check(f"""
        <launch>
          <param name="robot_description"
                 value="&lt;robot name='r'&gt;&lt;plugin name='{plugin}' filename='x.so'/&gt;&lt;/robot&gt;"/>
          <param name="{namespace}/j1/p" value="5.0"/>
          <param name="{namespace}/j1/i" value="6.0"/>
          <node pkg="p" type="t" name="ctl"/>
        </launch>
        //- interfaces
        {{"/ctl": {{"params": {{"/gains/j1/p": 1.0, "/gains/j1/i": 1.0, "/robot_description": ""}}}}}}
    """)


def test_parameters_of_no_plugin() -> None:
    found = findings_of("""
        <launch>
          <param name="other/j1/p" value="5.0"/>
          <param name="other/j1/i" value="6.0"/>
          <node pkg="p" type="t" name="ctl"/>
        </launch>
        //- interfaces
        {"/ctl": {"params": {"/gains/j1/p": 1.0, "/gains/j1/i": 1.0}}}
    """)
    assert [each.severity for each in found if each.rule == "PRM001"] == ["warning"] * 2
