"""The workspace index as plain data: for keeping it, and for handing it from one process to another.

An entry is right exactly while all that was looked at for it (`observations.py`) is as it was: contents are compared,
not times. What is not right, or not understood, is left out.
"""

from __future__ import annotations

import itertools
import json
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, TypeVar, get_args

from preflight_analysis.documents.disk import text_of
from preflight_analysis.documents.span import LineIndex, Location, Span
from preflight_analysis.model.entry import Entry, Kind, Mention
from preflight_analysis.workspace.facts import ArgDeclaration, FileFacts
from preflight_analysis.workspace.index import Inclusion, NodeEntry, Root, RootEntry, WorkspaceIndex
from preflight_analysis.workspace.observations import Observation, World
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace

T = TypeVar("T")
_KINDS: tuple[Kind, ...] = get_args(Kind)
_NOT_UNDERSTOOD = (KeyError, IndexError, TypeError, ValueError, AttributeError, OverflowError, RecursionError)
_STEP = 32
"""Entries that are read in one revision: an edit waits for so many at most. They are one text, as all threads stand
still while JSON is read or written."""


def data_of_index(sources: Sources, index: WorkspaceIndex) -> dict[str, Any]:
    """An index as what JSON can say. What of it is not right any more is left out."""
    return sources.in_one_revision(lambda: _Writer(sources).index(index), lambda _: (), likely=())


def index_of_data(
    data: Mapping[str, Any], workspace: Workspace, cancelled: Callable[[], bool] = lambda: False
) -> WorkspaceIndex:
    """What of an index is right now; nothing is ever raised. `cancelled` may wait, and what is left then is left out
    where it says so."""
    try:
        return _Reader(workspace, data).index(cancelled)
    except _NOT_UNDERSTOOD:
        return WorkspaceIndex()


class _Numbered:
    """Things by number, each once."""

    def __init__(self) -> None:
        self.numbers: dict[Any, int] = {}

    def number(self, thing: Any) -> int:
        """Its number."""
        return self.numbers.setdefault(thing, len(self.numbers))

    def all(self) -> list[Any]:
        """All things, in the order of their numbers."""
        return list(self.numbers)


class _Writer:
    """An index to plain data, within one revision of the files."""

    def __init__(self, sources: Sources) -> None:
        self._sources = sources
        self._paths = _Numbered()
        self._observations = _Numbered()

    def index(self, index: WorkspaceIndex) -> dict[str, Any]:
        """All that is still right."""
        written: dict[str, list[Inclusion]] = {}
        for inclusion in index.written:
            written.setdefault(inclusion.includer, []).append(inclusion)
        files = [e for e in index.files.values() if self._is_right(e.observations, {e.path: e.version})]
        entries = [e for e in index.entries.values() if self._is_right(e.observations, e.inputs)]
        return {
            "files": _texts_of_steps([self._facts(each, written.get(each.path, ())) for each in files]),
            "roots": _texts_of_steps([kept for each in entries if (kept := self._root(each)) is not None]),
            "paths": self._paths.all(),
            "observations": self._observations.all(),
        }

    def _is_right(self, observations: Sequence[Observation], versions: Mapping[str, str]) -> bool:
        """Whether an entry was made of the texts that are there now, with their lines: only then its places are right.
        Of all else that it was made from it is asked when the index is loaded."""
        if not observations or any(each.answer is None for each in observations):
            return False
        return all(self._sources.digest(path) == version for path, version in versions.items())

    def _facts(self, facts: FileFacts, written: Iterable[Inclusion]) -> list[Any]:
        mentions, entries = facts.mentions, _Numbered()
        numbers = [entries.number(m.entry) for m in mentions]
        return [
            self._paths.number(facts.path),
            [self._observations.number(each) for each in facts.observations],
            [[a.name, a.default, a.value, a.doc, *a.span, *a.choices] for a in facts.args],
            [[_KINDS.index(kind), *texts] for kind, *texts in entries.all()],
            numbers,
            [offset for m in mentions for offset in (*m.span, *m.action)],
            facts.has_nodes,
            sorted(facts.passing_all),
            [self._inclusion(each) for each in written],
        ]

    def _root(self, entry: RootEntry) -> list[Any] | None:
        known = {each.name for each in entry.observations if each.what == "text"}
        places = [p for i in entry.inclusions for p in (i.place, i.tag)] + [n.location for n in entry.nodes]
        if any(p.file not in known and p != Location.of_file(p.file) for p in places):
            return None  # in a text that was only made for the evaluation
        return [
            self._paths.number(entry.root.path),
            entry.root.args,
            [self._observations.number(each) for each in entry.observations],
            [self._paths.number(path) for path in entry.files],
            [self._paths.number(path) for path in entry.inputs],
            [self._inclusion(each) for each in entry.inclusions],
            [[n.name, n.package, n.executable, *self._location(n.location)] for n in entry.nodes],
            entry.unknowns,
        ]

    def _inclusion(self, inclusion: Inclusion) -> list[Any]:
        places = (*self._location(inclusion.place), *self._location(inclusion.tag))
        return [self._paths.number(inclusion.target), *places, dict(inclusion.args)]

    def _location(self, location: Location) -> tuple[int, int, int]:
        span = location.span
        none = location == Location.of_file(location.file)
        return self._paths.number(location.file), -1 if none else span.start, -1 if none else span.end


