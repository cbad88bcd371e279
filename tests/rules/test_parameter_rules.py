"""PRM: parameters that nobody reads, and files of parameters."""

from pathlib import Path

import pytest
from preflight_analysis.environment.model import Environment, Package
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace
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
                         ^^^^^ hint[PRM001] /n does not read parameter '/n/rate2'
          </node>
        </launch>
        //- interfaces
        {"/n": {"params": {"~rate": 1}}}
    """)


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


def test_other_nodes_may_read_a_private_parameter_and_has_counts() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="n"><param name="a" value="1"/><param name="b" value="1"/></node>
          <node pkg="p" type="t" name="m"/>
        </launch>
        //- interfaces
        {"/n": {"params": {"~b": {"access": "has"}}}, "/m": {"params": {"/n/a": 1}}}
    """)


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


def test_a_node_that_lists_or_searches_parameters_is_not_judged() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="n"><param name="a" value="1"/></node>
          <node pkg="p" type="t" name="m"><param name="a" value="1"/></node>
        </launch>
        //- interfaces
        {"/n": {"params": {"": {"access": "list"}}}, "/m": {"params": {"a": {"access": "search"}}}}
    """)


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
                         ^^^^^^^^^^^^ warning[PRM001] no node reads parameter '/lane_navi/zeros_behind'
          </group>
          <node pkg="p" type="t" name="lane_rule"/>
        </launch>
        //- interfaces
        {"/lane_rule": {"params": {"/lane_rule/acceleration": 1.0, "/lane_rule/zeros_behind": 3}}}
    """
    absolute, relative = check(text)
    assert 'name="/lane_rule/acceleration"' in apply(text, absolute.fixes[0].edits)["/main.launch"]
    assert relative.fixes == ()


def test_a_common_leaf_name_alone_is_no_evidence() -> None:
    check("""
        <launch>
          <param name="/camera_driver/frame_id" value="front"/>
                       ^^^^^^^^^^^^^^^^^^^^^^^ hint[PRM007] no node of this launch is called '/camera_driver'
          <node pkg="p" type="t" name="laser"/>
        </launch>
        //- interfaces
        {"/laser": {"params": {"~frame_id": "laser"}}}
    """)


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


def test_a_parameter_file_that_is_not_there(tmp_path: Path) -> None:
    (tmp_path / "teleop.yaml").write_text("a: 1\n")
    (finding,) = findings_of(f'<launch><rosparam command="load" file="{tmp_path}/telop.yaml"/></launch>')
    assert (finding.rule, finding.severity, finding.stops_launch) == ("PRM002", "error", True)
    assert finding.message.endswith(f"telop.yaml' does not exist; did you mean '{tmp_path}/teleop.yaml'?")
    assert [edit.text for edit in finding.fixes[0].edits] == ["teleop.yaml"]


def test_a_parameter_file_that_is_a_folder(tmp_path: Path) -> None:
    (finding,) = findings_of(f'<launch><param name="a" textfile="{tmp_path}"/></launch>')
    assert finding.rule == "PRM003"


def test_parameters_that_are_not_yaml() -> None:
    findings = findings_of("<launch><rosparam>{a: [1}</rosparam></launch>")
    assert [finding.rule for finding in findings] == ["PRM004"]
    assert check("<launch><rosparam>{a: [1]}</rosparam></launch>") == []


def test_a_parameter_set_twice_where_the_lost_value_is_easily_missed() -> None:
    first, *_ = check("""
        <launch>
          <param name="use_sim_time" value="true"/>
                       ^^^^^^^^^^^^ warning[PRM006] an include that comes later sets it again, to 'false'
          <param name="n/rate" value="1"/>
                       ^^^^^^ warning[PRM006] it is set again below, to '2'
          <node pkg="p" type="t" name="n">
            <param name="rate" value="2"/>
            <param name="limit" value="3"/>
            <rosparam>{limit: 4}</rosparam>
                       ^^^^^ warning[PRM006] in a <node> each <param> comes after the <rosparam>s, and sets it, to '3'
            <param name="tolerance" value="0.2"/>
                         ^^^^^^^^^ warning[PRM006] '/n/tolerance' is set to '0.2' here, which does not count
            <param name="tolerance" value="0.1"/>
          </node>
          <group>
            <param name="~frame" value="map"/>
            <node pkg="p" type="t" name="m"><rosparam param="frame">odom</rosparam></node>
                                            ^^^^^^^^^^^^^^^^^^^^^^^^ warning[PRM006] a <param> of a ~name
          </group>
          <param name="m/gain" value="1"/>
                       ^^^^^^ warning[PRM006] the file that is loaded later sets it again, to '2'
          <rosparam file="/gains.yaml"/>
          <include file="/inc.launch"/>
        </launch>
        //- /inc.launch
        <launch><param name="use_sim_time" value="false"/></launch>
        //- /gains.yaml
        m: {gain: 2}
    """)
    assert first.related[0].location.file == "/inc.launch"


