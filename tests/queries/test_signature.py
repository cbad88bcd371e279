"""The arguments of an include while they are typed."""

from __future__ import annotations

from preflight_analysis.queries.signature import Signature, signature
from support.query_harness import at_cursor

INNER = """
//- /p/inner.launch
<launch>
  <arg name="rate" default="5" doc="In Hz"/>
  <arg name="robot"/>
  <arg name="fixed" value="1"/>
</launch>
"""


def asked(text: str) -> Signature | None:
    there = at_cursor(text + INNER)
    return signature(there.analysis, there.launch_file, there.offset, there.sources)


def active(inside: str, before: str = "<launch>") -> str | None:
    """The name of the active parameter, empty when there is none."""
    found = asked(f"{before}<include file='$(find p)/inner.launch'>{inside}</include></launch>")
    assert found is not None
    return "" if found.active is None else found.parameters[found.active].name


def test_the_label_has_the_defaults_and_the_required_ones_first() -> None:
    found = asked("<launch><include file='$(find p)/inner.launch'>$0</include></launch>")
    assert found is not None
    assert found.label == "inner.launch(robot, rate:=5)"
    assert [found.label[p.start : p.end] for p in found.parameters] == ["robot", "rate:=5"]
    assert [p.doc for p in found.parameters] == ["(required)", "In Hz"]
    assert found.active is None


def test_the_active_parameter_is_the_argument_that_the_cursor_is_in() -> None:
    robot, rate = "<arg name='robot' value='{}'/>", "<arg name='rate' value='{}'/>"
    assert active(robot.format("$0") + rate) == "robot"
    assert active(robot + rate.format("$0")) == "rate"
    assert active(robot + "$0" + rate) == ""
    assert active("<arg name='unknown$0'/>") == ""
    assert active("<arg $0name='rate'/>") == "rate"


def test_in_half_typed_files_and_includes_that_are_not_taken() -> None:
    head = "<launch>\n  <include file='$(find p)/inner.launch'>\n"
    found = asked(head + "    <arg name='rate' value='$0")
    assert found is not None and found.active == 1
    found = asked(head + "    <arg name='robot' value='x'/>\n    <$0\n</launch>")
    assert found is not None and found.active is None
    assert active("<arg name='rate' value='$0'/>", "<launch><group if='false'>") == "rate"


def test_silence_elsewhere() -> None:
    assert asked("<launch>$0<include file='$(find p)/inner.launch'/></launch>") is None
    assert asked("<launch><include file='$(find p)/inner.launch'/>$0</launch>") is None
    assert asked("<launch><include file='$(find p)/gone.launch'>$0</include></launch>") is None
    assert asked("<launch><include>$0</include></launch>") is None
