"""URD005: a joint that follows one that does not exist."""

import pytest
from support.check import apply, check
from support.robot_launch import of_urdf, robot

_URDF = """<link name="a"/><link name="b"/><link name="c"/>
<joint name="finger_joint" type="continuous"><parent link="a"/><child link="b"/></joint>
<joint name="other" type="continuous"><parent link="a"/><child link="c"/><mimic joint="{}"/></joint>""".replace(
    "\n", ""
)


def test_a_slip() -> None:
    text = of_urdf(
        _URDF.format("finger_jont"),
        robot(
            '<mimic joint="finger_jont"/>',
            "              ^^^^^^^^^^^ warning[URD005] joint 'finger_jont' does not exist: joint 'other' mimics it",
        ),
    )
    (found,) = check(text)
    assert '<mimic joint="finger_joint"/>' in apply(text, found.fixes[0].edits)["/p/arm.xacro"]


@pytest.mark.silent
def test_a_joint_that_exists() -> None:
    check(of_urdf(_URDF.format("finger_joint")))
