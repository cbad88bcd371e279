"""URD011: a xacro file uses what nothing defines."""

from __future__ import annotations

import pytest
from support.check import check
from support.descriptions import findings, said, xacro

NOT = "is not defined in this file or in those that it includes"
FIN = '<xacro:macro name="fin" params="min_limit">\n<limit lower="${%s}"/></xacro:macro>'


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (FIN % "min_limi", "r.xacro:3 warning property 'min_limi' is not defined; did you mean 'min_limit'?"),
        ('<link name="${side}_wheel"/>', f"r.xacro:2 warning property 'side' {NOT}"),
        ("<xacro:wheel/>", f"r.xacro:2 warning macro 'wheel' {NOT}"),
        ('<link name="$(arg side)_wheel"/>', f"r.xacro:2 warning argument 'side' {NOT}"),
        (
            '<xacro:macro name="m" params="*origin"><joint><xacro:insert_block name="orign"/></joint></xacro:macro>',
            "r.xacro:2 warning block 'orign' is not defined; did you mean 'origin'?",
        ),
        (
            '<xacro:if value="${1 and is not 2}"/>',
            "r.xacro:2 warning '1 and is not 2' is not a Python expression: invalid syntax",
        ),
        (
            '<xacro:property name="dual" value="1"/><xacro:if value="${dual or daul}"/>',
            f"r.xacro:2 warning property 'daul' {NOT}; did you mean 'dual'?",
        ),
        ('<xacro:if value="1"><xacro:wheel/></xacro:if>', f"r.xacro:2 info macro 'wheel' {NOT}"),
        (
            '<xacro:macro name="m" params="a"><xacro:unless value="${a}"><xacro:ERROR_a_undefined/></xacro:unless>'
            "</xacro:macro>",
            f"r.xacro:2 info macro 'ERROR_a_undefined' {NOT}",
        ),
    ],
)
def test_what_nothing_defines(text: str, expected: str) -> None:
    assert said({"r.xacro": xacro(text)}, "URD011") == [expected]


@pytest.mark.parametrize(
    "text",
    [
        '<xacro:property name="side" value="left"/><link name="${side}_wheel"/>',
        '<link name="${pi} ${sqrt(2) + radians(3)} ${[x for x in range(3)][0]} ${dict(a=1)}"/>',
        '<link name="$${side} $$(arg side)"/>',
        "<!-- ${side} <xacro:wheel/> -->",
        '<xacro:macro name="m" params="a b:=1 c:=^ d:=^|${a} *e f:=\'x y\'"><link name="${a}${b}${c}${d}${f}"/>'
        '<xacro:insert_block name="e"/></xacro:macro>',
        # The body of a macro has the parameters of those that call it.
        '<xacro:macro name="inner" params=""><link name="${side}"/></xacro:macro>'
        '<xacro:macro name="outer" params="side"><xacro:inner/></xacro:macro>',
        # What nobody uses is never computed.
        '<xacro:property name="unused" value="${no_such}"/>',
        '<xacro:property name="${\'a\' + \'b\'}" value="1"/><link name="${ab}"/>',
        '<xacro:include filename="$(find not_here)/a.xacro"/><xacro:wheel/><link name="${side}"/>',
        '<xacro:include filename="$(arg which)"/><xacro:wheel/>',
        '<xacro:include filename="$(find arm)/wheel.xacro" ns="w"/><xacro:w.wheel/><link name="${w.side}"/>',
        '<xacro:arg name="side" default="left"/><link name="$(arg side)"/>',
        '<xacro:property name="which" value="a"/><xacro:call macro="${which}"/>',
    ],
)
def test_what_is_defined_or_may_be(text: str) -> None:
    files = {"r.xacro": xacro(text), "wheel.xacro": xacro('<xacro:macro name="wheel" params=""/>', name="")}
    assert said(files, "URD011") == []


def test_what_other_files_define() -> None:
    part = xacro("<xacro:wheel/><link name='${side}_wheel'/>", name="")
    defining = '<xacro:property name="side" value="left"/><xacro:include filename="wheel.xacro"/>'
    whole = xacro(f'{defining}<xacro:include filename="part.xacro"/>')
    wheel = xacro('<xacro:macro name="wheel" params=""/>', name="")
    assert said({"part.xacro": part, "r.xacro": whole, "wheel.xacro": wheel}) == []
    # The name of an include that is computed is one of the files there.
    computed = whole.replace('"part.xacro"', '"$(find arm)/$(arg part).xacro"')
    assert said({"part.xacro": part, "r.xacro": computed, "wheel.xacro": wheel}) == [
        "r.xacro:2 warning argument 'part' is not defined in this file or in those that it includes"
    ]
    without = xacro('<xacro:include filename="part.xacro"/>')
    assert said({"part.xacro": part, "r.xacro": without, "wheel.xacro": wheel}) == [
        f"part.xacro:2 warning macro 'wheel' {NOT}",
        f"part.xacro:2 warning property 'side' {NOT}",
    ]


def test_an_include_in_a_macro_has_its_parameters() -> None:
    top = xacro('<xacro:macro name="auv" params="side"><xacro:include filename="part.xacro"/></xacro:macro>')
    assert said({"part.xacro": xacro('<link name="${side}"/>', name=""), "r.xacro": top}) == []


def test_an_argument_that_a_launch_file_may_give() -> None:
    launch = '<launch><let name="x" value="$(command \'xacro r.xacro side:=left\')"/></launch>'
    assert said({"r.xacro": xacro("<link name='$(arg side)'/>"), "launch/arm.launch.xml": launch}, "URD011") == []


def test_a_slip_in_a_file_of_which_not_all_is_known_is_information() -> None:
    unknown = '<xacro:include filename="$(find not_here)/a.xacro"/>'
    assert said({"r.xacro": xacro(unknown + FIN % "min_limi")}, "URD011") == [
        "r.xacro:3 info property 'min_limi' is not defined; did you mean 'min_limit'?"
    ]


def test_the_slip_is_mended() -> None:
    ((_, finding),) = findings({"r.xacro": xacro(FIN % "min_limi")}, "URD011")
    (fix,) = finding.fixes
    assert [edit.text for edit in fix.edits] == ["min_limit"]


@pytest.mark.silent
def test_a_launch_for_itself() -> None:
    assert check("<launch/>") == []


def test_of_a_file_that_is_not_well_formed_nobody_knows_what_it_defines() -> None:
    files = {
        "r.xacro": xacro('<xacro:include filename="macros.xacro"/><xacro:finger/><link name="${side}"/>'),
        "macros.xacro": "<robot><link></robot>",
    }
    assert not [each for each in said(files, "URD011") if "warning" in each]
