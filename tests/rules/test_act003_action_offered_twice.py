"""ACT003: two nodes offer one action."""

import pytest
from support.action_interfaces import client, server
from support.check import check


def test_an_action_with_two_servers() -> None:
    text = f"""
        <launch>
          <node pkg="p" type="t" name="left"/>
          <node pkg="p" type="t" name="right"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[ACT003] action '/dock' has 2 servers (/left and /right): each
        </launch>
        //- interfaces
        {{"/left": {server("dock", "m/DockAction")}, "/right": {server("dock", "m/DockAction")}}}
    """
    (finding,) = check(text)
    assert [related.message for related in finding.related] == ["/left serves /dock"]


@pytest.mark.silent
def test_two_servers_in_their_own_namespaces_and_two_clients_are_fine() -> None:
    check(f"""
        <launch>
          <node pkg="p" type="t" name="left" ns="l"/>
          <node pkg="p" type="t" name="right" ns="r"/>
          <node pkg="p" type="t" name="one" ns="l"/>
          <node pkg="p" type="t" name="two" ns="l"/>
        </launch>
        //- interfaces
        {{"/l/left": {server("dock", "m/DockAction")}, "/r/right": {server("dock", "m/DockAction")},
         "/l/one": {client("dock", "m/DockAction")}, "/l/two": {client("dock", "m/DockAction")}}}
    """)
