"""LCH: what is wrong in the launch file's own language."""

from pathlib import Path

import pytest
from preflight_analysis.environment.model import Environment, Package
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace
from support.check import apply, check, findings_of

SILENT = """
    <launch>
      <arg name="camera" default="front"/>
      <group ns="$(arg camera)" if="true">
        <node pkg="p" type="t" name="n" respawn="true" output="screen">
          <remap from="a" to="b"/>
          <param name="rate" value="10"/>
          <rosparam>{frame: map}</rosparam>
        </node>
      </group>
      <include file="/inc.launch"><arg name="rate" value="1"/></include>
    </launch>
    //- /inc.launch
    <launch>
      <arg name="rate"/>
      <machine name="base" address="localhost"/>
      <node pkg="p" type="t" name="m" machine="base" args="$(arg rate) $(optenv NOT_SET x)"/>
    </launch>
"""


def test_nothing_is_said_of_a_file_that_is_all_right() -> None:
    assert check(SILENT) == []


def test_malformed_xml_is_shown_at_its_cause() -> None:
    (finding,) = findings_of('<launch>\n  <node pkg="p" type="t" name="n">\n</launch>')
    assert (finding.rule, finding.severity, finding.stops_launch) == ("LCH001", "error", True)


def test_malformed_xml_in_an_included_file_is_shown_there_once() -> None:
    findings = findings_of("""
        <launch>
          <include file="/inc.launch"/>
          <group ns="b"><include file="/inc.launch"/></group>
        </launch>
        //- /inc.launch
        <launch><node pkg="p" type="t" name="n"</launch>
    """)
    assert [(f.rule, f.location.file) for f in findings if f.rule == "LCH001"] == [("LCH001", "/inc.launch")]


@pytest.mark.parametrize("path", ["/nowhere/at_all.launch", "/"])
def test_a_root_that_cannot_be_read(path: str) -> None:
    findings = findings_of(f'<launch><include file="{path}"/></launch>')
    assert [f.rule for f in findings] == ["LCH013" if "nowhere" in path else "LCH014"]


def test_a_binary_file() -> None:
    (finding,) = findings_of("//- /main.launch\n\0\1\2")
    assert finding.rule == "LCH002"
    assert "/main.launch" in finding.message


def test_no_launch_element() -> None:
    check("""
        <robot>
         ^^^^^ error[LCH003] the outermost element is <robot>, not <launch>
        </robot>
    """)


def test_an_unknown_element_and_the_nearest_one() -> None:
    (finding, other) = check("""
        <launch>
          <node pkg="p" type="t" name="n">
            <parm name="rate" value="10"/>
             ^^^^ warning[LCH004] <parm> is not known in <node> and is skipped; did you mean 'param'?
          </node>
          <robots/>
           ^^^^^^ warning[LCH004] <robots> is not known in <launch> and is skipped
        </launch>
    """)
    assert other.fixes == ()
    assert finding.fixes[0].preferred


def test_the_fix_of_an_unknown_element_mends_the_start_tag_of_a_self_closing_one() -> None:
    text = '<launch><nod pkg="p" type="t" name="n"/></launch>'
    (finding,) = findings_of(text)
    assert apply(text, finding.fixes[0].edits) == {
        "/main.launch": '<launch><node pkg="p" type="t" name="n"/></launch>\n'
    }


def test_an_unknown_attribute() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="n" respwan="true"/>
                                          ^^^^^^^ warning[LCH005] no attribute 'respwan'; did you mean 'respawn'?
        </launch>
    """)


def test_missing_and_conflicting_attributes() -> None:
    check("""
        <launch>
          <node pkg="p" name="n"/>
           ^^^^ error[LCH006] <node> needs 'type'
          <arg name="a" default="1" value="2"/>
           ^^^ error[LCH007] <arg> cannot have 'value' and 'default' together
          <param name="b" value="$(arg a)"/>
        </launch>
    """)


def test_a_bad_value_and_the_nearest_choice() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="n" output="scren"/>
                                                  ^^^^^ error[LCH008] did you mean 'screen'?
          <node pkg="p" type="t" name="m" if="maybe"/>
                                              ^^^^^ error[LCH008] if='maybe' of <node> is not
        </launch>
    """)


