"""What differs between the generations of ROS has a name, in `generation.py` or in a table by number."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import fields
from pathlib import Path

from preflight_analysis.generation import ROS1, ROS2, Generation, ros

ROOT = Path(__file__).parent.parent.parent
SOURCES = sorted(
    path
    for folder in ("analysis", "server")
    for path in (ROOT / folder).rglob("*.py")
    if "agents" not in path.parts  # what runs inside the sandbox knows nothing of `generation.py`
)
_NUMBERED = {"generation", "_generation", "generation_of"}
IS_IT_THIS_ONE = {
    "analysis/preflight_analysis/evaluation/launch.py": 1,  # what ROS 2 needs is imported only then
    "analysis/preflight_analysis/evaluation/tags.py": 2,  # likewise
    "analysis/preflight_analysis/model/retired.py": 1,  # nodes of ROS 1 are listed, of ROS 2 none yet
}
"""How often a file asks for one generation by its number, and why that has no name."""


def _comparisons(path: Path) -> Iterator[ast.Compare]:
    text = path.read_text()
    for node in ast.walk(ast.parse(text)) if "generation" in text else ():
        if isinstance(node, ast.Compare):
            names = {getattr(each, "attr", getattr(each, "id", "")) for each in ast.walk(node)}
            if names & _NUMBERED and any(_is_number(each) for each in (node.left, *node.comparators)):
                yield node


def _is_number(node: ast.expr) -> bool:
    if isinstance(node, ast.Attribute):
        return node.attr == "number"
    return isinstance(node, ast.Constant) and node.value in (1, 2)


def test_nothing_asks_for_a_number_that_could_ask_for_what_it_means() -> None:
    found = {str(path.relative_to(ROOT)): len([*_comparisons(path)]) for path in SOURCES}
    assert {path: count for path, count in found.items() if count} == IS_IT_THIS_ONE


def test_each_field_says_something_that_differs_and_is_asked_for() -> None:
    texts = "".join(path.read_text() for path in SOURCES if path.name != "generation.py")
    for field in fields(Generation):
        assert getattr(ROS1, field.name) != getattr(ROS2, field.name)
        assert f".{field.name}" in texts, field.name


def test_they_are_known_by_their_numbers() -> None:
    assert (ros(1), ros(2)) == (ROS1, ROS2)
