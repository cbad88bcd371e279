"""TRC005: what else was noticed when a node was run."""

import pytest
from support.check import check


def test_notes_of_a_run() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="n"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ info[TRC005] /n: tried to write /home/me/x
        </launch>
        //- interfaces
        {"/n": {"notes": ["tried to write /home/me/x"]}}
    """)


@pytest.mark.silent
def test_a_run_without_notes() -> None:
    check("""
        <launch><node pkg="p" type="t" name="n"/></launch>
        //- interfaces
        {"/n": {"answers": ["it got an empty scan"]}}
    """)
