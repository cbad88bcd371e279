"""What accumulates while a launch file is evaluated."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from preflight_analysis.documents.document import Document
from preflight_analysis.documents.reading import Unreadable
from preflight_analysis.documents.span import Location, Origin, Span
from preflight_analysis.environment.model import Environment
from preflight_analysis.evaluation.commands import Commands
from preflight_analysis.evaluation.files import Executables, Files, without_dots
from preflight_analysis.evaluation.ros1.memo import Memo, Record
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
        self,
        files: Files,
        executables: Executables,
        environment: Environment,
        cwd: str,
        results: Commands,
        memo: Memo | None = None,
    ) -> None:
        self.files = files
        self.executables = executables
        self.results = results
        self.environment = environment
        self.cwd = cwd
        self.memo = memo
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
        self.depends_on_outside = False
        """Whether the result depends on more than what `memo.key_of` names: anonymous names are counted over the whole
        launch, machines known to all of it, and includes that include themselves bounded by what is above them."""
        self.includes_before = 0
        """How many includes the states around this one have met."""
        self._digests: dict[str, str] = {}
        self._anonymous: dict[str, int] = {}
        self._reported: set[tuple[str, Origin, str]] = set()

    @property
    def anonymous_names(self) -> Mapping[str, int]:
        """How many anonymous names of each identifier were made."""
        return dict(self._anonymous)

    @anonymous_names.setter
    def anonymous_names(self, counts: Mapping[str, int]) -> None:
        self._anonymous.clear()
        self._anonymous.update(counts)

    @property
    def include_count(self) -> int:
        """How many includes the launch has so far."""
        return self.includes_before + len(self.includes)

    def inner(self) -> State:
        """A state for an included file alone, to be taken over with `absorb`."""
        inner = State(self.files, self.executables, self.environment, self.cwd, self.results, self.memo)
        inner.machines, inner._anonymous, inner._digests = self.machines, self._anonymous, self._digests
        inner.includes_before, inner.exhausted = self.include_count, self.exhausted
        return inner

    def record(self, inside: Scope, given: Mapping[str, Origin | None], default_machine: str | None) -> Record:
        """All that the file of `inside`, for which this state was made, added. `given`: where its args come from."""
        node_names = {name: place for name, place in self.node_names.items() if place is not None}
        return Record(
            inside.chain,
            given,
            {inside.file: self.digest(inside.file), **self.inputs},
            tuple(self.visited),
            tuple(self.nodes),
            node_names,
            self.params,
            tuple(self.clear_params),
            tuple(self.includes),
            tuple(self.commands),
            tuple(self.uses),
            tuple(self.problems),
            tuple(self.unknowns),
            inside.declared,
            default_machine,
        )

    def absorb(self, record: Record, most_includes: int | None = None) -> bool:
        """Add what an include added; not if its nodes' names are taken or there would be too many includes."""
        if not self.node_names.keys().isdisjoint(record.node_names):
            return False
        if most_includes is not None and self.include_count + len(record.includes) > most_includes:
            return False
        self.node_names.update(record.node_names)
        self.nodes += record.nodes
        if self.params.keys().isdisjoint(record.params):
            self.params.update(record.params)
        else:
            for param in record.params.values():
                self.set_param(param)
        self.clear_params += record.clear_params
        self.includes += record.includes
        self.commands += record.commands
        self.uses += record.uses
        self.unknowns += record.unknowns
        for problem in record.problems:
            self._add(problem)
        self.visited += [path for path in record.visited if path not in self.visited]
        self.inputs.update(record.inputs)
        return True

    def is_current(self, record: Record) -> bool:
        """Whether what a record was made from is unchanged."""
        return all(self.digest(path) == digest for path, digest in record.inputs.items()) and all(
            self.results.result(command.line) == command.result for command in record.commands
        )

    def digest(self, path: str) -> str:
        """Names the content of a file, which is looked up once."""
        found = self._digests.get(path)
        if found is None:
            found = self._digests[path] = self.files.digest(path)
        return found

    def set_param(self, param: Param) -> None:
        """Set a parameter as the last one to do so; what it replaces is kept with it."""
        old = self.params.pop(param.name, None)
        if old is not None:
            param = param._replace(overrides=(*old.overrides, old._replace(overrides=()), *param.overrides))
        self.params[param.name] = param

    def problem(self, kind: str, origin: Origin, *, fatal: bool = True, **data: Any) -> None:
        """Note a problem; the same one at the same place once."""
        self._add(Problem(kind, origin, data, fatal))

    def _add(self, problem: Problem) -> None:
        key = (problem.kind, problem.origin, str(problem.data.get("name")))
        if key not in self._reported:
            self._reported.add(key)
            self.problems.append(problem)

    def unknown(self, what: str, reason: str, scope: Scope, span: Span) -> None:
        """Note a value that cannot be known."""
        self.unknowns.append(Unknown(what, reason, Location(scope.file, span)))

    def anonymous_name(self, identifier: str) -> str:
        """A fresh name for `$(anon identifier)`, numbered in the order of evaluation."""
        self.depends_on_outside = True
        count = self._anonymous[identifier] = self._anonymous.get(identifier, 0) + 1
        return f"{identifier}_ANON{count}"

    def read_launch_file(self, path: str) -> LaunchFile | Unreadable:
        """A launch file, noted as an input."""
        self.inputs[path] = self.digest(path)
        return self.files.launch_file(path)

    def read_text(self, path: str) -> Document | Unreadable:
        """A text file, noted as an input."""
        real = without_dots(path)
        if real is None:
            return Unreadable(path, "does not exist", "missing")
        self.inputs[real] = self.digest(real)
        return self.files.text(real)

    def read_data(self, path: str) -> bytes | Unreadable:
        """The bytes of a file, noted as an input."""
        real = without_dots(path)
        if real is None:
            return Unreadable(path, "does not exist", "missing")
        self.inputs[real] = self.digest(real)
        return self.files.data(real)
