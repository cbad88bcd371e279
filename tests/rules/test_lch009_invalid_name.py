"""LCH009: a name that ROS does not allow."""

import pytest
from support.check import check, findings_of
from support.fixes import fixed, unfixable


@pytest.mark.parametrize(
    ("tag", "after"),
    [
        ('<node pkg="p" type="t" name="front/cam"/>', '<node pkg="p" type="t" name="cam" ns="front"/>'),
        ('<node pkg="p" type="t" name="front-cam"/>', '<node pkg="p" type="t" name="front_cam"/>'),
        ('<node pkg="p" type="t" name="2d nav"/>', '<node pkg="p" type="t" name="d_nav"/>'),
        ('<remap from="a b" to="c"/>', '<remap from="a_b" to="c"/>'),
        ('<remap from="~a-b" to="c"/>', '<remap from="~a_b" to="c"/>'),
    ],
)
def test_an_invalid_name_becomes_a_valid_one(tag: str, after: str) -> None:
    assert fixed(tag, "LCH009") == after


@pytest.mark.parametrize(
    "tag",
    ['<node pkg="p" type="t" name="a/b" ns="c"/>', '<arg name="x" default="a-b"/><remap from="$(arg x)" to="c"/>'],
)
def test_an_invalid_name_that_is_not_written_so_or_has_a_namespace_already_has_no_fix(tag: str) -> None:
    assert unfixable(tag, "LCH009")


def test_an_invalid_name_that_several_includes_make_is_shown_once_and_as_it_is_written() -> None:
    findings = findings_of("""
        <launch>
          <include file="/inc.launch"><arg name="pc" value="pc-1"/></include>
          <include file="/inc.launch"><arg name="pc" value="pc-2"/></include>
        </launch>
        //- /inc.launch
        <launch><arg name="pc"/><node pkg="p" type="t" name="$(anon net)_$(arg pc)"/></launch>
    """)
    assert [(f.rule, f.message.split(":")[0]) for f in findings] == [("LCH009", "invalid node name '$(anon net)_pc-1'")]


def test_an_invalid_name() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="a/b"/>
                                       ^^^ error[LCH009] invalid node name 'a/b': a node's name cannot contain a
          <node pkg="p" type="t" name="front-camera"/>
                                       ^^^^^^^^^^^^ warning[LCH009] invalid node name 'front-camera': a name is a
          <node pkg="p" type="t" name="front_camera"/>
        </launch>
    """)


def test_the_namespace_of_a_composable_node() -> None:
    """That one is seen by the container, not by launch."""
    check("""
        //- /a.launch.xml
        <launch>
          <node_container pkg="p" exec="container" name="c" namespace="">
            <composable_node pkg="p" plugin="p::A" name="a" namespace="a-b"/>
                                                                       ^^^ warning[LCH009] invalid namespace name
          </node_container>
        </launch>
    """)


def test_a_remap_that_rcl_refuses() -> None:
    check("""
        //- /a.launch.xml
        <launch>
          <node pkg="p" exec="e" name="a">
            <remap from="~/in" to=" state)"/>
                                   ^^^^^^^ warning[LCH009] invalid remap name ' state)': a name is made of letters
            <remap from="a-b" to="c"/>
                         ^^^ warning[LCH009] invalid remap name 'a-b'
          </node>
        </launch>
    """)


@pytest.mark.silent
def test_remaps_as_rcl_reads_them() -> None:
    check("""
        //- /a.launch.xml
        <launch>
          <arg name="empty" default=""/>
          <node pkg="p" exec="e" name="a">
            <remap from="a:~/in" to="/robot_1/in"/>
            <remap from="__ns" to="/x"/>
            <remap from="rostopic://out" to="$(var empty)"/>
          </node>
        </launch>
    """)


@pytest.mark.silent
def test_names_with_digits_underscores_and_substitutions() -> None:
    check("""
        <launch>
          <arg name="side" default="left"/>
          <node pkg="p" type="t" name="n_1"/>
          <node pkg="p" type="t" name="$(arg side)_2"/>
          <node pkg="p" type="t" name="$(anon n)"/>
        </launch>
    """)


def test_a_name_that_is_not_allowed_while_its_argument_is_empty() -> None:
    check("""
        <launch>
          <arg name="robot" default=""/>
          <node pkg="p" type="t" name="$(arg robot)_plot"/>
                                       ^^^^^^^^^^^^^^^^^ info[LCH009] set argument 'robot'
        </launch>
    """)


def test_blanks_around_the_name_of_an_argument() -> None:
    found = check("""
        //- /a.launch.xml
        <launch>
          <include file="/b.launch.xml">
            <arg name="objects " value="ml"/>
                       ^^^^^^^^ warning[LCH009] blanks around the argument name 'objects': launch takes them as a part
            <arg name="points" value="ml"/>
          </include>
          <node pkg="p" exec="a" name="a"/>
        </launch>
        //- /b.launch.xml
        <launch>
          <arg name="objects" default="all"/>
          <arg name="points"/>
          <node pkg="p" exec="a" name="$(var objects)_$(var points)"/>
        </launch>
    """)
    assert [fix.title for each in found if each.rule == "LCH009" for fix in each.fixes] == [
        "Replace 'objects ' with 'objects'"
    ]
