"""LCH025: a condition that is never true, and tests that compare what cannot be equal."""

import pytest
from support.check import apply, check


def test_a_condition_that_compares_an_argument_with_a_text_that_it_never_is() -> None:
    text = """
        <launch>
          <arg name="sim" default="true"/>
          <group if="$(eval arg('sim') == 'true')"/>
                     ^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[LCH025] 'arg('sim') == 'true'' is never true: $(eval)
          <group unless="$(eval sim != '1')"/>
                         ^^^^^^^^^^^^^^^^^^ warning[LCH025] 'sim != '1'' is always true: $(eval) converts argument
        </launch>
    """
    first, _ = check(text)
    assert "$(eval arg('sim') == true)" in apply(text, first.fixes[0].edits)["/main.launch"]


def test_conditions_that_are_never_true() -> None:
    check("""
        <launch>
          <arg name="debug" value="false"/>
          <group if="false"/>
                     ^^^^^ hint[LCH025] <group> is never evaluated: 'if' is always false
          <group unless="1"/>
                         ^ hint[LCH025] <group> is never evaluated: 'unless' is always true
          <group if="$(arg debug)"/>
                     ^^^^^^^^^^^^ hint[LCH025] <group> is never evaluated: 'if' is always false, because argument
          <group if="$(eval 1 == 2 and arg('debug'))"/>
                     ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ hint[LCH025] <group> is never evaluated: 'if' is always false
        </launch>
    """)


@pytest.mark.silent
def test_conditions_that_may_be_true() -> None:
    check("""
        <launch>
          <arg name="robot" default="turtle"/>
          <arg name="sim" default="false"/>
          <arg name="fast" value="true" if="$(arg sim)"/>
          <arg name="fast" value="false" unless="$(arg sim)"/>
          <group if="$(arg sim)"/>
          <group if="$(arg fast)"/>
          <group if="$(eval robot == 'turtle' or arg('sim') == true)"/>
          <group if="$(eval optenv('SIM', 'no') == 'true')"/>
          <group if="true"/>
          <group unless="$(eval 1 == 2)"/>
        </launch>
    """)
