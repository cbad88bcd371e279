"""TRC002: a node ended without error before it reached its event loop."""

import pytest
from support.check import check


def test_an_early_end() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="done"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ info[TRC002] /done exits before its event loop, without an error
        </launch>
        //- interfaces
        {"/done": {"status": "exited", "exit_code": 0}}
    """)


@pytest.mark.silent
def test_a_node_that_spins() -> None:
    check("""
        <launch><node pkg="p" type="t" name="n"/></launch>
        //- interfaces
        {"/n": {}}
    """)