class _Reader:
    """Plain data to an index."""

    def __init__(self, workspace: Workspace, data: Mapping[str, Any]) -> None:
        self._sources = workspace.sources
        self._files = _texts(data["files"])
        self._roots = _texts(data["roots"])
        self._paths = _texts(data["paths"])
        self._observations = [
            Observation(_text(what), _text(name), _text(answer)) for what, name, answer in data["observations"]
        ]
        self._world = World(workspace.sources, workspace.environment, workspace.commands)
        self._revision = 0
        self._right: dict[int, bool] = {}
        """What is known in that revision of the observations, by number."""
        self._lines: dict[int, LineIndex] = {}

    def index(self, cancelled: Callable[[], bool]) -> WorkspaceIndex:
        """All that is still right."""
        facts: dict[str, FileFacts] = {}
        written: list[Inclusion] = []
        entries: dict[Root, RootEntry] = {}
        for text in self._files:
            if cancelled():
                break
            for found, includes in self._in_one_revision(json.loads(text), 1, self._file):
                facts[found.path] = found
                written += includes
        for text in self._roots:
            if cancelled():
                break
            entries.update((entry.root, entry) for entry in self._in_one_revision(json.loads(text), 2, self._root))
        return WorkspaceIndex(facts, entries, tuple(written))

    def _in_one_revision(
        self, some: Sequence[Sequence[Any]], seen_at: int, read: Callable[[Sequence[Any]], T]
    ) -> Sequence[T]:
        """Those of the entries that are right. Where they say what was looked at for them is `seen_at`."""
        looked_at = {number for each in some for number in each[seen_at]}
        files = [o.name for o in map(self._observations.__getitem__, looked_at) if o.what in ("text", "data")]

        def read_all() -> Sequence[T]:
            if self._revision != self._sources.db.revision:
                self._revision = self._sources.db.revision
                self._right.clear()
                self._lines.clear()
            return [read(each) for each in some if all(map(self._is_right, each[seen_at]))]

        return self._sources.in_one_revision(read_all, lambda _: files, likely=files)

    def _is_right(self, number: int) -> bool:
        known = self._right.get(number)
        if known is None:
            known = self._right[number] = self._world.same(self._observations[number])
        return known

    def _file(self, kept: Sequence[Any]) -> tuple[FileFacts, Sequence[Inclusion]]:
        return self._facts(kept), [self._inclusion(each, None) for each in kept[8]]

    def _facts(self, kept: Sequence[Any]) -> FileFacts:
        path, seen, args, known, numbers, offsets, has_nodes, passing_all, _ = kept
        at = iter(map(Span, *_offsets(offsets)))
        entries = [Entry(_KINDS[kind], *_texts(texts)) for kind, *texts in known]
        named = zip((entries[number] for number in numbers), at, at, strict=True)
        return FileFacts(
            self._paths[path],
            self._sources.digest(self._paths[path]),
            tuple(_argument(*each) for each in args),
            tuple(itertools.starmap(Mention, named)),
            bool(has_nodes),
            frozenset(Span(int(start), int(end)) for start, end in passing_all),
            self._seen(seen),
        )

    def _root(self, kept: Sequence[Any]) -> RootEntry:
        path, args, seen, files, inputs, inclusions, nodes, unknowns = kept
        root = Root.of(self._paths[path], {_text(name): _text(value) for name, value in args})
        return RootEntry(
            root,
            tuple(map(self._paths.__getitem__, files)),
            {name: self._sources.digest(name) for name in map(self._paths.__getitem__, inputs)},
            tuple(self._inclusion(each, root) for each in inclusions),
            tuple(NodeEntry(_text(n), _text(p), _text(e), self._location(*at)) for n, p, e, *at in nodes),
            int(unknowns),
            self._seen(seen),
        )

    def _inclusion(self, kept: Sequence[Any], root: Root | None) -> Inclusion:
        target, *places, args = kept
        passed = {_text(name): _text_or_none(value) for name, value in args.items()}
        place, tag = self._location(*places[:3]), self._location(*places[3:])
        return Inclusion(self._paths[target], place, tag, passed, root)

    def _location(self, path: int, start: int, end: int) -> Location:
        if start < 0:
            return Location.of_file(self._paths[path])
        lines = self._lines.get(path)
        if lines is None:
            text = text_of(self._sources.db, self._paths[path])
            lines = self._lines[path] = text.lines  # type: ignore[union-attr]  # else it is not understood
        return lines.location(self._paths[path], Span(start, end))

    def _seen(self, numbers: Sequence[int]) -> tuple[Observation, ...]:
        return tuple(map(self._observations.__getitem__, numbers))


def _argument(
    name: object, default: object, value: object, doc: object, start: int, end: int, *choices: object
) -> ArgDeclaration:
    texts = _text_or_none(default), _text_or_none(value), _text_or_none(doc)
    return ArgDeclaration(_text(name), *texts, Span(int(start), int(end)), tuple(map(_text, choices)))


def _offsets(numbers: list[int]) -> tuple[list[int], list[int]]:
    """Starts and ends."""
    if not {int}.issuperset(map(type, numbers)):
        raise TypeError("offsets are numbers")
    return numbers[::2], numbers[1::2]


def _texts(values: list[str]) -> list[str]:
    if not {str}.issuperset(map(type, values)):
        raise TypeError("names are texts")
    return values


def _text(value: object) -> str:
    if not isinstance(value, str):
        raise TypeError("a name is a text")
    return value


def _text_or_none(value: object) -> str | None:
    return None if value is None else _text(value)


def _texts_of_steps(entries: Sequence[object]) -> list[str]:
    return [json.dumps(entries[start : start + _STEP]) for start in range(0, len(entries), _STEP)]
