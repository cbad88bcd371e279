"""LCH004: an element that roslaunch does not know."""

import pytest
from support.check import apply, check, findings_of
from support.fixes import fixed


@pytest.mark.parametrize(
    ("tag", "after"),
    [
        (
            '<nod pkg="p" type="t" name="n"><!-- </nod> --></nod >',
            '<node pkg="p" type="t" name="n"><!-- </nod> --></node >',
        ),
        ("<gruop>\n  <gruop/>\n</gruop>", "<group>\n  <gruop/>\n</group>"),
    ],
)
def test_the_name_of_an_element_is_mended_in_both_of_its_tags(tag: str, after: str) -> None:
    assert fixed(tag, "LCH004") == after


def test_an_unknown_element_and_the_nearest_one() -> None:
    (finding, other, _) = check("""
        <launch>
          <node pkg="p" type="t" name="n">
            <parm name="rate" value="10"/>
             ^^^^ warning[LCH004] unknown element <parm> in <node>; roslaunch skips it; did you mean 'param'?
          </node>
          <robots/>
           ^^^^^^ warning[LCH004] unknown element <robots> in <launch>; roslaunch skips it
          <rtconnect from="a.rtc:out" to="b.rtc:in"/>
           ^^^^^^^^^ hint[LCH004] roslaunch skips it; rtmlaunch reads it
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


@pytest.mark.silent
def test_an_annotation_that_can_be_read_is_no_unknown_element() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="n">
            <topics><topic name="/tf" type="tf2_msgs/TFMessage" class="sub"/></topics>
          </node>
        </launch>
    """)


def test_what_launch_does_not_know_stops_it() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="talker" name="talker" nmae="x">
                                                    ^^^^ error[LCH005] unknown attribute 'nmae' of <node>; did you
            <parm name="rate" value="1"/>
             ^^^^ error[LCH004] unknown element <parm> in <node>; did you mean 'param'?
          </node>
          <let name="a" value="$(var b)"/>
                               ^^^^^^^^ error[ARG001] argument 'b' is not declared
        </launch>
    """)
