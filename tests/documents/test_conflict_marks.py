"""Marks of a merge conflict, in texts of any size."""

import time

import pytest
from preflight_analysis.documents.conflict_marks import conflict_mark


def test_the_first_line_of_a_conflict() -> None:
    span = conflict_mark("a\n<<<<<<< HEAD\none\n=======\ntwo\n>>>>>>> other\n")
    assert span is not None and (span.start, span.end) == (2, 14)


@pytest.mark.parametrize(
    "text", ["", "<<<<<<< HEAD\n", "a\n=======\nb\n", "=======\n>>>>>>> x\n", "<<<<<<< a\n>>>>>>> b\n", "  <<<<<<< a\n"]
)
def test_what_is_no_conflict(text: str) -> None:
    assert conflict_mark(text) is None


def test_time_grows_with_the_length() -> None:
    began = time.process_time()
    assert conflict_mark("<<<<<<< a\n=======\n" * 30_000) is None
    assert time.process_time() - began < 5, "it was hours"