def test_an_invalid_name() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="a/b"/>
                                       ^^^ error[LCH009] 'a/b' is not allowed
          <node pkg="p" type="t" name="front-camera"/>
                                       ^^^^^^^^^^^^ warning[LCH009] 'front-camera' is not allowed
          <node pkg="p" type="t" name="front_camera"/>
        </launch>
    """)


def test_an_element_that_an_include_drops() -> None:
    check("""
        <launch>
          <include file="/inc.launch"><remap from="a" to="b"/></include>
                                       ^^^^^ warning[LCH010] <remap> has no effect in <include>
        </launch>
        //- /inc.launch
        <launch/>
    """)


def test_a_substitution_that_cannot_be_made() -> None:
    check("""
        <launch>
          <param name="a" value="$(args rate)"/>
                                 ^^^^^^^^^^^^ error[LCH011]
          <param name="b" value="$(eval 1 / 0)"/>
                                 ^^^^^^^^^^^^^ error[LCH011] $(eval 1 / 0) fails
        </launch>
    """)


def test_an_environment_variable_that_is_not_set() -> None:
    (finding,) = check("""
        <launch>
          <param name="a" value="$(env NOT_SET_ANYWHERE)"/>
                                 ^^^^^^^^^^^^^^^^^^^^^^^ warning[LCH012] 'NOT_SET_ANYWHERE' is not set
        </launch>
    """)
    assert finding.stops_launch


def test_an_included_file_that_is_not_there() -> None:
    check("""
        <launch>
          <include file="$(find p)/launch/base.launch"/>
                         ^^^^^^^^^^^^^^^^^^^^^^^^^^^^ error[LCH013] included file 'p/launch/base.launch' does not exist
        </launch>
    """)


def test_a_file_that_includes_itself() -> None:
    findings = findings_of("""
        <launch><include file="/inc.launch"/></launch>
        //- /inc.launch
        <launch><include file="/main.launch"/></launch>
    """)
    (finding,) = findings
    assert (finding.rule, finding.severity) == ("LCH015", "error")
    assert "/main.launch -> /inc.launch -> /main.launch" in finding.message


def test_two_nodes_of_one_name() -> None:
    findings = findings_of("""
        <launch>
          <node pkg="p" type="t" name="n"/>
          <group ns="a"><node pkg="p" type="t" name="n"/></group>
          <node pkg="p" type="t" name="n"/>
        </launch>
    """)
    (finding,) = findings
    assert finding.rule == "LCH016"
    assert "'/n'" in finding.message
    assert finding.related[0].location.span < finding.location.span


def test_a_machine_that_is_not_declared() -> None:
    (finding,) = findings_of("""
        <launch>
          <machine name="base" address="localhost"/>
          <node pkg="p" type="t" name="n" machine="bse"/>
        </launch>
    """)
    assert finding.rule == "LCH017"
    assert finding.message == "machine 'bse' is not declared; did you mean 'base'?"


def test_what_is_not_evaluated_is_said_and_stops_nothing() -> None:
    (finding,) = check("""
        <launch>
          <param name="a" value="$(eval [x for x in 'ab'])"/>
                                 ^^^^^^^^^^^^^^^^^^^^^^^^^ info[LCH018] is not evaluated
        </launch>
    """)
    assert not finding.stops_launch


def test_an_annotation_that_cannot_be_read() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="n">
            <!-- <topics><topic name="a" type="x/Y" class="both"/></topics> -->
                                                           ^^^^ warning[LCH020] allowed: pub, sub
          </node>
        </launch>
    """)


