"""Who is at the other end of a name, or was meant to be: asked of the rules, hover and `why`."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

import pytest
from preflight_analysis.model.reach import Unmet, unmet, why_nobody
from preflight_analysis.queries.hover import hover
from preflight_analysis.queries.why import chains
from preflight_analysis.workspace.workspace import Analysis
from support.query_harness import AtCursor, at_cursor

LAUNCH = """//- /main.launch
<launch>
  <node pkg="p" type="a" name="a"/>
  <node pkg="p" type="b" name="b"><re$0map from="in" to="/chatter"/></node>
</launch>
//- interfaces
"""


def launched(interfaces: Mapping[str, Any]) -> AtCursor:
    return at_cursor(LAUNCH + json.dumps(interfaces))


def hovered(there: AtCursor) -> str:
    found = hover([there.analysis], there.file, there.offset)
    assert found is not None
    return found.markdown


def claimed(analysis: Analysis, rule: str) -> str:
    (found,) = [f.message for f in analysis.findings if f.rule == rule]
    return found


@pytest.mark.parametrize(
    ("rule", "other"), [("TOP001", ("publishers", "subscribers")), ("SRV001", ("services", "clients"))]
)
def test_three_who_ask_name_the_same_end(rule: str, other: tuple[str, str]) -> None:
    """`/x/chatter` has the same last name, and another type."""
    provides, consumes = other
    there = launched({"/a": {provides: {"/chater": "x/Y", "/x/chatter": "x/Z"}}, "/b": {consumes: {"in": "x/Y"}}})
    analysis = there.analysis
    assert "did you mean '/chater'" in claimed(analysis, rule)
    assert "; did you mean '/chater' of /a?" in hovered(there)
    assert analysis.graph is not None
    (chain,) = chains(analysis, analysis.graph, "a", "b")
    assert chain.broken is not None
    noun = "topic" if rule == "TOP001" else "service"
    assert chain.broken.text == f"'/chater' and '/chatter' are different {noun} names"


def test_who_may_be_there_unseen() -> None:
    there = launched({"/b": {"subscribers": {"in": "x/Y"}}})
    context = there.analysis.context
    assert context.graph is not None
    channel = context.graph.topics["/chatter"]
    said = "nodes of this launch were not analysed as a whole; another launch may start the other end"
    assert why_nobody(context, "topics", channel) == said
    assert f"no publisher; {said}" in hovered(there)


def test_what_has_both_sides_lacks_nobody() -> None:
    there = launched({"/a": {"publishers": {"/chatter": "x/Y"}}, "/b": {"subscribers": {"in": "x/Y"}}})
    context = there.analysis.context
    assert context.graph is not None
    assert why_nobody(context, "topics", context.graph.topics["/chatter"]) is None
    assert unmet(context, "topics") == Unmet()
