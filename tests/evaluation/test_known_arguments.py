"""Words of command lines, by the forms of what is known of an executable."""

from typing import Any

import pytest
from preflight_analysis.evaluation.known_arguments import arguments_of
from preflight_analysis.knowledge.model import Entry
from support.check import analyse, read_fixture

FORMS = ("messages {topic} {rate} [{out}]", "mux {out} {inputs}...", "{topic} [{out}]")


def given(args: str, *forms: str, **options: str) -> dict[str, Any]:
    tree = analyse(read_fixture(f"<launch><node pkg='p' type='e' name='n' args='{args}'/></launch>")).tree
    entry = Entry({"executables": ("e",)}, arguments=forms, options={f"-{key}": name for key, name in options.items()})
    return dict(arguments_of(tree.nodes[0], entry))


@pytest.mark.parametrize(
    ("args", "expected"),
    [
        ("messages a 1", {"topic": "a", "rate": "1"}),
        ("messages a 1 b", {"topic": "a", "rate": "1", "out": "b"}),
        ("mux a b c", {"out": "a", "inputs": ["b", "c"]}),
        ("mux a", {"out": "a", "inputs": []}),
        ("a", {"topic": "a"}),
        # Forms that need more words fit nothing; the last one does.
        ("messages a", {"topic": "messages", "out": "a"}),
        ("", {}),
    ],
)
def test_the_first_form_that_fits(args: str, expected: dict[str, Any]) -> None:
    assert given(args, *FORMS) == expected


def test_options_remaps_and_what_is_for_ros_are_no_words() -> None:
    words = "-topic d a:=b _x:=1 -flag scan -file=f --ros-args -p y:=1 -- out"
    assert given(words, FORMS[2], topic="description", file="file") == {
        "description": "d",
        "file": "f",
        "topic": "scan",
        "out": "out",
    }


@pytest.mark.parametrize("args", ["-topic", "-topic="])
def test_an_option_without_a_value(args: str) -> None:
    assert given(args, topic="description") == {"description": ""}


@pytest.mark.silent
def test_what_is_not_known_fits_nothing() -> None:
    assert given("$(arg nothing)", FORMS[2]) == {}
