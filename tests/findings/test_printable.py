"""Text that is shown neither drives a terminal, nor turns what is around it, nor hides."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from preflight_analysis.findings.printable import printable


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("a/b c", "a/b c"),
        ("\x1b[31m", "␛[31m"),
        ("a\r\nb\tc", "a␍␊b␉c"),
        ("\0\x7f\x9b", "␀␡\N{REPLACEMENT CHARACTER}"),
        ("\u202eabc\u2069", "\N{REPLACEMENT CHARACTER}abc\N{REPLACEMENT CHARACTER}"),
        ("\ud800", "\N{REPLACEMENT CHARACTER}"),
        ("\u2028\u200b\U000e0041", "\N{REPLACEMENT CHARACTER}" * 3),
        ("שלום Grüße 日本 👩‍🔧", "שלום Grüße 日本 👩‍🔧"),
    ],
)
def test_what_is_shown(text: str, shown: str) -> None:
    assert printable(text) == shown


def test_lines_stay_where_there_may_be_several() -> None:
    assert printable("a\n\tb\r", lines=True) == "a\n\tb␍"


@given(st.text(st.characters()))
def test_utf8_can_say_it_in_one_line_and_it_stays_as_it_is(text: str) -> None:
    shown = printable(text)
    shown.encode()
    assert len(shown) == len(text)
    assert shown.splitlines() in ([shown], [])
    assert printable(shown) == shown