def test_parameters_that_are_overridden_on_purpose() -> None:
    check("""
        <launch>
          <arg name="sim" default="true"/>
          <param name="use_sim_time" value="false"/>
          <param name="use_sim_time" value="true" if="$(arg sim)"/>
          <include file="/inc.launch"/>
          <param name="speed" value="2"/>
          <param name="mode" value="1"/>
          <include file="/mode.launch" if="$(arg sim)"/>
          <param name="~rate" value="1"/>
          <node pkg="p" type="t" name="n">
            <param name="rate" value="2"/>
            <rosparam file="/defaults.yaml"/>
            <param name="gain" value="3"/>
            <param name="same" value="3"/>
            <param name="same" value="3"/>
          </node>
        </launch>
        //- /inc.launch
        <launch><param name="speed" value="1"/></launch>
        //- /mode.launch
        <launch><param name="mode" value="2"/></launch>
        //- /defaults.yaml
        {rate: 5, gain: 1}
    """)


def test_settings_that_may_be_layers_are_hints() -> None:
    check("""
        <launch>
          <rosparam param="a">{x: 1, y: 2}</rosparam>
                               ^ hint[PRM006] '/a/x' is set to '1' here, which does not count: a <rosparam> after it
          <rosparam param="a">{x: 3}</rosparam>
          <include file="/one.launch"/>
          <include file="/two.launch"/>
        </launch>
        //- /one.launch
        <launch><param name="speed" value="1"/></launch>
                             ^^^^^ hint[PRM006] another included file sets it again, to '2'
        //- /two.launch
        <launch><param name="speed" value="2"/></launch>
    """)


def test_a_key_that_stands_twice_in_a_dictionary() -> None:
    check("""
        <launch>
          <rosparam file="/a.yaml"/>
          <rosparam>{rate: 1, rate: 1}</rosparam>
        </launch>
        //- /a.yaml
        costmap:
        ^^^^^^^ warning[PRM006] 'costmap' stands twice in this dictionary: the later one counts, all of this is dropped
          width: 3
        costmap:
          height: 4
        lists: [{a: 1}, {a: 2}]
    """)


def test_a_parameter_for_a_node_that_is_called_otherwise() -> None:
    text = """
        <launch>
          <param name="/talkr/rate" value="10"/>
                       ^^^^^^^^^^^ warning[PRM007] no node is called '/talkr', for which parameter '/talkr/rate' is set
          <node pkg="p" type="t" name="talker"/>
          <group ns="robot"><node pkg="p" type="t" name="n"/></group>
          <param name="robto/n/rate" value="1"/>
                       ^^^^^^^^^^^^ warning[PRM007] did you mean '/robot'?
          <param name="base/rate" value="1"/>
                       ^^^^^^^^^ hint[PRM007] no node of this launch is called '/base' or is in that namespace
        </launch>
    """
    first, *_ = check(text)
    assert 'name="/talker/rate"' in apply(text, first.fixes[0].edits)["/main.launch"]


def test_parameters_that_need_no_node() -> None:
    check("""
        <launch>
          <param name="/use_sim_time" value="true"/>
          <param name="/robot_description_kinematics/arm" value="x"/>
          <param name="robot/rate" value="1"/>
          <rosparam>{controller: {p: 1}, nodes: {x: 1}, node2: {x: 1}}</rosparam>
          <param name="arm_controller/type" value="position"/>
          <param name="arm_controller/joint" value="elbow"/>
          <param name="leg_controller/joint" value="knee"/>
          <node pkg="p" type="t" name="spawner" args="leg_controller"/>
          <node pkg="p" type="t" name="node"/>
          <node pkg="p" type="t" name="node1" ns="robot"><param name="below/rate" value="1"/></node>
        </launch>
    """)


