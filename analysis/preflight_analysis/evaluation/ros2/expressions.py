"""Expressions of `$(eval)` and PythonExpression that our own evaluator does not do: what is asked of their runs, and
what the answers say. Nothing is run here.

A request names a run completely, and is answered like a command (`evaluation/commands.py`), by
`tracing/expressions.py`.
"""

from __future__ import annotations

import json
from collections.abc import Iterable
from typing import Any

from preflight_analysis.dataclass import dataclass

MARK = "\0expression "
"""What no command line begins with."""
WITHOUT_MODULES = ("ardent", "bouncy", "crystal", "dashing", "eloquent", "foxy", "galactic", "humble")
"""The distributions whose PythonExpression has the names of `math`, and takes no modules."""


@dataclass(frozen=True, slots=True)
class Outcome:
    """What an expression came to: its text, or why it has none. `sure`: it fails wherever it is evaluated."""

    text: str | None
    error: str = ""
    sure: bool = True


def request(expression: str, modules: Iterable[str], distro: str | None) -> str:
    """The name of a run."""
    request = {"expression": expression, "modules": list(modules), "imports": distro not in WITHOUT_MODULES}
    return MARK + json.dumps(request, sort_keys=True)


def parse_request(line: str) -> dict[str, Any] | None:
    """What `request` made a text from; None if it is something else."""
    if not line.startswith(MARK):
        return None
    found: dict[str, Any] = json.loads(line[len(MARK) :])
    return found


def read_answer(output: str) -> Outcome:
    """What a run printed, last: the expression may print as well."""
    try:
        reply = json.loads(output.rpartition("\n")[2])
        if isinstance(reply.get("text"), str):
            return Outcome(reply["text"])
        return Outcome(None, str(reply["error"]), reply.get("sure") is True)
    except (ValueError, RecursionError, KeyError, AttributeError):
        return Outcome(None, "its run gave no answer that can be read", sure=False)
