"""LCH006: an element lacks an attribute that it needs."""

import pytest
from support.check import apply, check, findings_of
from support.fixes import fixed, unfixable


def test_a_misspelling_of_the_missing_attribute_is_corrected() -> None:
    assert fixed('<node pkg="p" typ="t" name="n"/>', "LCH006") == '<node pkg="p" type="t" name="n"/>'


@pytest.mark.parametrize("tag", ['<node pkg="p" name="n"/>', "<arg/>", '<param name="a" />'])
def test_an_attribute_whose_value_is_not_known_is_not_written_empty(tag: str) -> None:
    assert unfixable(tag, "LCH006")


def test_a_missing_attribute_that_another_one_looks_like_is_asked_for() -> None:
    findings = findings_of('<launch><node pkg="p" typ="t" name="n"/></launch>')
    assert "required attribute 'type' of <node> is missing; did you mean it by 'typ'?" in {
        finding.message for finding in findings
    }


def test_missing_and_conflicting_attributes() -> None:
    check("""
        <launch>
          <node pkg="p" name="n"/>
           ^^^^ error[LCH006] required attribute 'type' of <node> is missing
          <arg name="a" default="1" value="2"/>
           ^^^ error[LCH007] conflicting attributes 'value' and 'default' of <arg>: only one is allowed
          <param name="b" value="$(arg a)"/>
        </launch>
    """)


def test_a_misspelt_attribute_that_is_needed_is_told_once() -> None:
    text = """
        <launch>
          <param nam="a" value="1"/>
           ^^^^^ error[LCH006] required attribute 'name' of <param> is missing; did you mean it by 'nam'?
          <param name="b" value="1" typ="int"/>
                                    ^^^ warning[LCH005] unknown attribute 'typ' of <param>; did you mean 'type'?
        </launch>
    """
    (missing,) = (each for each in check(text) if each.rule == "LCH006")
    assert '<param name="a"' in apply(text, missing.fixes[0].edits)["/main.launch"]


def test_an_attribute_that_ros2_needs() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <load_composable_node target="/box">
                                        ^^^^ hint[LCH034] container '/box' is not started by this launch; it is the
            <composable_node pkg="p" plugin="p::A" nam="a"/>
             ^^^^^^^^^^^^^^^ error[LCH006] required attribute 'name' of <composable_node> is missing; did you mean it
          </load_composable_node>
        </launch>
    """)


@pytest.mark.silent
def test_no_more_than_what_is_needed() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="n"/>
          <remap from="a" to="b"/>
          <param name="a" value="1"/>
          <rosparam>{b: 1}</rosparam>
          <env name="C" value="1"/>
        </launch>
    """)