def test_parameters_of_a_launch_file_without_nodes() -> None:
    check('<launch><param name="talkr/rate" value="10"/></launch>')


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


def test_a_file_that_comes_to_be_between_two_edits_is_there(tmp_path: Path) -> None:
    share = tmp_path / "p"
    share.mkdir()
    text = '<launch><param name="map" value="$(find p)/office.yaml"/><node pkg="p" type="t" name="n{}"/></launch>'
    launch = share / "main.launch"
    launch.write_text(text)
    packages = {"p": Package("p", str(share), f"{share}/package.xml")}
    sources = Sources()
    workspace = Workspace(Environment(1, "noetic", {}, (), packages, {}, (), (), None), sources, str(share))

    def rules() -> list[str]:
        return [finding.rule for finding in workspace.static(str(launch)).findings]

    assert "PRM005" in rules()
    sources.open(str(launch), text.format(1))
    assert "PRM005" in rules()
    (share / "office.yaml").write_text("a: 1")
    sources.open(str(launch), text.format(2))
    assert "PRM005" not in rules()
    (share / "office.yaml").unlink()
    sources.open(str(launch), text.format(3))
    assert "PRM005" in rules()


def test_a_file_that_a_parameter_names_and_that_is_not_there() -> None:
    check("""
        <launch>
          <param name="map" value="$(find p)/maps/office.yaml"/>
                                   ^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[PRM005] 'p/maps/office.yaml' in parameter 'map'
          <param name="info" value="file://$(find p)/left.yaml"/>
                                    ^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[PRM005] 'p/left.yaml' in parameter 'info'
          <param name="mesh" value="package://p/arm.dae"/>
                                    ^^^^^^^^^^^^^^^^^^^ warning[PRM005] 'p/arm.dae' in parameter 'mesh'
          <param name="list" value="$(find p)/a.yaml:$(find p)/b.yaml"/>
                                    ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[PRM005] 'p/b.yaml'
          <rosparam file="/p/a.yaml"/>
          <rosparam subst_value="true">pose: $(find p)/pose.yaml</rosparam>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[PRM005] 'p/pose.yaml' in parameter 'pose'
          <node pkg="p" type="t" name="n" args="-d $(find p)/all.rviz _a:=$(find p)/b.csv"/>
                                                ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[PRM005] 'p/all.rviz'
                                                ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[PRM005] 'p/b.csv'
        </launch>
        //- /p/a.yaml
        a: 1
    """)


def test_a_file_that_is_made_from_arguments_is_shown_where_its_folder_is_written() -> None:
    check("""
        <launch>
          <arg name="world" default="office"/>
          <include file="/inc.launch"><arg name="file" value="$(find p)/worlds/$(arg world).world"/></include>
                                                              ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[PRM005]
        </launch>
        //- /inc.launch
        <launch><arg name="file"/><node pkg="p" type="t" name="n" args="-e $(arg file)"/></launch>
    """)


def test_a_model_that_is_not_there_may_have_to_be_fetched() -> None:
    check("""
        <launch>
          <param name="model" value="$(find p)/trained/net.npz"/>
                                     ^^^^^^^^^^^^^^^^^^^^^^^^^ info[PRM005] it may have to be fetched first
        </launch>
    """)


def test_a_file_that_is_there_or_need_not_be() -> None:
    check("""
        <launch>
          <param name="here" value="$(dirname)/p/a.yaml"/>
          <rosparam file="/p/a.yaml"/>
          <param name="output_file" value="$(find p)/new.yaml"/>
          <param name="trajectory" value="$(find p)/logs/new.csv"/>
          <param name="images" value="$(find p)/left_%04d.png"/>
          <param name="camera" value="package://p/${NAME}.yaml"/>
          <param name="mesh" value="package://elsewhere/arm.dae"/>
          <param name="model" value="model://ground/ground.sdf"/>
          <param name="folder" value="$(find p)/maps"/>
          <param name="version" value="/p/1.0"/>
          <param name="other" value="/srv/maps/office.yaml"/>
          <param name="text" value="see $(find p)/README.md"/>
          <node pkg="rosbag" type="record" name="rec" args="-O $(find p)/run.dat"/>
          <node pkg="p" type="map_saver" name="saver" args="-f $(find p)/map.yaml"/>
          <node pkg="p" type="t" name="n" args="--log-file=$(find p)/n.txt -o $(find p)/n.csv"/>
        </launch>
        //- /p/a.yaml
        a: 1
        //- /rosbag/package.xml
        <package/>
    """)


