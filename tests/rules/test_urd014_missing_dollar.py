"""URD014: the `$` of an expression is missing."""

from __future__ import annotations

import pytest
from support.check import check
from support.descriptions import said, xacro

MACRO = '<xacro:macro name="m" params="suffix">%s</xacro:macro>'


@pytest.mark.parametrize(
    ("text", "written"),
    [
        ('<link name="a{suffix}"/>', "{suffix}"),
        ('<link name="a${suffix}_{suffix}"/>', "{suffix}"),
        ("<namespace>($suffix)</namespace>", "($suffix)"),
        ("<namespace>$(suffix)</namespace>", "$(suffix)"),
    ],
)
def test_a_name_that_stays_as_it_is(text: str, written: str) -> None:
    assert said({"r.xacro": xacro(MACRO % text)}) == [
        f"r.xacro:2 warning '{written}' is literal text for xacro; did you mean '${{suffix}}'?"
    ]


@pytest.mark.parametrize(
    "text",
    [
        '<link name="a${suffix}"/>',
        '<link name="{other}"/>',
        '<param>{suffix: 1}</param><link name="$${suffix}"/>',
        "<link name=\"${'{suffix}'}\"/>",
        '<link name="$(arg suffix)"/><xacro:arg name="suffix" default=""/>',
    ],
)
def test_what_is_computed_or_meant_so(text: str) -> None:
    assert said({"r.xacro": xacro(MACRO % text)}, "URD014") == []


@pytest.mark.silent
def test_a_launch_for_itself() -> None:
    assert check("<launch/>") == []
