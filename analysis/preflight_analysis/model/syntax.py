"""From places in a tree back to the tags that made them: scopes, conditions, and what is written literally."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Location
from preflight_analysis.findings.finding import Fix
from preflight_analysis.incremental.derived import derived
from preflight_analysis.launch.model import Action, LaunchFile
from preflight_analysis.model.context import Context
from preflight_analysis.model.problems import fix

CONDITIONS = ("if", "unless")


@dataclass(frozen=True, slots=True)
class Tag:
    """A tag and those around it, the innermost first."""

    action: Action
    above: tuple[Action, ...]


class Tags:
    """The tags of launch files by the place of their start tag."""

    def __init__(self, launch_files: Mapping[str, LaunchFile]) -> None:
        self._launch_files = launch_files

    def at(self, location: Location) -> Tag | None:
        """The tag whose start tag begins at the place."""
        return self._of_file(location.file).get(location.span.start)

    def named_at(self, location: Location) -> Tag | None:
        """The tag whose name stands at the place."""
        return self._of_file(location.file).get(location.span.start - 1)

    def around(self, location: Location) -> Tag | None:
        """The tag in whose start tag the place is."""
        by_start = self._of_file(location.file)
        starts = [start for start in by_start if start <= location.span.start]
        tag = by_start[max(starts)] if starts else None
        return tag if tag is not None and location.span.end <= tag.action.head_span.end else None

    def siblings(self, one: Location, other: Location) -> bool:
        """Whether both tags stand directly in the same element."""
        first, second = self.at(one), self.at(other)
        if first is None or second is None or not first.above or not second.above:
            return False
        return first.above[0] is second.above[0]

    def conditional(self, location: Location) -> bool:
        """Whether the tag itself has a condition."""
        tag = self.at(location)
        return tag is not None and has_condition(tag.action)

    def _of_file(self, file: str) -> Mapping[int, Tag]:
        launch_file = self._launch_files.get(file)
        return _by_start(launch_file) if launch_file is not None else {}


@derived
def _by_start(launch_file: LaunchFile) -> Mapping[int, Tag]:
    if launch_file.root is None:
        return {}
    return {tag.action.head_span.start: tag for tag in _tags(launch_file.root, ())}


def removal(context: Context, tags: Tags, location: Location, title: str) -> tuple[Fix, ...]:
    """A fix that removes the tag whose start tag begins at the place."""
    writer, tag = context.writer(location.file), tags.at(location)
    return fix(title, writer.remove(tag.action)) if writer is not None and tag is not None else ()


def has_condition(action: Action) -> bool:
    """Whether the tag has `if` or `unless`."""
    return any(action.attribute(name) is not None for name in CONDITIONS)


def _tags(action: Action, above: tuple[Action, ...]) -> Iterator[Tag]:
    yield Tag(action, above)
    inside = (action, *above)
    for child in action.children:
        yield from _tags(child, inside)