def test_a_file_that_is_not_there_is_shown_where_it_is_written() -> None:
    text = """
        <launch>
          <include file="/inc.launch"><arg name="map" value="$(find p)/ofice.yaml"/></include>
                                                             ^^^^^^^^^^^^^^^^^^^^ warning[PRM005] 'p/ofice.yaml' in
        </launch>
        //- /inc.launch
        <launch>
          <arg name="map" default=""/>
          <arg name="copy" value="$(arg map)"/>
          <node pkg="p" type="t" name="n"><param name="map" value="$(arg copy)"/></node>
        </launch>
    """
    (finding,) = check(text)
    assert finding.related[0].message == "parameter 'map' is given here"
    assert finding.related[0].location.file == "/inc.launch"


def test_the_file_that_was_meant_may_be_in_another_folder(tmp_path: Path) -> None:
    share = tmp_path / "camera"
    (share / "config" / "calibration").mkdir(parents=True)
    (share / "config" / "calibration" / "left_7cd1.yaml").touch()
    launch = share / "camera.launch"
    launch.write_text(
        '<launch><arg name="serial" default="7cd1"/>'
        '<param name="info" value="file://$(find camera)/config/left_$(arg serial).yaml"/></launch>'
    )
    packages = {"camera": Package("camera", str(share), f"{share}/package.xml")}
    environment = Environment(1, "noetic", {}, (), packages, {}, (), (), None)
    (finding,) = Workspace(environment, Sources(), str(share)).static(str(launch)).findings
    assert finding.message.endswith("did you mean 'camera/config/calibration/left_7cd1.yaml'?")
    assert finding.confidence == "likely"
    assert [(edit.text) for edit in finding.fixes[0].edits] == ["/config/calibration/"]


def test_a_dictionary_for_a_node_that_is_called_otherwise() -> None:
    text = """
        <launch>
          <rosparam file="/a.yaml"/>
          <node pkg="p" type="t" name="talker"/>
        </launch>
        //- /a.yaml
        talkr:
        ^^^^^ warning[PRM007] for which parameter '/talkr/rate' and 1 more are set; did you mean '/talker'?
          rate: 3
          sub: {limit: 4}
    """
    (finding,) = check(text)
    assert apply(text, finding.fixes[0].edits)["/a.yaml"].startswith("talker:\n  rate: 3")


def test_a_private_parameter_around_a_node_that_is_named_in_full_as_well() -> None:
    check("""
        <launch>
          <param name="~rate" value="1"/>
          <param name="n/rate" value="2"/>
                       ^^^^^^ warning[PRM006] a <param> of a ~name before it is for the node, which comes later
          <node pkg="p" type="t" name="n"/>
        </launch>
    """)


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
                       ^^^^ info[PRM001] no node reads parameter '/rate'
          <node pkg="p" type="t" name="a"/>
          <node pkg="p" type="t" name="b"/>
        </launch>
        //- interfaces
        {"/a": {"params": {"~rate": 1.0}}, "/b": {"params": {"~rate": 1.0}}}
    """)
    assert finding.confidence == "possible"
    assert finding.fixes == ()


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


def test_where_a_node_is_not_known_a_global_parameter_may_be_its() -> None:
    check("""
        <launch>
          <param name="rate" value="20"/>
          <node pkg="p" type="t" name="n"/>
          <node pkg="p" type="t" name="m"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[TRC001]
        </launch>
        //- interfaces
        {"/n": {"params": {"~rate": 10}}, "/m": {"status": "crashed", "exit_code": 1}}
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


def test_the_section_of_a_node_that_is_started_elsewhere() -> None:
    check("""
        <launch>
          <rosparam>
            amcl: {odom_frame: odom_combined, base_frame: base_footprint, beams: 30, particles: 100, alpha: 0.1}
            planner: {odom_frame: odom, base_frame: base_link}
          </rosparam>
          <node pkg="p" type="t" name="base"/>
        </launch>
        //- interfaces
        {"/base": {"params": {"~odom_frame": "odom", "~base_frame": "base_link", "~rate": 10}}}
    """)
