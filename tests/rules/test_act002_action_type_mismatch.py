"""ACT002: client and server of an action have different types."""

import pytest
from support.action_interfaces import client, server
from support.check import check


def test_types_that_differ_are_told_once() -> None:
    check(f"""
        <launch>
          <node pkg="p" type="t" name="base"/>
          <node pkg="p" type="t" name="patrol"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ error[ACT002] type mismatch on '/dock': /base serves m/DockAction,
        </launch>
        //- interfaces
        {{"/base": {server("dock", "m/DockAction")}, "/patrol": {client("dock", "m/MoveBaseAction")}}}
    """)


@pytest.mark.silent
def test_types_that_are_equal_or_not_known() -> None:
    check(f"""
        <launch>
          <node pkg="p" type="t" name="base"/>
          <node pkg="p" type="t" name="patrol"/>
        </launch>
        //- interfaces
        {{"/base": {server("dock", "m/DockAction")}, "/patrol": {client("dock", "m/DockAction")}}}
    """)
