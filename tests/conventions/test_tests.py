"""What holds for each test: it asserts something, and it waits for conditions."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from functools import cache
from pathlib import Path

TESTS = Path(__file__).parents[1]
Function = ast.FunctionDef | ast.AsyncFunctionDef
RAISES = {"raises", "fail", "warns"}
"""Functions of pytest that a test may assert by."""


@cache
def parsed() -> dict[Path, ast.Module]:
    return {path: ast.parse(path.read_text(encoding="utf-8")) for path in sorted(TESTS.rglob("*.py"))}


def functions() -> Iterator[tuple[Path, Function]]:
    for path, tree in parsed().items():
        yield from ((path, node) for node in ast.walk(tree) if isinstance(node, Function))


def called(node: ast.AST) -> set[str]:
    """The names of the functions and methods that are called in it."""
    calls = (each.func for each in ast.walk(node) if isinstance(each, ast.Call))
    return {call.attr if isinstance(call, ast.Attribute) else getattr(call, "id", "") for call in calls}


def test_each_test_asserts_something() -> None:
    """By itself or by a function of the tests that does."""
    calls = {(path, node): called(node) for path, node in functions()}
    direct = {node for _, node in calls if any(isinstance(each, ast.Assert) for each in ast.walk(node))}
    asserting = RAISES | {node.name for node in direct}
    while more := {node.name for (_, node), names in calls.items() if names & asserting} - asserting:
        asserting |= more
    silent = [
        f"{path.relative_to(TESTS)}:{node.lineno} {node.name}"
        for (path, node), names in calls.items()
        if node.name.startswith("test_") and node not in direct and not names & asserting
    ]
    assert silent == []


def test_a_sleep_says_what_it_is_for() -> None:
    """Tests wait by `support.waiting.until`; where time itself is what is tested, a comment stands beside the sleep."""
    unexplained = []
    for path, tree in parsed().items():
        lines = path.read_text(encoding="utf-8").splitlines()
        for node in ast.walk(tree):
            if isinstance(node, ast.Call) and ast.unparse(node.func) in ("time.sleep", "asyncio.sleep"):
                line = lines[node.lineno - 1]
                if "  # " not in line:
                    unexplained.append(f"{path.relative_to(TESTS)}:{node.lineno} {line.strip()}")
    assert unexplained == []
