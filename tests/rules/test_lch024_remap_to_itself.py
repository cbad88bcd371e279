"""LCH024: a remap from a name to the same name."""

import pytest
from support.check import apply, check


def test_a_remap_to_itself() -> None:
    text = """
        <launch>
          <node pkg="p" type="t" name="n">
            <remap from="scan" to="scan"></remap>
            ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ hint[LCH024] remap of 'scan' to itself has no effect
          </node>
        </launch>
    """
    (finding,) = check(text)
    assert "remap" not in apply(text, finding.fixes[0].edits)["/main.launch"]


@pytest.mark.silent
def test_a_remap_to_itself_that_may_be_another_or_undoes_one() -> None:
    check("""
        <launch>
          <arg name="scan" default="scan"/>
          <remap from="odom" to="wheels/odom"/>
          <node pkg="p" type="t" name="n">
            <remap from="scan" to="$(arg scan)"/>
            <remap from="odom" to="odom"/>
            <remap from="tf" to="/tf"/>
          </node>
        </launch>
    """)
