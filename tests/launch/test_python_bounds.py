"""Python that would take long to read: the brackets, chains and bytes of one long line."""

from __future__ import annotations

import time

import pytest
from preflight_analysis.documents.reading import Text
from preflight_analysis.documents.span import ByteOffsets
from preflight_analysis.launch.python_tree import PythonTree
from preflight_analysis.launch.read import read_launch


@pytest.mark.parametrize("text", ["x=" + "a." * 1_000_000, "x=a" + ".a" * 1_000_000, "x=" + "f(x y, " * 50_000])
def test_a_long_chain_is_given_up_soon(text: str) -> None:
    begin = time.thread_time()
    found = read_launch(Text.of("/a.launch.py", text))
    assert found.document.problems
    assert time.thread_time() - begin < 5


def test_calls_of_a_text_that_does_not_parse_are_read() -> None:
    calls = (
        "ros.LaunchConfiguration('a'), 1",
        "LaunchConfiguration('b') LaunchConfiguration ('c')",
        "é.LaunchConfiguration('d')",
    )
    text = "x = [" + " ".join(calls)
    named = read_launch(Text.of("/a.launch.py", text)).named
    assert named is not None
    assert [part.arguments for part in named] == ["a", "b", "c", "d"]
    assert [text[slice(*part.arguments_span)] for part in named] == ["a", "b", "c", "d"]


def test_brackets_that_python_refuses_are_not_read() -> None:
    assert PythonTree("x = " + "(" * 150 + "'a'" + ")" * 150).strings()
    assert PythonTree("x = " + "(" * 250 + "'a'" + ")" * 250).strings() == []


@pytest.mark.parametrize("text", ["", "abc", "a\u00e9\U0001f600b" * 2000, "\udc80a" * 1500])
def test_bytes_and_code_points(text: str) -> None:
    offsets = ByteOffsets(text)
    for at in {0, 1, 2, 1023, 1024, 1025, len(text)}:
        if at <= len(text):
            byte = len(text[:at].encode(errors="replace"))
            assert offsets.bytes_before(at) == byte
            assert offsets.offset(byte) == at
