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


def test_what_stood_in_for_a_module_is_a_lack() -> None:
    findings = check("""
        <launch>
          <node pkg="p" type="t" name="n"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ hint[TRC005] /n needs module 'cv2', which is not installed; a stand-in
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ hint[TRC005] /n needs package 'rospy', which is not installed; a stand-in
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ hint[TRC005] /n needs the built package 'p', which is not installed; a
        </launch>
        //- interfaces
        {"/n": {"stand_ins": ["cv2", "p.msg", "p.srv", "rospy"]}}
    """)
    assert {each.lack and (each.lack.kind, each.lack.name) for each in findings} == {
        *(("build", "p"), ("module", "cv2"), ("package", "rospy"))
    }


@pytest.mark.silent
def test_a_run_without_notes() -> None:
    check("""
        <launch><node pkg="p" type="t" name="n"/></launch>
        //- interfaces
        {"/n": {"answers": ["it got an empty scan"]}}
    """)
