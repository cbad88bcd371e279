"""The workspace index from one start to the next: what was made of files that are still the same is not made again.

It is kept as plain data. An entry holds exactly while all that was looked at for it (`observations.py`) is as it was:
contents are compared, not times. Whatever cannot be read or understood is made anew.
"""

from __future__ import annotations

import functools
import hashlib
import itertools
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, get_args

import preflight_analysis
from preflight_analysis.documents.disk import text_of
from preflight_analysis.documents.span import LineIndex, Location, Span
from preflight_analysis.tracing.store import Place, Store, digest_of
from preflight_analysis.workspace.facts import ArgDeclaration, FileFacts, Kind, Mention
from preflight_analysis.workspace.index import Inclusion, NodeEntry, Root, RootEntry, WorkspaceIndex
from preflight_analysis.workspace.indexing import Report, build_index
from preflight_analysis.workspace.observations import Observation, World
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace

SCHEMA = "ros-preflight/index/1"
MAX_BYTES = 256 << 20
MAX_ENTRY_BYTES = 64 << 20
"""Of one workspace. One of 1,000 launch files has some 4 MB."""
_KINDS: tuple[Kind, ...] = get_args(Kind)
_NOT_UNDERSTOOD = (KeyError, IndexError, TypeError, ValueError, AttributeError)


def build_from_kept(
    store: IndexStore,
    workspace: Workspace,
    folder: str,
    named: Sequence[Root] = (),
    *,
    report: Report = lambda done, total, path: None,
    cancelled: Callable[[], bool] = lambda: False,
) -> WorkspaceIndex | None:
    """The index of a folder as `build_index` makes it, with what of a kept one is still right; and keep it."""
    known = store.load(workspace, folder)
    index = build_index(workspace, folder, named, previous=known, changed=(), report=report, cancelled=cancelled)
    if index is not None and not (_same(index.files, known.files) and _same(index.entries, known.entries)):
        store.save(workspace, folder, index)
    return index


def _same(some: Mapping[Any, object], others: Mapping[Any, object]) -> bool:
    return len(some) == len(others) and all(others.get(key) is each for key, each in some.items())


class IndexStore(Store):
    """Kept indexes, one of each workspace in each environment."""

    variants = 4

    def __init__(self, folder: Path | None = None, max_bytes: int = MAX_BYTES) -> None:
        super().__init__("indexes", SCHEMA, MAX_ENTRY_BYTES, folder, max_bytes)

    def load(self, workspace: Workspace, folder: str) -> WorkspaceIndex:
        """What of the index of `folder` is still right; nothing is ever raised."""
        wanted = _key(workspace)
        for path, entry in self._entries(self._place(folder)):
            if entry.get("key") == wanted:
                self._used(path)
                try:
                    return _read(entry, workspace)
                except _NOT_UNDERSTOOD:
                    break
        return WorkspaceIndex()

    def save(self, workspace: Workspace, folder: str, index: WorkspaceIndex) -> bool:
        """Keep an index. False if it is too large or the disk refused. What has changed by now is left out."""
        key = _key(workspace)
        sources = workspace.sources
        entry = sources.in_one_revision(lambda: _Writer(sources).index(index), lambda _: (), likely=())
        return self._keep(self._place(folder), key, {"key": key, **entry})

    def _place(self, folder: str) -> Place:
        return Place(self._folder_of(digest_of({"workspace": folder})), "index")


def _key(workspace: Workspace) -> str:
    """Of what an index is made from beside what is noted for each entry: our own code, and what there is of ROS."""
    environment = workspace.environment
    packages = {
        name: [[p.share, p.manifest, p.build_type] for p in (first, *environment.shadowed.get(name, ()))]
        for name, first in environment.packages.items()
    }
    places = [
        environment.package_path,
        environment.devel_spaces,
        environment.system_prefixes,
        environment.ament_prefixes,
    ]
    named = {
        "code": _own_code(),
        "generation": environment.generation,
        "distro": environment.distro,
        "packages": packages,
        "places": places,
        "cwd": workspace.cwd,
        "placeholder": workspace.commands.placeholder,
    }
    return digest_of(named)


