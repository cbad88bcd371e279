"""Where the parts of a text are after an edit."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from preflight_analysis.documents.change import change
from preflight_analysis.documents.span import Span


@pytest.mark.parametrize(
    ("old", "new", "part", "now"),
    [
        ("f(a, b)", "f(aa, b)", "b", "b"),
        ("f(a, b)", "f(x, b)", "f", "f"),
        ("f(a, b)", "f(xyz, b)", "f(a, b)", "f(xyz, b)"),
        ("f(a, b)", "f(xyz, b)", "a", "xyz"),
        ("f(abc, b)", "f(, b)", "abc", ""),
        ("f(aaa, b)", "f(, b)", "b", "b"),
    ],
)
def test_a_part(old: str, new: str, part: str, now: str) -> None:
    start = old.index(part)
    moved = change(old, new).moved(Span(start, start + len(part)))
    assert new[moved.start : moved.end] == now


@settings(max_examples=200, derandomize=True, deadline=None)
@given(st.text("ab"), st.text("ab"), st.data())
def test_what_was_not_changed_stays(old: str, new: str, data: st.DataObject) -> None:
    found = change(old, new)
    before, after = found.before, found.after
    assert old[: before.start] + new[after.start : after.end] + old[before.end :] == new
    start = data.draw(st.integers(0, len(old)))
    span = Span(start, data.draw(st.integers(start, len(old))))
    moved = found.moved(span)
    assert 0 <= moved.start <= moved.end <= len(new)
    if span.start < span.end and (span.end <= before.start or span.start >= before.end):
        assert old[span.start : span.end] == new[moved.start : moved.end]
