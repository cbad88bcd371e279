"""What to run: one node with all that the launch file gives it."""

from __future__ import annotations

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
