"""TRC004: nodes were not run, and why."""

import pytest
from support.check import check


def test_why_nothing_was_run_is_said_once() -> None:
    text = """
        <launch>
        ^^^^^^^^ info[TRC004] 2 nodes are not run: the workspace is not trusted
          <node pkg="p" type="t" name="a"/>
          <node pkg="p" type="t" name="b"/>
        </launch>
    """
    check(text, why_not_run="the workspace is not trusted")
    check("<launch/>", why_not_run="the workspace is not trusted")


def test_nodes_that_were_not_run_are_told_together() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="a"/>
          <node pkg="p" type="t" name="b"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ info[TRC004] not run: /b, /c; a value is unknown
          <node pkg="p" type="t" name="c"/>
          <node pkg="p" type="t" name="d">
            <!-- <topics><topic name="/tf" type="tf2_msgs/TFMessage" class="pub"/></topics> -->
          </node>
        </launch>
        //- interfaces
        {"/a": {}, "/b": {"status": "not-run", "reason": "a value is unknown"},
         "/c": {"status": "not-run", "reason": "a value is unknown"}}
    """)


@pytest.mark.silent
def test_nodes_that_were_run() -> None:
    check("""
        <launch><node pkg="p" type="t" name="n"/></launch>
        //- interfaces
        {"/n": {}}
    """)
