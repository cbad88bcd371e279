"""What accumulates while a launch file is evaluated."""

from __future__ import annotations

from typing import Any

from preflight_analysis.documents.document import Document
from preflight_analysis.documents.reading import Unreadable
from preflight_analysis.documents.span import Location, Origin, Span
from preflight_analysis.environment.model import Environment
from preflight_analysis.evaluation.commands import Commands
from preflight_analysis.evaluation.files import Executables, Files
from preflight_analysis.evaluation.ros1.scope import Scope
from preflight_analysis.evaluation.tree import (
    Arg,
    Command,
    Include,
    LaunchNode,
    Machine,
    Param,
    Problem,
    Unknown,
    Use,
)
from preflight_analysis.launch.model import LaunchFile


class State:
    """The growing result, and what everything is read from."""

    def __init__(
        self, files: Files, executables: Executables, environment: Environment, cwd: str, results: Commands
    ) -> None:
        self.files = files
        self.executables = executables
        self.results = results
        self.environment = environment
        self.cwd = cwd
        self.nodes: list[LaunchNode] = []
        self.node_names: dict[str, Location | None] = {"/rosout": None}
        self.params: dict[str, Param] = {}
        self.clear_params: list[str] = []
        self.includes: list[Include] = []
        self.machines: dict[str, Machine] = {}
        self.args: dict[str, Arg] = {}
        self.commands: list[Command] = []
        self.uses: list[Use] = []
        self.problems: list[Problem] = []
        self.unknowns: list[Unknown] = []
        self.visited: list[str] = []
        self.inputs: dict[str, str] = {}
        self.exhausted = False
        """Whether something was nested too deeply to be evaluated."""
        self._anonymous: dict[str, int] = {}
        self._reported: set[tuple[str, Origin, str]] = set()

    def problem(self, kind: str, origin: Origin, *, fatal: bool = True, **data: Any) -> None:
        """Note a problem; the same one at the same place once."""
        key = (kind, origin, str(data.get("name")))
        if key not in self._reported:
            self._reported.add(key)
            self.problems.append(Problem(kind, origin, data, fatal))

    def unknown(self, what: str, reason: str, scope: Scope, span: Span) -> None:
        """Note a value that cannot be known."""
        self.unknowns.append(Unknown(what, reason, Location(scope.file, span)))

    def anonymous_name(self, identifier: str) -> str:
        """A fresh name for `$(anon identifier)`, numbered in the order of evaluation."""
        count = self._anonymous[identifier] = self._anonymous.get(identifier, 0) + 1
        return f"{identifier}_ANON{count}"

    def read_launch_file(self, path: str) -> LaunchFile | Unreadable:
        """A launch file, noted as an input."""
        self.inputs[path] = self.files.digest(path)
        return self.files.launch_file(path)

    def read_text(self, path: str) -> Document | Unreadable:
        """A text file, noted as an input."""
        self.inputs[path] = self.files.digest(path)
        return self.files.text(path)

    def read_data(self, path: str) -> bytes | Unreadable:
        """The bytes of a file, noted as an input."""
        self.inputs[path] = self.files.digest(path)
        return self.files.data(path)
