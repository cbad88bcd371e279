"""TRC003: a node did not reach its event loop in time."""

import pytest
from support.check import check


def test_a_slow_start() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="slow"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ info[TRC003] /slow does not reach its event loop in time: still waiting
        </launch>
        //- interfaces
        {"/slow": {"status": "timed-out", "reason": "still waiting"}}
    """)


@pytest.mark.silent
def test_a_node_that_spins_or_ended() -> None:
    check("""
        <launch><node pkg="p" type="t" name="n"/><node pkg="p" type="t" name="m"/></launch>
        //- interfaces
        {"/n": {}, "/m": {}}
    """)
