"""LCH029: a substitution that is none."""

import pytest
from support.check import check


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


@pytest.mark.silent
def test_dollars_of_others_are_no_substitutions() -> None:
    check("""
        <launch>
          <arg name="port" default="1"/>
          <param name="a" value="costs 5$ (or less), ${HOME}, $(arg port), $argument(s), $(args"/>
          <node pkg="p" type="t" name="n" launch-prefix="bash -c 'sleep $0; $@'"/>
        </launch>
    """)
