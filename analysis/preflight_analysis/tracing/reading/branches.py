"""Both branches of the conditions that are not known: the file is read again with another answer to one of them.

As an action whose condition is not known is left out of a launch in XML and looked into afterwards
(`workspace/branches.py`), the first reading takes one branch of each, and what another one makes is told beside it
(`evaluation/ros2/python_branches.py` has both together). A condition that is met only in another branch is answered
both ways there. Combinations are not tried.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

from preflight_analysis.evaluation.ros2.python_branches import shape

MAX_BRANCHES = 8
"""Further readings."""
MAX_STEPS = 60_000
"""Of the interpreter, in all of them: no further one is begun after so many."""
MAX_DEPTH = 3
"""Of conditions that are met in other branches only."""


_TOLD = ("actions", "set", "unset", "env")


class Asked(NamedTuple):
    """A condition that is not known: its text, and whether it counts as true."""

    text: str
    holds: bool


class Reading(NamedTuple):
    """One reading: its answer, the conditions that it met, by the calls that lead to them, and what it took."""

    answer: dict[str, Any]
    asked: Mapping[str, Asked]
    steps: int


Read = Callable[[frozenset[str]], Reading | None]
"""Reads the file with the other answer to these conditions; None where that is not done."""


def with_branches(first: Reading, otherwise: frozenset[str], read: Read) -> dict[str, Any]:
    """The answer of a reading with its `branches`. The conditions `otherwise` got the other answer already."""
    waiting = deque([(first.answer, first.asked, otherwise)] if "actions" in first.answer else [])
    seen, steps, count = {*otherwise, *first.asked}, 0, 0
    while waiting:
        answer, asked, answers = waiting.popleft()
        for key, condition in asked.items():
            if count == MAX_BRANCHES or steps > MAX_STEPS:
                return first.answer
            count += 1
            other = read(answers | {key})
            if other is None:
                continue
            steps += other.steps
            told = {name: other.answer[name] for name in _TOLD if name in other.answer}
            if "actions" not in told or all(shape(answer.get(name)) == shape(each) for name, each in told.items()):
                continue
            branch = {**told, "asked": key, "if": condition.text, "holds": not condition.holds}
            answer.setdefault("branches", []).append(branch)
            if len(answers) - len(otherwise) + 1 < MAX_DEPTH:
                waiting.append((branch, {k: v for k, v in other.asked.items() if k not in seen}, answers | {key}))
                seen.update(other.asked)
    return first.answer
