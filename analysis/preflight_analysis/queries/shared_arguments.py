"""Where an argument of a launch file is declared, used and given, over all files that share it.

An argument belongs to its file, and is another one than an argument of the same name in a file that includes it: an
include gives a value under the name that the included file has for it. It is the same one in both where the value goes
on without being named: by `pass_all_args` in ROS 1, and in ROS 2 wherever one file reads what another one has set, as
launch configurations are not scoped by includes.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import cached_property

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.document import SpannedText
from preflight_analysis.documents.span import Location, Span
from preflight_analysis.evaluation.tree import LaunchTree, Use
from preflight_analysis.launch.model import Value
from preflight_analysis.launch.references import arg_references
from preflight_analysis.launch.substitutions import parse_value
from preflight_analysis.launch.substitutions_ros2 import parse_value_ros2
from preflight_analysis.queries.query_context import QueryContext
from preflight_analysis.workspace.facts import may_be_true
from preflight_analysis.workspace.index import Inclusion


class SharedArgument:
    """The files in which a name is the same argument as in `files`. `trees` tell what is read where; with `by_tag` the
    files count, too, that one and the same `<include>` leads to as its `file` changes: it can give the argument under
    one name only."""

    def __init__(
        self,
        context: QueryContext,
        trees: Iterable[LaunchTree],
        files: Iterable[str],
        name: str,
        *,
        by_tag: bool = False,
    ) -> None:
        self._context, self._index, self.name = context, context.current, name
        self.trees = tuple(trees)
        self._substituted = substituted_files(context, self.trees, name)
        self._given: dict[Location, tuple[str, ...]] = {}
        self.shared_with: dict[str, str] = {}
        """Of each file that was not asked for, the one that it shares the argument with."""
        self.files: dict[str, None] = {}
        left = [*files]
        while left:
            path = left.pop()
            if path not in self.files:
                self.files[path] = None
                for other in self._neighbours(path, by_tag=by_tag):
                    if other not in self.files:
                        self.shared_with.setdefault(other, path)
                        left.append(other)

    def _neighbours(self, path: str, *, by_tag: bool) -> Iterator[str]:
        for inclusion in self._index.included_from(path):
            if self.hands_on(inclusion) and self.is_wanted(inclusion.target) and self._is_known(path):
                yield inclusion.target
        for inclusion in self._index.includers(path):
            if self.hands_on(inclusion) and self.is_wanted(path) and self._is_known(inclusion.includer):
                yield inclusion.includer
            if by_tag and self.gives(inclusion):
                yield from (i.target for i in self._index.included_from(inclusion.includer) if i.tag == inclusion.tag)
        yield from self._flows.get(path, ())
        yield from (f for found in self._substituted.values() if path in found.launch_files for f in found.launch_files)

    @property
    def read(self) -> Iterable[str]:
        """The parameter files that use the argument."""
        return (p for p, found in self._substituted.items() if not self.files.keys().isdisjoint(found.launch_files))

    def hands_on(self, inclusion: Inclusion) -> bool:
        """Whether an include passes on whatever value there is under that name."""
        facts = self._index.files.get(inclusion.includer)
        return facts is not None and inclusion.tag.span in facts.passing_all and not self.gives(inclusion)

    def gives(self, inclusion: Inclusion) -> bool:
        """Whether an include names the argument."""
        facts = self._index.files.get(inclusion.includer)
        return facts is not None and any(
            m.action == inclusion.tag.span for m in facts.named("argument", self.name, "passes")
        )

    def is_mentioned(self, path: str) -> bool:
        """Whether a file declares the argument, sets or uses it."""
        facts = self._index.files.get(path)
        if facts is None:
            return False
        written = any(next(facts.named("argument", self.name, role), None) for role in ("declares", "uses"))
        return written or any(path in found.launch_files for found in self._substituted.values())

    def is_wanted(self, path: str) -> bool:
        """Whether a file, or one that it hands everything on to, has to do with the argument."""
        return self._leads_to(path, set())

    def _leads_to(self, path: str, seen: set[str]) -> bool:
        if path in seen:
            return False
        seen.add(path)
        below = self._index.included_from(path)
        return self.is_mentioned(path) or any(self.hands_on(i) and self._leads_to(i.target, seen) for i in below)

    def _is_known(self, path: str) -> bool:
        return self._comes_to(path, set())

    def _comes_to(self, path: str, seen: set[str]) -> bool:
        """Whether a file knows an argument of that name: its own, or one that it gets from its includers."""
        if path in seen:
            return False
        seen.add(path)
        return self.is_mentioned(path) or any(
            self.gives(i) or (self.hands_on(i) and self._comes_to(i.includer, seen))
            for i in self._index.includers(path)
        )

    @cached_property
    def _flows(self) -> Mapping[str, Iterable[str]]:
        """ROS 2: for each file the others that read there what it has set, or whose setting it reads."""
        found: dict[str, dict[str, None]] = {}
        for tree in self.trees:
            if not tree.ros.shared_configurations:
                continue
            reads = [u for u in tree.uses if u.name == self.name and u.kind in ("arg", "declaration") and u.origin]
            for use in reads:
                for owner in self._owners(use, reads, set()):
                    if owner != use.location.file:
                        found.setdefault(use.location.file, {})[owner] = None
                        found.setdefault(owner, {})[use.location.file] = None
        return found

    def _owners(self, read: Use, reads: list[Use], seen: set[Location]) -> Iterable[str]:
        """The files whose argument it is that is read. What an include gives is that of the included file, for this
        one and those below; for all others an include that gives a value under its own name changes nothing."""
        at = read.origin[-1]
        targets = self._given_to(at)
        if not targets or at in seen:
            return () if targets else (at.file,)
        if any(self._is_within(read.location.file, target) for target in targets):
            return targets
        before = [u for u in reads if u.location == at and u.origin]
        return [o for u in before for o in self._owners(u, reads, {*seen, at})] if before else targets

    def _given_to(self, value: Location) -> tuple[str, ...]:
        """The files that an include gives a value to which is written at a place; none where it stands elsewhere."""
        if value not in self._given:
            launch_file = self._context.launch_file(value.file)
            root = launch_file.root if launch_file is not None else None
            includes = (a for a in root.walk() if a.kind == "include") if root is not None else ()
            around = next((a for a in includes if a.span.contains(value.span.start)), None)
            tag = self._context.location(value.file, around.head_span) if around is not None else None
            self._given[value] = self._context.targets(tag) if tag is not None else ()
        return self._given[value]

    def _is_within(self, path: str, file: str) -> bool:
        """Whether a file is the other one, or is included by it or by one below."""
        seen, left = set[str](), [file]
        while left:
            at = left.pop()
            if at == path:
                return True
            if at not in seen:
                seen.add(at)
                left += (inclusion.target for inclusion in self._index.included_from(at))
        return False


def shared_argument(context: QueryContext, files: Iterable[str], name: str, *, by_tag: bool) -> SharedArgument:
    """As it is in all roots that reach one of the files that share it."""
    found = SharedArgument(context, context.all_trees, files, name, by_tag=by_tag)
    while True:
        trees = context.trees_around((*found.files, *found.read))
        wider = SharedArgument(context, trees, files, name, by_tag=by_tag)
        if len(wider.trees) == len(found.trees):
            return wider
        found = wider


def declared_at(context: QueryContext, files: Iterable[str], name: str) -> Iterator[Location]:
    """The names of its `<arg>` tags."""
    for path in files:
        if (facts := context.facts(path)) is not None:
            yield from (context.location(path, m.span) for m in facts.named("argument", name, "declares"))


def used_at(
    context: QueryContext, files: Iterable[str], name: str, trees: Iterable[LaunchTree] = ()
) -> Iterator[Location]:
    """Each use in `$(arg)`, `$(var)` and `$(eval)`, in the parameter files whose substitutions are made in the launches
    `trees`, too."""
    files = tuple(files)
    for path in files:
        if (facts := context.facts(path)) is not None:
            yield from (context.location(path, m.span) for m in facts.named("argument", name, "uses"))
    for found in substituted_files(context, trees, name).values():
        yield from (place for path in files for place in found.places if path in found.launch_files)


def given_at(context: QueryContext, files: Iterable[str], name: str) -> Iterator[Location]:
    """The `<arg>` tags that give it, in the files that include these."""
    seen: set[Location] = set()
    for path in files:
        for inclusion in context.current.includers(path):
            facts = context.facts(inclusion.includer)
            if facts is not None and inclusion.tag not in seen:
                seen.add(inclusion.tag)
                given = (m for m in facts.named("argument", name, "passes") if m.action == inclusion.tag.span)
                yield from (context.location(inclusion.includer, m.span) for m in given)


@dataclass(frozen=True, slots=True)
class SubstitutedFile:
    """Where a parameter file uses an argument, and the launch files whose argument that is."""

    launch_files: dict[str, None]
    places: tuple[Location, ...]


def substituted_files(context: QueryContext, trees: Iterable[LaunchTree], name: str) -> Mapping[str, SubstitutedFile]:
    """The parameter files that use an argument, by their paths."""
    found: dict[str, SubstitutedFile] = {}
    loads: dict[str, frozenset[int]] = {}
    for tree in trees:
        shared = tree.ros.shared_configurations
        # Uses in such a file are noted where the launch file names it.
        flat = {u.location for u in tree.uses if shared and u.kind == "arg" and u.name == name and _is_empty(u)}
        starts = {(at.file, at.span.start) for at in flat}
        for use in tree.uses:
            if use.kind != "file" or use.target is None:
                continue
            file, start = use.location.file, use.location.span.start
            if not shared and file not in loads:
                loads[file] = frozenset(_substituting(context, file))
            if (file, start) not in starts if shared else start not in loads[file]:
                continue
            path = use.target.file
            if path not in found:
                spans = _uses_in(context, path, parse_value_ros2 if shared else parse_value)
                places = tuple(context.location(path, span) for used, span in spans if used == name)
                found[path] = SubstitutedFile({}, places)
            found[path].launch_files[file] = None
    return {path: each for path, each in found.items() if each.places}


def _is_empty(use: Use) -> bool:
    return use.location.span.start == use.location.span.end


def _substituting(context: QueryContext, path: str) -> Iterator[int]:
    """Where a launch file of ROS 1 names files for `<rosparam subst_value="true">`."""
    launch_file = context.launch_file(path)
    for action in launch_file.root.walk() if launch_file and launch_file.root else ():
        file, substituted = action.value("file"), action.value("subst_value")
        if action.kind == "rosparam" and file is not None and substituted is not None and may_be_true(substituted):
            yield file.span.start


def _uses_in(context: QueryContext, path: str, parse: Callable[[SpannedText], Value]) -> Iterator[tuple[str, Span]]:
    document = context.document(path)
    if document is not None:
        value = parse(SpannedText(document.text, Span(0, len(document.text))))
        if value.problem is None:
            yield from arg_references(value)
