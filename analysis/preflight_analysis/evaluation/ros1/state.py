"""What accumulates while a launch file is evaluated."""

from __future__ import annotations

from collections.abc import Set as AbstractSet

from preflight_analysis.documents.span import Location, Origin, Span
from preflight_analysis.evaluation.collector import Collector
from preflight_analysis.evaluation.ros1.included import Record
from preflight_analysis.evaluation.ros1.scope import Scope
from preflight_analysis.evaluation.surroundings import Surroundings
from preflight_analysis.evaluation.tree import (
    Machine,
    Param,
)

MAX_INCLUDES = 2_000
"""Real launches stay below a few hundred; an include that multiplies itself does not."""


class State(Collector):
    """The growing result of a ROS 1 launch."""

    def __init__(
        self,
        within: Surroundings,
        *,
        by_parts: bool = False,
        is_included: bool = False,
        assumed: AbstractSet[Location] = frozenset(),
        outline: bool = False,
    ) -> None:
        super().__init__(1, within, by_parts=by_parts, assumed=assumed)
        self.outline = outline
        """Whether nobody wants to know what YAML says and where executables are."""
        self.is_included = is_included
        """Whether it is that of an included file alone, without what is above it."""
        self.node_names: dict[str, Location | None] = {"/rosout": None}
        self.params: dict[str, Param] = {}
        self.clear_params: list[str] = []
        self.machines: dict[str, Machine] = {}
        self.exhausted = False
        """Whether something was nested too deeply to be evaluated."""
        self.depends_on_outside = False
        """Whether the result depends on more than what `included.Passed` names: anonymous names are counted over the
        whole launch, machines known to all of it, and includes that include themselves bounded by what is above
        them."""

    @property
    def include_count(self) -> int:
        """How many includes the launch has so far."""
        return len(self.includes)

    def inner(self) -> State:
        """A state for one tag alone, to be taken over with `absorb`."""
        inner = State(self.within, by_parts=self.by_parts, is_included=self.is_included, assumed=self._assumed)
        inner._digests, inner._room = self._digests, self._room
        return inner

    def record(self, inside: Scope, default_machine: str | None = None) -> Record:
        """All that was added in the scope `inside`, for which this state was made."""
        node_names = {name: place for name, place in self.node_names.items() if place is not None}
        declared, cleared = inside.arguments.declared, tuple(self.clear_params)
        return Record(self.collected(), node_names, self.params, cleared, declared, default_machine)

    def absorb(self, record: Record) -> bool:
        """Add what an include added; not if its nodes' names are taken or there would be too many includes."""
        if not self.node_names.keys().isdisjoint(record.node_names):
            return False
        if self.include_count + len(record.collected.includes) > MAX_INCLUDES:
            return False
        self.node_names.update(record.node_names)
        again = {name: self._replacing(record.params[name]) for name in self.params.keys() & record.params.keys()}
        self.params.update(record.params)
        self.params.update(again)
        self.clear_params += record.clear_params
        self.add(record.collected)
        return True

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
