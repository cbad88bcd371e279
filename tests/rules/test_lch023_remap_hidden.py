"""LCH023: a remap that another one of the same name puts out of effect."""

import pytest
from support.check import apply, check


def test_a_remap_that_a_later_one_beside_it_replaces() -> None:
    text = """
        <launch>
          <remap from="scan" to="front/scan"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[LCH023] overridden: 'scan' is remapped again to 'rear/scan'
          <remap from="scan" to="rear/scan"/>
          <node pkg="p" type="t" name="n">
            <remap from="tf" to="a"/>
            ^^^^^^^^^^^^^^^^^^^^^^^^^ hint[LCH023] duplicate remap of 'tf' to 'a'
            <remap from="tf" to="a"/>
          </node>
        </launch>
    """
    scan, tf = check(text)
    assert scan.related[0].message == "the remap that applies"
    mended = apply(text, scan.fixes[0].edits)["/main.launch"]
    assert 'to="front/scan"' not in mended
    assert tf.fixes


@pytest.mark.silent
def test_the_same_target_written_differently_is_no_other_one() -> None:
    remaps = '<remap from="/scan" to="/front"/><remap from="/scan" to="front"/>'
    check(f'//- /r.launch.xml\n<launch>\n<node pkg="p" exec="x" name="x">{remaps}</node>\n</launch>')


@pytest.mark.silent
def test_a_remap_that_reached_a_node_before_it_was_replaced_is_not_hidden() -> None:
    check("""
        <launch>
          <remap from="scan" to="front/scan"/>
          <node pkg="p" type="t" name="a"/>
          <remap from="scan" to="rear/scan"/>
          <node pkg="p" type="t" name="b"/>
        </launch>
    """)


@pytest.mark.silent
def test_defaults_and_alternatives_are_not_hidden_remaps() -> None:
    check("""
        <launch>
          <arg name="rear" default="true"/>
          <remap from="scan" to="front/scan"/>
          <remap from="scan" to="rear/scan" if="$(arg rear)"/>
          <remap from="odom" to="wheel_odom"/>
          <node pkg="p" type="t" name="n"><remap from="odom" to="visual_odom"/></node>
        </launch>
    """)


def test_two_remaps_of_a_node_for_one_name_written_differently() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="n">
            <remap from="/scan" to="front"/>
            <remap from="scan" to="rear"/>
                         ^^^^ warning[LCH023] duplicate remap: '/scan' and 'scan' are both '/scan' for /n; the client
          </node>
          <node pkg="p" type="t" name="m" ns="a">
            <remap from="/scan" to="front"/>
            <remap from="scan" to="rear"/>
            <remap from="odom" to="wheels"/>
            <remap from="/a/odom" to="wheels"/>
                         ^^^^^^^ hint[LCH023] 'odom' and '/a/odom' are both '/a/odom' for /a/m
          </node>
        </launch>
    """)


def test_the_first_remap_of_a_name_counts() -> None:
    remaps = '<remap from="scan" to="front"/><remap from="{}" to="{}"/>'
    under = "^" * len('<remap from="scan" to="rear"/>')
    before = " " * len('<node pkg="p" exec="x" name="x"><remap from="scan" to="front"/>')
    told = f"\n{before}{under} warning[LCH023] overridden: 'scan' is already remapped to 'front'"
    for source, target, expected in (("scan", "rear", told), ("scan", "front", ""), ("odom", "rear", "")):
        node = f'<node pkg="p" exec="x" name="x">{remaps.format(source, target)}</node>'
        check(f"//- /r.launch.xml\n<launch>\n{node}{expected}\n</launch>")
    check("""
        //- /robot.launch.xml
        <launch>
          <set_remap from="scan" to="/scan"/>
          <node pkg="p" exec="x" name="x" namespace="r"><remap from="/r/scan" to="rear"/></node>
                                                        ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[LCH023] 'scan' is
        </launch>
    """)