def test_an_annotation_that_can_be_read_is_no_unknown_element() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="n">
            <topics><topic name="/tf" type="tf2_msgs/TFMessage" class="sub"/></topics>
          </node>
        </launch>
    """)


def test_a_path_of_one_machine() -> None:
    check("""
        <launch>
          <param name="model" value="/home/bob/ws/src/vision/net.pt"/>
                                     ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ info[LCH021] in the home folder of one user
          <param name="mac" value="file:///Users/bob/net.pt"/>
                                          ^^^^^^^^^^^^^^^^^ info[LCH021] in the home folder of one user
          <param name="tilde" value="~bob/net.pt"/>
                                     ^^^^^^^^^^^ info[LCH021] in the home folder of one user
          <node pkg="p" type="t" name="n" args="-d /opt/ros/melodic/share/a.rviz"/>
                                                   ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ hint[LCH021] one distribution
        </launch>
    """)


def test_what_merely_looks_like_a_path_is_none_of_one_machine() -> None:
    check("""
        <launch>
          <machine name="robot" address="robot" env-loader="/opt/ros/noetic/env.sh"/>
          <remap from="/home/robot/scan" to="/root/scan"/>
          <group ns="/home/robot/arm"/>
          <param name="topic" value="/p/scan"/>
          <param name="private" value="~foo/bar"/>
          <param name="device" value="/dev/ttyUSB0"/>
          <param name="folder" value="/tmp/maps/office.yaml"/>
          <param name="relative" value="$(optenv HOME /home/robot/x)/home/bob/net.pt"/>
        </launch>
    """)


def test_a_path_of_one_machine_as_a_path_of_its_package(tmp_path: Path) -> None:
    share = tmp_path / "src" / "vision"
    (share / "models").mkdir(parents=True)
    (share / "models" / "net.pt").touch()
    (share / "package.xml").write_text("<package><name>vision</name></package>")
    launch = share / "vision.launch"
    launch.write_text(
        f'<launch><param name="a" value="{share}/models/net.pt"/>'
        '<param name="b" value="/home/bob/catkin_ws/src/vision/models/net.pt"/></launch>'
    )
    environment = Environment(
        1, "noetic", {}, (), {"vision": Package("vision", str(share), "")}, {}, (), (), None, str(tmp_path)
    )
    findings = Workspace(environment, Sources(), str(tmp_path)).static(str(launch)).findings
    # The first one leads somewhere, the second one does not.
    assert [(f.rule, f.severity, f.confidence) for f in findings] == [
        ("LCH021", "info", "certain"),
        ("LCH021", "warning", "certain"),
    ]
    assert [f.fixes[0].edits[0].text for f in findings] == ["$(find vision)/models/net.pt"] * 2


def test_an_included_file_that_its_author_calls_deprecated() -> None:
    check("""
        <launch>
          <include file="/old.launch"/>
                         ^^^^^^^^^^^ warning[LCH027] '/old.launch' is deprecated: use new.launch
          <include file="/new.launch"/>
        </launch>
        //- /old.launch
        <launch deprecated="use new.launch"><include file="/new.launch"/></launch>
        //- /new.launch
        <launch deprecated=""/>
    """)


def test_what_newer_releases_have_given_up() -> None:
    text = """
        <launch>
          <master auto="start"/>
          ^^^^^^^^^^^^^^^^^^^^^^ info[LCH027] roslaunch ignores <master>
          <node pkg="tf" type="static_transform_publisher" name="a" args="0 0 0 0 0 0 base laser 100"/>
                               ^^^^^^^^^^^^^^^^^^^^^^^^^^ hint[LCH027] tf2_ros has a 'static_transform_publisher'
          <node pkg="tf2_ros" type="static_transform_publisher" name="b" args="0 0 0 0 0 0 base laser"/>
          <param name="use_gui" value="true"/>
                       ^^^^^^^ warning[LCH027] has no parameter 'use_gui' since ROS Noetic
          <node pkg="joint_state_publisher" type="joint_state_publisher" name="joints"/>
        </launch>
        //- /tf/package.xml
        <package/>
        //- /tf2_ros/package.xml
        <package/>
        //- /joint_state_publisher/package.xml
        <package/>
    """
    findings = {finding.message.split()[0]: finding for finding in check(text)}
    assert "<master" not in apply(text, findings["roslaunch"].fixes[0].edits)["/main.launch"]
    changed = apply(text, findings["tf"].fixes[0].edits)["/main.launch"]
    assert 'pkg="tf2_ros" type="static_transform_publisher" name="a" args="0 0 0 0 0 0 base laser"/>' in changed


def test_what_is_gone_is_named_with_what_replaces_it() -> None:
    text = """
        <launch>
          <node pkg="gazebo" type="gazebo" name="gazebo"/>
                     ^^^^^^ error[LCH027] are in 'gazebo_ros' since ROS Hydro
          <param name="r" command="xacro --inorder robot.xacro"/>
                                        ^^^^^^^^^^ hint[LCH027] --inorder has no effect
        </launch>
    """
    gazebo, in_order = [finding for finding in check(text) if finding.rule == "LCH027"]
    assert 'pkg="gazebo_ros"' in apply(text, gazebo.fixes[0].edits)["/main.launch"]
    assert 'command="xacro robot.xacro"' in apply(text, in_order.fixes[0].edits)["/main.launch"]


def test_what_is_gone_is_told_once(tmp_path: Path) -> None:
    launch = tmp_path / "a.launch"
    launch.write_text('<launch><node pkg="robot_state_publisher" type="state_publisher" name="a"/></launch>')
    packages = {"robot_state_publisher": Package("robot_state_publisher", str(tmp_path), str(tmp_path / "package.xml"))}
    environment = Environment(1, "noetic", {}, (str(tmp_path),), packages, {}, (), ("/usr",), "/usr/bin/python3")
    found = Workspace(environment, Sources(), str(tmp_path)).static(str(launch)).findings
    assert [(each.rule, each.severity) for each in found] == [("LCH027", "error")]


def test_an_executable_that_is_still_there_is_not_gone() -> None:
    check("""
        <launch>
          <node pkg="robot_state_publisher" type="state_publisher" name="a"/>
          <param name="~use_gui" value="true"/>
          <node pkg="p" type="joint_state_publisher" name="joints"/>
        </launch>
        //- /robot_state_publisher/package.xml
        <package/>
    """)


def test_a_start_tag_for_the_end_tag_is_told_once() -> None:
    check("""
        <launch>
          <group ns="a">
            <node pkg="p" type="t" name="b"/>
          </group>
        <launch>
         ^^^^^^ error[LCH001] '/' is missing: </launch> is expected
    """)


def test_a_second_launch_element_is_told_once() -> None:
    check("""
        <launch>
          <launch>
           ^^^^^^ error[LCH003] a <launch> element stands within another one
            <arg name="a" value="1"/>
          </launch>
        </launch>
    """)


def test_a_misspelt_attribute_that_is_needed_is_told_once() -> None:
    text = """
        <launch>
          <param nam="a" value="1"/>
           ^^^^^ error[LCH006] <param> needs 'name'; is 'nam' meant to be it?
          <param name="b" value="1" typ="int"/>
                                    ^^^ warning[LCH005] <param> has no attribute 'typ'; did you mean 'type'?
        </launch>
    """
    (missing,) = (each for each in check(text) if each.rule == "LCH006")
    assert '<param name="a"' in apply(text, missing.fixes[0].edits)["/main.launch"]


def test_text_between_tags_means_nothing() -> None:
    findings = check("""
        <launch>
          node pkg="p" type="t" name="n"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[LCH028] means nothing: roslaunch does not look at it; is a '<'
          <group ns="a">
            # the front camera
            ^^^^^^^^^^^^^^^^^^ hint[LCH028] the text '# the front camera' in <group> means nothing
            <node pkg="p" type="t" name="m"/>
          </group>
          <param name="x" value="1">2</param>
                                    ^ warning[LCH028] the text '2' in <param>
        </launch>
    """)
    titles = [fix.title for finding in findings for fix in finding.fixes]
    assert titles == ["Insert the '<'", "Make it a comment"]


def test_text_of_rosparam_and_comments_is_meant() -> None:
    check("""
        <launch>
          <!-- node pkg="p" -->
          <rosparam>{rate: 5}</rosparam>
          <node pkg="p" type="t" name="n">
            <rosparam>
              # the front camera
              rate: 5
            </rosparam>
          </node>
        </launch>
    """)


def test_what_looks_like_a_substitution_and_is_none() -> None:
    fixture = """
        <launch>
          <arg name="port" default="/dev/ttyUSB0"/>
          <node pkg="p" type="t" name="n">
            <param name="a" value="${arg port}"/>
                                   ^^^^^^^^^^^ warning[LCH029] '${arg port}' is no substitution: roslaunch takes
            <param name="b" value="$arg(port)"/>
                                   ^^^^^^^^^^ warning[LCH029] '$(arg port)' is one
            <param name="c" value="at $(arg port and more"/>
                                      ^^^^^^^^^^ warning[LCH029] '$(arg port' is no substitution
            <param name="d" value="$(dirname"/>
                                   ^^^^^^^^^ warning[LCH029] '$(dirname)' is one
            <param name="e" value="$(arg port)"/>
          </node>
        </launch>
    """
    meant = [edit.text for finding in check(fixture) for fix in finding.fixes for edit in fix.edits]
    assert meant == ["$(arg port)", "$(arg port)", "$(arg port)", "$(dirname)"]


def test_dollars_of_others_are_no_substitutions() -> None:
    check("""
        <launch>
          <arg name="port" default="1"/>
          <param name="a" value="costs 5$ (or less), ${HOME}, $(arg port), $argument(s), $(args"/>
          <node pkg="p" type="t" name="n" launch-prefix="bash -c 'sleep $0; $@'"/>
        </launch>
    """)


@pytest.mark.parametrize(
    "hidden",
    [
        '<group if="$(env UNSET)"><machine name="base" address="a"/></group>',
        '<machine unless="$(env UNSET)" name="base" address="a"/>',
        '<machine name="$(env UNSET)" address="a"/>',
    ],
)
def test_a_machine_that_may_be_declared_where_nobody_can_look(hidden: str) -> None:
    launch = f'<launch>{hidden}<node pkg="p" type="t" name="n" machine="base"/></launch>'
    assert [f.rule for f in findings_of(launch)] == ["LCH012"]