@functools.cache
def _own_code() -> str:
    """Another version of it makes other indexes."""
    folder = Path(preflight_analysis.__file__).parent
    found = hashlib.blake2b(digest_size=20)
    for name in ("documents", "environment", "evaluation", "launch", "workspace"):
        for path in sorted((folder / name).glob("**/*.py")):
            found.update(path.read_bytes())
    return found.hexdigest()


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
            "files": [self._facts(each, written.get(each.path, ())) for each in files],
            "roots": [kept for each in entries if (kept := self._root(each)) is not None],
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
        mentions = facts.mentions
        return [
            self._paths.number(facts.path),
            [self._observations.number(each) for each in facts.observations],
            [[a.name, a.default, a.value, a.doc, *a.span] for a in facts.args],
            [_KINDS.index(m.kind) for m in mentions],
            [m.name for m in mentions],
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
        ]

    def _inclusion(self, inclusion: Inclusion) -> list[Any]:
        places = (*self._location(inclusion.place), *self._location(inclusion.tag))
        return [self._paths.number(inclusion.target), *places, dict(inclusion.args)]

    def _location(self, location: Location) -> tuple[int, int, int]:
        span = location.span
        none = location == Location.of_file(location.file)
        return self._paths.number(location.file), -1 if none else span.start, -1 if none else span.end


def _read(entry: dict[str, Any], workspace: Workspace) -> WorkspaceIndex:
    """What of a kept index is right now. Raises one of `_NOT_UNDERSTOOD` where it is none."""
    observations = [
        Observation(_text(what), _text(name), _text(answer)) for what, name, answer in entry["observations"]
    ]
    paths = _texts(entry["paths"])
    files = {each.name for each in observations if each.what in ("text", "data")}
    return workspace.sources.in_one_revision(
        lambda: _Reader(workspace, paths, observations).index(entry["files"], entry["roots"]),
        lambda _: files,
        likely=files,
    )


class _Reader:
    """Plain data to an index, within one revision of the files."""

    def __init__(self, workspace: Workspace, paths: Sequence[str], observations: Sequence[Observation]) -> None:
        self._sources = workspace.sources
        self._paths = paths
        self._observations = observations
        world = World(workspace.sources, workspace.environment.variables, workspace.commands)
        self._right = [world.same(each) for each in observations]
        self._lines: dict[int, LineIndex] = {}

    def index(self, files: Sequence[Sequence[Any]], roots: Sequence[Sequence[Any]]) -> WorkspaceIndex:
        """All that is still right."""
        facts: dict[str, FileFacts] = {}
        written: list[Inclusion] = []
        for each in files:
            if all(map(self._right.__getitem__, each[1])):
                found = self._facts(each)
                facts[found.path] = found
                written += (self._inclusion(inclusion, None) for inclusion in each[8])
        entries = [self._root(each) for each in roots if all(map(self._right.__getitem__, each[2]))]
        return WorkspaceIndex(facts, {entry.root: entry for entry in entries}, tuple(written))

    def _facts(self, kept: Sequence[Any]) -> FileFacts:
        path, seen, args, kinds, names, offsets, has_nodes, passing_all, _ = kept
        at = iter(map(Span, *_offsets(offsets)))
        named = zip((_KINDS[kind] for kind in kinds), _texts(names), at, at, strict=True)
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
        path, args, seen, files, inputs, inclusions, nodes = kept
        root = Root.of(self._paths[path], {_text(name): _text(value) for name, value in args})
        return RootEntry(
            root,
            tuple(map(self._paths.__getitem__, files)),
            {name: self._sources.digest(name) for name in map(self._paths.__getitem__, inputs)},
            tuple(self._inclusion(each, root) for each in inclusions),
            tuple(NodeEntry(_text(n), _text(p), _text(e), self._location(*at)) for n, p, e, *at in nodes),
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


def _argument(name: object, default: object, value: object, doc: object, start: int, end: int) -> ArgDeclaration:
    texts = _text_or_none(default), _text_or_none(value), _text_or_none(doc)
    return ArgDeclaration(_text(name), *texts, Span(int(start), int(end)))


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
