"""The words of a command line are those of a shell, however it is read."""

import shlex

import pytest
from hypothesis import given
from hypothesis import strategies as st
from preflight_analysis.evaluation.words import words_of

TEXTS = st.text(alphabet=" \t\n\r\x0b\x1cab-:=/~#$%&*()[]{}^`|<>;!?@\u00a0\u00e9'\"\\")


@given(TEXTS)
def test_words_are_those_of_a_shell(text: str) -> None:
    try:
        expected = shlex.split(text)
    except ValueError:
        expected = text.split()
    assert words_of(text) == expected


@pytest.mark.parametrize(
    ("text", "words"),
    [("", []), ("a  b\t_c:=d", ["a", "b", "_c:=d"]), ("'a b' c", ["a b", "c"]), ("'a b", ["'a", "b"])],
)
def test_words(text: str, words: list[str]) -> None:
    assert words_of(text) == words
