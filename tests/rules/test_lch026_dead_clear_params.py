"""LCH026: clear_params that deletes nothing of what it seems to."""

import pytest
from support.check import check, findings_of


def test_clear_params_where_nothing_is_and_where_parameters_stay() -> None:
    check("""
        <launch>
          <param name="/arm/rate" value="10"/>
          <group ns="arm" clear_params="true">
                          ^^^^^^^^^^^^^^^^^^^ hint[LCH026] clear_params does not clear '/arm/rate': roslaunch deletes
            <node pkg="p" type="t" name="n"/>
          </group>
          <group ns="leg" clear_params="true"/>
                          ^^^^^^^^^^^^^^^^^^^ hint[LCH026] clear_params has no effect: this launch has no node or
        </launch>
    """)


@pytest.mark.silent
def test_clear_params_that_has_a_use() -> None:
    check("""
        <launch>
          <group ns="arm" clear_params="true"><param name="rate" value="10"/></group>
          <group ns="leg" clear_params="true"><node pkg="p" type="t" name="n"/></group>
          <group ns="eye" clear_params="false"/>
          <rosparam>{n: {rate: 3}}</rosparam>
          <node pkg="p" type="t" name="n" clear_params="true"/>
        </launch>
    """)


@pytest.mark.silent
def test_clear_params_of_what_is_not_known_is_not_called_dead() -> None:
    findings = findings_of("""
        <launch>
          <arg name="file"/>
          <group ns="arm" clear_params="true"><include file="$(arg file)"/></group>
        </launch>
    """)
    assert "LCH026" not in {finding.rule for finding in findings}
