"""What accumulates while a launch file of ROS 2 is evaluated, or a part of it by itself."""

from __future__ import annotations

from collections.abc import Mapping
from collections.abc import Set as AbstractSet
from typing import cast

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.document import Document
from preflight_analysis.documents.span import Location, Origin
from preflight_analysis.evaluation.before import Before, Question
from preflight_analysis.evaluation.collector import Collected, Collector
from preflight_analysis.evaluation.ros2.context import NotByPartsError
from preflight_analysis.evaluation.surroundings import Surroundings
from preflight_analysis.evaluation.tree import Arg, Edited, Include
from preflight_analysis.launch.problems import ProblemKind


@dataclass(frozen=True, slots=True, eq=False)
class Added:
    """What a part of a launch adds. `room` is what its values took of that."""

    collected: Collected
    nodes_before: tuple[int, ...]
    args: Mapping[str, Arg]
    made: Mapping[str, Document]
    edited: Mapping[str, Edited]
    anonymous: Mapping[str, int]
    reported: set[tuple[type[ProblemKind], Origin, object]]
    room: int


class State(Collector):
    """The growing result of a ROS 2 launch, or of a part of it by itself: that asks for what is `before` it."""

    def __init__(
        self,
        within: Surroundings,
        *,
        by_parts: bool = False,
        before: Before | None = None,
        assumed: AbstractSet[Location] = frozenset(),
    ) -> None:
        super().__init__(2, within, by_parts=by_parts, assumed=assumed)
        self.nodes_before: list[int] = []
        """For each include how many nodes came before it."""
        self._before = before
        self._first_room = self._room[0]
        self._includes_before = 0

    @property
    def include_count(self) -> int:
        """How many includes the launch has so far."""
        return self._includes_before + len(self.includes)

    def include(self, include: Include) -> None:
        """Note an include."""
        self.includes.append(include)
        self.nodes_before.append(len(self.nodes))

    # Parts

    def part(self, before: Before) -> State:
        """That of a part that comes next."""
        part = State(self.within, by_parts=self.by_parts, before=before)
        part._room, part._first_room = [*self._room], self._room[0]
        part._includes_before = self.include_count
        return part

    def added(self) -> Added:
        """All that this part has added."""
        return Added(
            self.collected(),
            tuple(self.nodes_before),
            self.args,
            self.made,
            self.edited,
            self._anonymous,
            self._reported,
            self._first_room - self._room[0],
        )

    def absorb(self, added: Added, most_includes: int) -> None:
        """Add what a part has added. Raises `NotByPartsError` where there is no room for it."""
        if added.room > self._room[0] or self.include_count + len(added.nodes_before) > most_includes:
            raise NotByPartsError
        self._room[0] -= added.room
        here = len(self.nodes)
        self.nodes_before += [here + count for count in added.nodes_before]
        self.add(added.collected)
        self._reported |= added.reported
        for name, arg in added.args.items():
            self.args.setdefault(name, arg)
        self.made.update(added.made)
        self.edited.update(added.edited)
        self._anonymous.update(added.anonymous)

    def look(self, question: Question) -> object:
        """What is answered to those that come after this."""
        kind, name = question
        if kind == "made":
            return self.text_made(cast(str, name))
        return self.is_edited(cast(str, name)) if kind == "edited" else self._anonymous_count(cast(str, name))

    QUESTIONS = frozenset({"made", "edited", "anonymous"})

    def text_made(self, path: str) -> Document | None:
        """As for any launch."""
        found = super().text_made(path)
        return found if found is not None or self._before is None else self._before.ask("made", path)

    def is_edited(self, path: str) -> bool:
        """As for any launch."""
        found = super().is_edited(path)
        return found if found or self._before is None else self._before.ask("edited", path)

    def anonymous_name(self, identifier: str) -> str:
        """As for any launch."""
        self._anonymous[identifier] = self._anonymous_count(identifier)
        return super().anonymous_name(identifier)

    def _anonymous_count(self, identifier: str) -> int:
        if self._before is not None and identifier not in self._anonymous:
            found: int = self._before.ask("anonymous", identifier)
            return found
        return self._anonymous.get(identifier, 0)

    def has_room(self, length: int, origin: Origin) -> bool:
        """As for any launch; what there is no room for depends on all that comes before."""
        found = super().has_room(length, origin)
        if self.by_parts and not found:
            raise NotByPartsError
        return found
