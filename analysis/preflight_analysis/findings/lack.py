"""What is missing on this machine: no fault of a launch file, however often it shows in one."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

LackKind = Literal["package", "build", "module", "program", "variable", "file"]
"""`package`: neither installed nor in the workspace; `build`: in the workspace and not built; `module`: of Python;
`variable`: of the environment; `file`: outside of the workspace and of all packages."""

LACK_KINDS: tuple[LackKind, ...] = ("package", "build", "module", "program", "variable", "file")
"""In the order in which they are shown: what a package brings along comes after it."""


@dataclass(frozen=True, slots=True)
class Lack:
    """Something that this machine does not have. A finding that can stand for nothing else carries one, and is a hint
    whatever its rule says (`Rule.finding`)."""

    kind: LackKind
    name: str
    remedy: str | None = None
    """The command that provides it, where one is known."""
