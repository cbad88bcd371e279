from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from preflight_analysis.documents.span import LineIndex, Location, Span, common_prefix, common_suffix


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


TEXT = '<launch>\n  <node name="a"/>\n  <node name="b"/>\n</launch>\n'


def at(lines: LineIndex, what: str) -> Location:
    start = lines.text.index(what)
    return lines.location("/f", Span(start, start + len(what)))


def shown(location: Location, lines: LineIndex) -> str:
    return lines.text[location.span.start : location.span.end]


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("", "\n"),
        ("<launch>", "\n\n<launch>"),
        ("<launch>\n", '<launch>\n  <node name="new"/>\n'),
        ("<launch>\n", "<launch>\r\n"),
        ('  <node name="a"/>\n', ""),
        ('  <node name="a"/>\n', "  <node\n  name='a'\n  />\n"),
        ('name="a"', 'name="another"'),
        ("<launch>\n  <node", "<launch><node"),
    ],
)
def test_a_location_follows_its_line(old: str, new: str) -> None:
    before = LineIndex(TEXT)
    node, end = at(before, '"b"'), at(before, "</launch>")
    after = before.edited(TEXT.replace(old, new, 1))
    assert [shown(place, after) for place in (node, end)] == ['"b"', "</launch>"]
    assert (at(after, '"b"'), at(after, "</launch>")) == (node, end)


def test_an_edit_within_a_line_leaves_what_is_before_it_there() -> None:
    before = LineIndex(TEXT)
    name, end = at(before, "name="), at(before, "/>")
    after = before.edited(TEXT.replace('"a"', '"abc"'))
    assert at(after, "name=") == name
    assert at(after, "/>") != end


def test_a_line_that_is_inserted_behind_a_whole_line_is_no_part_of_it() -> None:
    before = LineIndex(TEXT)
    line = before.location("/f", before.line_span(1))
    after = before.edited(TEXT.replace('"a"/>\n', '"a"/>\n  <node/>\n'))
    assert shown(line, after) == '  <node name="a"/>\n'


def test_locations_sort_by_file_and_span() -> None:
    lines = LineIndex(TEXT)
    spans = [Span(start, end) for start in range(0, len(TEXT), 5) for end in range(start, len(TEXT), 7)]
    found = [lines.location(file, span) for file in ("/b", "/a") for span in reversed(spans)]
    assert [(each.file, each.span) for each in sorted(found)] == sorted((each.file, each.span) for each in found)


def test_the_same_text_has_the_same_lines() -> None:
    lines = LineIndex(TEXT)
    at(lines, "name=")
    assert lines.edited(TEXT) is lines
    assert lines != LineIndex(TEXT)
    assert lines.edited(TEXT + "\n").edited(TEXT) == lines
    assert lines.edited("").edited(TEXT) != lines


@given(st.text(alphabet="ab\n\r🤖"), st.lists(st.tuples(st.integers(0), st.integers(0), st.text(alphabet="ab\n\r"))))
def test_after_any_edits_lines_are_where_they_are_in_the_text(text: str, edits: list[tuple[int, int, str]]) -> None:
    lines = LineIndex(text)
    for some, other, new in edits:
        start, end = sorted((some % (len(text) + 1), other % (len(text) + 1)))
        whole = [lines.location("/f", lines.line_span(number)) for number in range(len(lines))]
        texts = [shown(each, lines) for each in whole]
        outside = [each for each in whole if each.span.end < start or each.span.start > end]
        old, text = lines, text[:start] + new + text[end:]
        lines = old.edited(text)
        fresh = LineIndex(text)
        now = [lines.location("/f", fresh.line_span(number)) for number in range(len(fresh))]
        assert [each.span for each in now] == [fresh.line_span(number) for number in range(len(fresh))]
        assert len(lines) == len(fresh)
        assert all(lines.position(offset) == fresh.position(offset) for offset in range(len(text) + 1))
        kept = {each.line for each in now}
        same = [each for each, was in zip(whole, texts, strict=True) if each.line in kept and shown(each, lines) == was]
        assert len(same) >= len(outside)
        if len(old) <= len(lines):
            assert all(each.line in kept for each in whole)


@given(st.text(alphabet="ab\n\r"), st.text(alphabet="ab\n\r"))
def test_common_ends(one: str, other: str) -> None:
    length = common_prefix(one, other)
    assert one[:length] == other[:length]
    assert one[length : length + 1] != other[length : length + 1] or length == len(one) == len(other)
    assert common_suffix(one, other) == common_prefix(one[::-1], other[::-1])
