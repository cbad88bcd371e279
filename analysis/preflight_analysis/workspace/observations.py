"""What the index looked at of the world outside, and what it saw there: as long as all of that is the same, what was
made from it is right, in another process too."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, NamedTuple, TypeVar

from preflight_analysis.documents.disk import REAL_PATH, STATUS, data_of, mode_of, names_in, text_of
from preflight_analysis.documents.reading import Text, Unreadable, digest
from preflight_analysis.environment.model import Environment
from preflight_analysis.environment.variables import WITHHELD, value_of, variable_of
from preflight_analysis.evaluation.commands import CommandResult, Commands, lines_answering, result_of
from preflight_analysis.workspace.sources import Sources

T = TypeVar("T")


class Observation(NamedTuple):
    """`what` of the world was looked at, as `_KINDS` names it; `name` is a path, a variable or a command line; and
    `answer` names what was there. None: it is nothing to remember, so that nobody sees it again."""

    what: str
    name: str
    answer: str | None


def _of_text(text: Text | Unreadable) -> str:
    if isinstance(text, Unreadable):
        return f"{text.kind}: {text.reason}"
    # An editor's text has no encoding: that makes no difference to what is read from it, unless it names one itself.
    as_is = text.plain and text.encoding in (None, "utf-8") and "encoding" not in text.text[:300]
    return text.digest if as_is else f"{text.digest} {text.plain} {text.encoding}"


def _of_names(names: tuple[str, ...]) -> str:
    return digest("\0".join(names))


_OF_FILES: Mapping[Any, tuple[str, Callable[[Any], str]]] = {
    text_of: ("text", _of_text),
    mode_of: ("mode", str),
    names_in: ("names", _of_names),
    REAL_PATH: ("real path", str),
}
"""What names the values of inputs and queries: of these and no others the disk is known by."""


class Notes:
    """Notes what work looks at."""

    def __init__(self, sources: Sources) -> None:
        self._sources = sources
        self._noted: dict[Observation, None] = {}

    def of(self, work: Callable[[], T], pause: Callable[[], object] = lambda: None) -> T:
        """What `work` gives, in one revision of the files, which are noted. It may be called several times, where texts
        change meanwhile, after a `pause`."""

        def observed() -> T:
            self._noted.clear()
            with self._sources.db.observing() as read:
                result = work()
                kinds = (*_OF_FILES, *_OF_OTHERS, STATUS)
                self._noted.update(
                    (self._observation(kind, str(key[-1]), value), None) for kind, key, value in read(kinds)
                )
            return result

        return self._sources.in_one_revision(observed, lambda _: self.files, likely=(), pause=pause)

    @property
    def files(self) -> list[str]:
        """The files that were looked at."""
        return [each.name for each in self._noted if each.what in ("text", "data")]

    @property
    def observations(self) -> tuple[Observation, ...]:
        """What was noted."""
        return tuple(self._noted)

    def _observation(self, kind: object, name: str, value: Any) -> Observation:
        if kind is text_of and isinstance(value, Text) and self._is_elsewhere(name):
            return Observation("text", name, None)
        if kind in _OF_FILES:
            what, of = _OF_FILES[kind]
            return Observation(what, name, of(value))
        if kind in _OF_OTHERS:
            return _OF_OTHERS[kind](name, value)
        found = _data(self._sources, name)
        return found._replace(answer=None) if self._is_elsewhere(name) else found

    def _is_elsewhere(self, path: str) -> bool:
        """Whether a file is the user's own and not the workspace's: nothing of it is written to the disk."""
        return self._sources.access.is_outside(path)


class World:
    """What is there now."""

    def __init__(self, sources: Sources, environment: Environment, commands: Commands) -> None:
        self._sources = sources
        self._environment = environment
        self._commands = commands

    def same(self, observation: Observation) -> bool:
        """Whether somebody who looks there now sees the same."""
        return observation.answer is not None and observation == self._now(observation.what, observation.name)

    def _now(self, what: str, name: str) -> Observation | None:
        match what:
            case "text":
                return Observation(what, name, _of_text(text_of(self._sources.db, name)))
            case "mode":
                return Observation(what, name, str(mode_of(self._sources.db, name)))
            case "names":
                return Observation(what, name, _of_names(names_in(self._sources.db, name)))
            case "real path":
                return Observation(what, name, REAL_PATH(self._sources.db, name))
            case "data":
                return _data(self._sources, name)
            case "variable":
                return _variable(name, value_of(self._environment, name))
            case "command":
                return _result(name, self._commands.result(name))
            case "answering":
                return _answering(name, self._commands.answering(name))
            case _:
                return None


def _data(sources: Sources, path: str) -> Observation:
    data = data_of(sources.db, path)
    return Observation("data", path, f"{data.kind}: {data.reason}" if isinstance(data, Unreadable) else digest(data))


def _variable(name: str, value: str | None) -> Observation:
    if value == WITHHELD:
        return Observation("variable", name, None)
    return Observation("variable", name, "" if value is None else digest(value))


def _result(line: str, result: CommandResult | None) -> Observation:
    return Observation("command", line, "" if result is None else digest(repr(result)))


def _answering(question: str, lines: tuple[str, ...]) -> Observation:
    return Observation("answering", question, digest("\0".join(lines)) if lines else "")


_OF_OTHERS: Mapping[Any, Callable[[str, Any], Observation]] = {
    variable_of: _variable,
    result_of: _result,
    lines_answering: _answering,
}
