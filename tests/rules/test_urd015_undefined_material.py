"""URD015: materials that links name and that have no color or texture."""

import pytest
from support.check import check
from support.descriptions import findings, said, xacro

PAINTED = '<material name="orange"><color rgba="1 0.5 0 1"/></material>'


def link(material: str) -> str:
    return f'<link name="hand"><visual><geometry><box size="1 1 1"/></geometry>{material}</visual></link>'


NAMED = link('<material name="organge"/>')
MACRO = f'<xacro:macro name="hand">{NAMED}</xacro:macro>'
INCLUDE = '<xacro:include filename="{}"/>'


def test_a_name_that_is_nowhere_defined() -> None:
    assert said({"urdf/arm.xacro": xacro(PAINTED + NAMED)}, "URD015") == [
        "urdf/arm.xacro:2 warning material 'organge' has no <color> or <texture> in this file or in those that it "
        "includes; did you mean 'orange'?"
    ]
    assert len(said({"urdf/arm.urdf": f'<robot name="arm">{NAMED}{NAMED}</robot>'}, "URD015")) == 1


def test_in_a_macro_of_another_file() -> None:
    files = {
        "urdf/arm.xacro": xacro(INCLUDE.format("hand.xacro") + INCLUDE.format("paint.xacro") + "<xacro:hand/>"),
        "urdf/hand.xacro": xacro(MACRO, ""),
        "urdf/paint.xacro": xacro(PAINTED, ""),
    }
    ((name, finding),) = findings(files, "URD015")
    assert (name, finding.candidates) == ("urdf/hand.xacro", ("orange",))
    assert [fix.title for fix in finding.fixes] == ["Replace 'organge' with 'orange'"]


@pytest.mark.parametrize(
    "text",
    [
        PAINTED + link('<material name="orange"/>'),
        link('<material name="orange"><texture filename="a.png"/></material>') + link('<material name="orange"/>'),
        link('<material name="${color}"/>'),
        '<material name="${color}"><color rgba="1 0.5 0 1"/></material>' + NAMED,
        INCLUDE.format("$(find other)/materials.xacro") + NAMED,
        f'<gazebo reference="hand">{NAMED}</gazebo>'.replace("visual", "surface"),
    ],
)
def test_what_may_be_defined(text: str) -> None:
    assert not said({"urdf/arm.xacro": xacro(text)}, "URD015")


def test_a_file_that_others_include() -> None:
    assert not said({"urdf/hand.xacro": xacro(MACRO, "")}, "URD015")


@pytest.mark.silent
def test_a_launch_for_itself() -> None:
    assert check("<launch/>") == []
