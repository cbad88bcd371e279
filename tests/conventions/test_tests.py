"""What holds for all tests: each asserts something and waits for conditions, and what there is can be found."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path

TESTS = Path(__file__).parents[1]
SLEEPS = ("time.sleep", "asyncio.sleep")
RAISES = {"raises", "fail", "warns"}
"""Functions of pytest that a test may assert by."""


@dataclass(frozen=True)
class Function:
    """A function or method of the tests, with all that is in it."""

    place: str
    name: str
    asserts: bool
    called: frozenset[str]
    """Names of the functions and methods that it calls."""
    sleeps: tuple[str, ...]
    """The lines with a sleep, each with its file and number."""


@cache
def functions() -> tuple[Function, ...]:
    ours = (path for path in sorted(TESTS.rglob("*.py")) if "node_modules" not in path.parts)
    return tuple(each for path in ours for each in _functions(path))


def _functions(path: Path) -> Iterator[Function]:
    text = path.read_text(encoding="utf-8")
    lines, name = text.splitlines(), path.relative_to(TESTS)
    statements: list[ast.stmt] = ast.parse(text).body
    while statements:
        statement = statements.pop()
        if isinstance(statement, ast.ClassDef):
            statements += statement.body
        elif isinstance(statement, (ast.FunctionDef, ast.AsyncFunctionDef)):
            nodes = list(ast.walk(statement))
            calls = [(_called(node.func), node.lineno) for node in nodes if isinstance(node, ast.Call)]
            yield Function(
                f"{name}:{statement.lineno}",
                statement.name,
                any(isinstance(node, ast.Assert) for node in nodes),
                frozenset(call.rpartition(".")[2] for call, _ in calls),
                tuple(f"{name}:{line} {lines[line - 1].strip()}" for call, line in calls if call in SLEEPS),
            )


def _called(function: ast.expr) -> str:
    """`name` or `object.name`."""
    if not isinstance(function, ast.Attribute):
        return getattr(function, "id", "")
    return f"{getattr(function.value, 'id', '')}.{function.attr}"


def test_each_test_asserts_something() -> None:
    """By itself or by a function of the tests that does."""
    asserting = RAISES | {each.name for each in functions() if each.asserts}
    while more := {each.name for each in functions() if each.called & asserting} - asserting:
        asserting |= more
    tests = [each for each in functions() if each.name.startswith("test_")]
    assert len(tests) > 1000
    assert [each.place for each in tests if not each.asserts and not each.called & asserting] == []


def test_each_rule_has_a_file_of_cases_named_as_it() -> None:
    rules = TESTS.parent / "analysis/preflight_analysis/rules"
    named = {path.stem for path in rules.glob("*_*.py") if re.match(r"[a-z]{3}\d{3}_", path.name)}
    assert len(named) > 90
    assert sorted(named - {path.stem.removeprefix("test_") for path in (TESTS / "rules").glob("test_*.py")}) == []


def test_the_page_of_the_helpers_has_them_all() -> None:
    page = (TESTS / "support/README.md").read_text()
    helpers = {path.stem for path in (TESTS / "support").glob("*.py")} - {"__init__"}
    assert sorted(name for name in helpers if f"`{name}" not in page and f".{name}" not in page) == []


def test_a_sleep_says_what_it_is_for() -> None:
    """Tests wait by `support.waiting.until`; where time itself is what is tested, a comment stands beside the sleep."""
    sleeps = [line for each in functions() for line in each.sleeps]
    assert sleeps
    assert [line for line in sleeps if "  # " not in line] == []
