from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st
from preflight_analysis.documents.span import LineIndex, Span


def test_lines_end_as_in_lsp() -> None:
    text = "a\nb\r\nc\rd\x0be\u2028f"
    lines = LineIndex(text)
    assert [text[lines.line_span(i).start : lines.line_span(i).end] for i in range(len(lines))] == [
        "a\n",
        "b\r\n",
        "c\r",
        "d\x0be\u2028f",
    ]
    assert lines.line_span(4) == Span(len(text), len(text))


@given(st.text(alphabet="a\n\r🤖"))
def test_position_and_line_start_are_inverse(text: str) -> None:
    lines = LineIndex(text)
    for offset in range(len(text) + 1):
        line, column = lines.position(offset)
        assert lines.line_start(line) + column == offset
