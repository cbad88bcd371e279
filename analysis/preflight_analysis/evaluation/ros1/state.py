"""What accumulates while a launch file is evaluated."""

from __future__ import annotations

from collections.abc import Hashable, Mapping

from preflight_analysis.documents.span import Location, Origin, Span
from preflight_analysis.environment.model import Environment
from preflight_analysis.evaluation.collector import Collector
from preflight_analysis.evaluation.commands import Commands
from preflight_analysis.evaluation.files import Executables, Files
from preflight_analysis.evaluation.ros1.memo import Memo, Record, TagRecords
from preflight_analysis.evaluation.ros1.scope import Scope
from preflight_analysis.evaluation.tree import (
    Machine,
    Param,
)


class State(Collector):
    """The growing result of a ROS 1 launch."""

    def __init__(
        self,
        files: Files,
        executables: Executables,
        environment: Environment,
        cwd: str,
        results: Commands,
        memo: Memo | None = None,
    ) -> None:
        super().__init__(1, files, executables, environment, cwd, results)
        self.memo = memo
        self.node_names: dict[str, Location | None] = {"/rosout": None}
        self.params: dict[str, Param] = {}
        self.clear_params: list[str] = []
        self.machines: dict[str, Machine] = {}
        self.exhausted = False
        """Whether something was nested too deeply to be evaluated."""
        self.depends_on_outside = False
        """Whether the result depends on more than what `memo.key_of` names: anonymous names are counted over the whole
        launch, machines known to all of it, and includes that include themselves bounded by what is above them."""
        self.tag_records: dict[Hashable, TagRecords] = {}
        """By scope, those of this evaluation."""
        self.includes_before = 0
        """How many includes the states around this one have met."""

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
        inner._room, inner.tag_records = self._room, self.tag_records
        inner.includes_before, inner.exhausted = self.include_count, self.exhausted
        return inner

    def record(self, inside: Scope, default_machine: str | None) -> Record:
        """All that the file of `inside`, for which this state was made, added."""
        node_names = {name: place for name, place in self.node_names.items() if place is not None}
        return Record(
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
            tuple(self.not_taken),
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
        again = {name: self._replacing(record.params[name]) for name in self.params.keys() & record.params.keys()}
        self.params.update(record.params)
        self.params.update(again)
        self.clear_params += record.clear_params
        self.includes += record.includes
        self.commands += record.commands
        self.uses += record.uses
        self.unknowns += record.unknowns
        self.not_taken += record.not_taken
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

    def set_param(self, param: Param) -> None:
        """Set a parameter as the last one to do so; what it replaces is kept with it."""
        self.params[param.name] = self._replacing(param)

    def _replacing(self, param: Param) -> Param:
        """The parameter with those that it takes the place of; the one that was set is not set any more."""
        old = self.params.pop(param.name, None)
        if old is None:
            return param
        return param._replace(overrides=(*old.overrides, old._replace(overrides=()), *param.overrides))

    def has_room(self, length: int, origin: Origin) -> bool:
        """As for any launch; what there was no room for is not remembered for another place."""
        found = super().has_room(length, origin)
        self.depends_on_outside |= not found
        return found

    def unknown(self, what: str, reason: str, scope: Scope, span: Span, param: str | None = None) -> None:
        """Note a value that cannot be known, of the parameter `param` if it is one's."""
        self.note_unknown(what, reason, scope.location(span), param)

    def anonymous_name(self, identifier: str) -> str:
        """As for any launch; what depends on the count is not remembered for another place."""
        self.depends_on_outside = True
        return super().anonymous_name(identifier)
