"""What the index looked at of the world outside, and what it saw there: as long as all of that is the same, what was
made from it is right, in another process too."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping
from typing import Any, NamedTuple, TypeVar

from preflight_analysis.documents.disk import REAL_PATH, STATUS, data_of, mode_of, names_in, text_of
from preflight_analysis.documents.reading import Text, Unreadable, digest
from preflight_analysis.environment.secrets import is_secret
from preflight_analysis.evaluation.commands import CommandResult, Commands
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

    def of(self, work: Callable[[], T]) -> T:
        """What `work` gives, in one revision of the files, which are noted. It may be called several times."""

        def observed() -> T:
            self._noted.clear()
            with self._sources.db.observing() as read:
                result = work()
                for kind, key, value in read((*_OF_FILES, STATUS)):
                    self._note_file(kind, str(key[0]), value)
            return result

        return self._sources.in_one_revision(observed, lambda _: self.files, likely=())

    @property
    def files(self) -> list[str]:
        """The files that were looked at."""
        return [each.name for each in self._noted if each.what in ("text", "data")]

    @property
    def observations(self) -> tuple[Observation, ...]:
        """What was noted."""
        return tuple(self._noted)

    def variables(self, variables: Mapping[str, str]) -> Mapping[str, str]:
        """The same variables; those that are looked at are noted."""
        return _Variables(variables, lambda name: self._note(_variable(variables, name)))

    def commands(self, commands: Commands) -> Commands:
        """The same results; those that are asked for are noted."""
        return _Commands(commands, self._note)

    def _note(self, observation: Observation) -> None:
        self._noted[observation] = None

    def _note_file(self, kind: object, path: str, value: object) -> None:
        if kind in _OF_FILES:
            what, name = _OF_FILES[kind]
            self._note(Observation(what, path, name(value)))
        else:
            self._note(_data(self._sources, path))


class World:
    """What is there now."""

    def __init__(self, sources: Sources, variables: Mapping[str, str], commands: Commands) -> None:
        self._sources = sources
        self._variables = variables
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
                return _variable(self._variables, name)
            case "command":
                return _result(name, self._commands.result(name))
            case "last-good":
                return _last_good(name, self._commands.last_good(name))
            case _:
                return None


def _data(sources: Sources, path: str) -> Observation:
    data = data_of(sources.db, path)
    return Observation("data", path, f"{data.kind}: {data.reason}" if isinstance(data, Unreadable) else digest(data))


def _variable(variables: Mapping[str, str], name: str) -> Observation:
    value = variables.get(name)
    if value is not None and is_secret(name, value):
        return Observation("variable", name, None)
    return Observation("variable", name, "" if value is None else digest(value))


def _result(line: str, result: CommandResult | None) -> Observation:
    return Observation("command", line, "" if result is None else digest(repr(result)))


def _last_good(series: str, line: str | None) -> Observation:
    return Observation("last-good", series, "" if line is None else digest(line))


class _Variables(dict[str, str]):
    """Variables of which it is noted which were asked for or set: what they were at first matters for both. Copies
    note it too; whoever goes through all of them without a question sees none."""

    def __init__(self, variables: Mapping[str, str], note: Callable[[str], None]) -> None:
        super().__init__(variables)
        self._note = note

    def __copy__(self) -> _Variables:
        return _Variables(self, self._note)

    def __contains__(self, name: object) -> bool:
        self._note(str(name))
        return super().__contains__(name)

    def __getitem__(self, name: str) -> str:
        self._note(name)
        return super().__getitem__(name)

    def __setitem__(self, name: str, value: str) -> None:
        self._note(name)
        super().__setitem__(name, value)

    def get(self, name: str, *default: Any) -> Any:
        self._note(name)
        return super().get(name, *default)

    def pop(self, name: str, *default: Any) -> Any:
        self._note(name)
        return super().pop(name, *default)

    def update(self, values: Mapping[str, str]) -> None:  # type: ignore[override]
        for name, value in values.items():
            self[name] = value


class _Commands:
    """Results of which it is noted which were asked for."""

    def __init__(self, commands: Commands, note: Callable[[Observation], None]) -> None:
        self.placeholder = commands.placeholder
        self._commands = commands
        self._note = note

    @property
    def edition(self) -> Hashable:
        return self._commands.edition

    def result(self, line: str) -> CommandResult | None:
        found = self._commands.result(line)
        self._note(_result(line, found))
        return found

    def last_good(self, series: str) -> str | None:
        found = self._commands.last_good(series)
        self._note(_last_good(series, found))
        return found

    def snapshot(self) -> Commands:
        return self._commands.snapshot()
