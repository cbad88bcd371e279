"""Positions of an editor in all three encodings, against an independent count on encoded bytes."""

from __future__ import annotations

import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from lsprotocol import types
from preflight_analysis.documents.span import LineIndex, Span
from preflight_server.lsp.positions import Positions
from support import lsp_client

# Characters of one to four bytes, and everything that some notion of lines breaks at.
TEXTS = st.text("ab<é漢𝒳\n\r\f\v\x1c\x85\u2028\u2029", max_size=40)


def positions(text: str, encoding: str) -> Positions:
    return Positions(text, LineIndex(text), encoding)


@pytest.mark.parametrize("encoding", lsp_client.ENCODINGS)
@given(text=TEXTS, at=st.integers(0, 40))
@example(text="a\fb\u2028é", at=4)
@example(text="", at=0)
def test_offsets_become_the_positions_that_an_editor_counts(encoding: str, text: str, at: int) -> None:
    at = min(at, len(text))
    if text[at - 1 : at + 1] == "\r\n":
        at -= 1
    there = positions(text, encoding)
    assert there.position(at) == lsp_client.position(text, at, encoding)
    assert there.offset(lsp_client.position(text, at, encoding)) == at


@pytest.mark.parametrize("encoding", lsp_client.ENCODINGS)
def test_a_column_past_the_end_means_the_end_of_the_line(encoding: str) -> None:
    there = positions("é𝒳\r\nx\ry\n", encoding)
    assert there.offset(types.Position(0, 99)) == 2
    assert there.offset(types.Position(1, 99)) == 5
    assert there.offset(types.Position(2, 99)) == 7


@pytest.mark.parametrize("text", ["", "x", "x\n", "x\r\n"])
def test_a_line_past_the_end_means_the_end_of_the_text(text: str) -> None:
    there = positions(text, "utf-16")
    assert there.offset(types.Position(7, 3)) == len(text)
    assert there.position(99) == there.position(len(text))


@pytest.mark.parametrize(("encoding", "units"), [("utf-8", 4), ("utf-16", 2)])
def test_a_position_inside_a_character_counts_as_its_start(encoding: str, units: int) -> None:
    there = positions("a𝒳b", encoding)
    for inside in range(1, units):
        assert there.offset(types.Position(0, 1 + inside)) == 1
    assert there.offset(types.Position(0, 1 + units)) == 2


def test_a_range_has_both_ends() -> None:
    assert positions("a\nbc", "utf-16").range(Span(0, 3)) == types.Range(types.Position(0, 0), types.Position(1, 1))
