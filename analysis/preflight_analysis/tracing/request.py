"""What to run: one node with all that the launch file gives it."""

from __future__ import annotations

import shlex
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any


@dataclass(frozen=True, slots=True)
class TraceRequest:
    """A run. `params` is the parameter server of the whole launch by full name, private parameters included."""

    node: str
    """Full name."""
    package: str
    executable: str
    """Absolute path."""
    args: tuple[str, ...] = ()
    """The node's own arguments, split as a shell would."""
    remaps: tuple[tuple[str, str], ...] = ()
    """`(from, to)` as roslaunch hands them to the node."""
    params: Mapping[str, Any] = field(default_factory=dict)
    env: tuple[tuple[str, str], ...] = ()
    """What the launch file sets for the node."""
    cwd: str | None = None
    generation: int = 1
    """Of ROS. In ROS 2 `params` are the node's own, by the full name of the node and their own after it."""
    entry_point: str | None = None
    """`module:function` where `executable` is the file of a Python module that is run from its source."""
    named: bool = True
    """Whether the launch file names the node; its own code does otherwise."""
    launch: str | None = field(default=None, compare=False)
    """The launch file with the node's tag: for telling where a trace comes from, it is no part of the run."""


def split_args(text: str) -> tuple[str, ...]:
    """A node's arguments as roslaunch hands them over; split at blanks where a quote is left open."""
    try:
        return tuple(shlex.split(text))
    except ValueError:
        return tuple(text.split())
