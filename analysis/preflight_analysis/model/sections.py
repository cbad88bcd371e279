"""To which nodes each section of a parameter file applies, and why to none (ROS 2).

Who gets a file is read from the launch files; of a process it is for each of the nodes that it makes. A file that a
launch file wrote (`RewrittenYaml`, `ReplaceString`) stands for the one that it was made from.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from itertools import chain
from typing import Literal, NamedTuple

from preflight_analysis.catalogue.launches import catalogued_file
from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Location, Span
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.meanings import known_of_nodes
from preflight_analysis.evaluation.ros2.containers import container_of, containers_of
from preflight_analysis.evaluation.ros2.param_files import ParamFile, Section, read_param_file
from preflight_analysis.evaluation.ros2.spawners import asked_of, is_spawner
from preflight_analysis.evaluation.ros2.unknown_text import is_unknown
from preflight_analysis.evaluation.tree import LaunchNode, ParamSource
from preflight_analysis.findings.doubt import Doubt, doubts
from preflight_analysis.findings.finding import Related
from preflight_analysis.incremental.derived import derived
from preflight_analysis.launch.recognize import is_yaml
from preflight_analysis.model.context import Context
from preflight_analysis.model.declared_params import declared_params
from preflight_analysis.model.names_elsewhere import section_around
from preflight_analysis.model.nearest import nearest
from preflight_analysis.model.section_reader import SectionReader
from preflight_analysis.tracing.interface import Interface

Why = Literal["namespace", "misspelt", "renamed", "only", "wildcard", "elsewhere", "nowhere", "not-given"]
"""Why a section applies to no node. `namespace`: a node that gets the file has its name in another namespace;
`misspelt`: one has nearly its name; `renamed`: it has the name that the node has by itself; `only`: it is the only
section of a node that the file is for; `wildcard`: what it fits
is a component, for which launch_ros knows no wildcard but `/**`; `elsewhere`: the node of its name does not get
the file; `nowhere`: no node has a name like it; `not-given`: no node gets the file."""


class Getter(NamedTuple):
    """A node that gets a parameter file: that of the full name `name`. `node` is the launch file's, in whose process
    it is, `location` where that one gets the file. `beside`: it is one that the process makes beside its own, or a
    controller. `by_include`: a launch file from the catalogue is handed the file, and gives it to the node."""

    name: str
    node: LaunchNode
    location: Location
    beside: bool = False
    by_include: bool = False

    @property
    def related(self) -> Related:
        """Where it gets the file."""
        return Related(f"{self.node.name} gets the file here", self.location)


class Slip(NamedTuple):
    """The key that one is a slip of, whose namespace so many parameter files around have."""

    key: str
    files: int


@dataclass(frozen=True, slots=True)
class SectionUse:
    """A section, and the nodes to which it applies. Where those are none, `why_not` says why, and `candidates` are the
    nodes that it was meant for, or with `elsewhere` and `wildcard` those that it names. `slip` is what its key was
    meant to be where that is no node of this launch. `unserved` is the first of those that it names and that do not get
    all that it sets otherwise. The answer is open as far as there are `doubts`."""

    section: Section
    nodes: tuple[Getter, ...]
    why_not: Why | None = None
    candidates: tuple[Getter, ...] = ()
    slip: Slip | None = None
    unserved: Getter | None = None
    doubts: tuple[Doubt, ...] = ()

    @property
    def is_lost(self) -> bool:
        """Whether no node of the launch is called so."""
        return self.why_not not in (None, "wildcard", "elsewhere", "not-given")

    @property
    def meant(self) -> tuple[Getter, ...]:
        """The nodes for which it is meant and to which it does not apply."""
        return self.candidates if self.is_lost else ()

    @property
    def suggestion(self) -> str:
        """What it is meant for, as a question, with what speaks for that; "" where that is not known."""
        if self.slip is not None:
            key, files = self.slip
            return f"did you mean '{key}'? {files} parameter files nearby have that namespace"
        return f"did you mean {_enumerated(self.candidates)}?" if self.meant else ""

    @property
    def reason(self) -> str:
        """Why it applies to no node, in words; "" where it does."""
        if self.why_not is None:
            return ""
        if self.why_not == "not-given":
            return "no node of this launch gets the file"
        said, several = _enumerated(self.candidates), len(self.candidates) > 1
        if self.why_not == "elsewhere":
            return f"{said} {'do' if several else 'does'} not get the file"
        if self.why_not == "wildcard":
            return f"{said} {'are components' if several else 'is a component'}; '/**' is the only wildcard for these"
        return "no node that gets the file is called so" + (f"; {self.suggestion}" if self.suggestion else "")


def _enumerated(getters: Iterable[Getter]) -> str:
    return ", ".join(f"'{name}'" for name in dict.fromkeys(each.name for each in getters))


@dataclass(frozen=True, slots=True)
class FileUse:
    """A parameter file of a launch: who gets it, and what for. `lacking` are the nodes that no section names although
    their process gets it, each with whether something in it is for all nodes."""

    path: str
    file: ParamFile
    getters: tuple[Getter, ...]
    sections: tuple[SectionUse, ...]
    lacking: tuple[tuple[Getter, bool], ...] = ()

    def nodes_for(self, pattern: str) -> tuple[Getter, ...]:
        """The nodes to which a section applies, or would if it stood in the file."""
        there = [each for each in self.sections if each.section.pattern == pattern]
        if there:
            return tuple(chain.from_iterable(each.nodes for each in there))
        section = Section(pattern, (), ())
        composable = ((each, each.node.kind == "composable" and not each.beside) for each in self.getters)
        return tuple(each for each, alone in composable if section.reaches(each.name, composable=alone))

    def for_name(self, node: LaunchNode, name: str) -> Iterator[SectionUse]:
        """The sections for that name as a node of the launch file gets them, in whose process it is."""
        for path, _, source in _files_of(node):
            if path == self.path:
                reached = SectionReader(path, self.file).reached(source, node, name)
                yield from (self.sections[at] for at in sorted(reached))

    def meant_for(self, getter: Getter) -> SectionUse | None:
        """The section that is meant for a node, and does not apply to it."""
        return next((each for each in self.sections if any(getter is one for one in each.meant)), None)


@derived
def given_files(context: Context) -> Mapping[str, Sequence[tuple[LaunchNode, ParamSource]]]:
    """The parameter files that nodes of a launch get, by the path of what people edit."""
    given: dict[str, list[tuple[LaunchNode, ParamSource]]] = {}
    for path, node, source in chain.from_iterable(context.each(_files_of, context.tree.nodes_and_simulated)):
        given.setdefault(path, []).append((node, source))
    return given


def param_files(context: Context) -> tuple[FileUse, ...]:
    """What is so of each parameter file that a node of the launch gets."""
    handed = (value for each in context.tree.includes for value in each.args.values() if value and is_yaml(value))
    found = (param_file(context, path) for path in dict.fromkeys((*given_files(context), *handed)))
    return tuple(each for each in found if each is not None and each.getters)


@derived
def first_getters(context: Context) -> Mapping[str, Getter]:
    """The parameter files that nodes of the launch get, as people edit them, each with the first of the nodes."""
    return {used.path: used.getters[0] for used in param_files(context)}


def files_of(context: Context, node: LaunchNode) -> Iterator[FileUse]:
    """What is so of the parameter files that a node gets, of each once."""
    paths = dict.fromkeys(path for path, _, _ in _files_of(node))
    yield from filter(None, (param_file(context, path) for path in paths))


def section_at(context: Context, place: Location) -> SectionUse | None:
    """The section in which the name of a parameter stands; None where that is in no parameter file."""
    return _by_place(context, place.file).get(place.span) if is_yaml(place.file) else None


@derived
def _by_place(context: Context, path: str) -> Mapping[Span, SectionUse]:
    used = param_file(context, path)
    return {param.name_span: each for each in used.sections for param in each.section.params} if used else {}


def may_be_called(context: Context, name: str) -> list[LaunchNode]:
    """The nodes whose name, or that of another one of their process, their own code may make of this: the launch file
    gives them none, and a parameter file with a section for it."""
    return [
        node
        for node in context.tree.nodes
        if not (node.named or node.name_from_code or is_spawner(node))
        and any(each.section.exact for used in files_of(context, node) for each in used.for_name(node, name))
    ]


def _files_of(node: LaunchNode) -> tuple[tuple[str, LaunchNode, ParamSource], ...]:
    return tuple((each.made_from or each.path, node, each) for each in node.param_sources if each.path is not None)


class _Names(NamedTuple):
    """The names of a launch. `beside` are the other nodes that the processes of nodes were seen to make, or are known
    to, `usual` what a node is known to be called otherwise, `controllers` those that spawners ask managers for,
    `all` are all of both and of the launch file."""

    beside: Mapping[str, Sequence[str]]
    usual: Mapping[str, Collection[str]]
    controllers: Mapping[str, Sequence[str]]
    all: frozenset[str]


@derived
def _names(context: Context) -> _Names:
    beside, usual = _beside(context)
    controllers: dict[str, list[str]] = {}
    for node in context.tree.nodes:
        asked = asked_of(node) if is_spawner(node) else None
        if asked is not None:
            space = names.parent(asked.manager)
            controllers.setdefault(asked.manager, []).extend(names.join(space, each) for each in asked.controllers)
    own = (node.name for node in context.tree.nodes_and_simulated)
    return _Names(beside, usual, controllers, frozenset((*own, *chain(*beside.values(), *controllers.values()))))


def _beside(context: Context) -> tuple[dict[str, list[str]], dict[str, tuple[str, ...]]]:
    """What a component makes gets the files of its container; and what nodes are called by their code or program."""
    found: dict[str, list[str]] = {}
    usual: dict[str, tuple[str, ...]] = {}
    containers: Mapping[str, LaunchNode] | None = None
    tree = context.graph.tree if context.graph is not None else context.tree
    known = known_of_nodes(tree, context.known, context.kept)
    for node, said in zip(tree.nodes_and_simulated, known, strict=True):
        if said is not None:
            usual[node.name] = (said.entry.node, *said.entry.names.get("executables", ()))
        if said is not None and said.entry.within and node.kind != "composable":
            made = (names.join(names.parent(node.name), below) for below in said.entry.within)
            found.setdefault(node.name, []).extend(made)
    for node in tree.nodes:
        if node.within is not None and node.kind == "composable":
            containers = containers_of(context.tree.nodes) if containers is None else containers
            host = container_of(node, containers)
            if host is not None:
                found.setdefault(host.name, []).append(node.name)
        elif node.within is not None:
            found.setdefault(node.within, []).append(node.name)
    return found, usual


@derived
def param_file(context: Context, path: str) -> FileUse | None:
    """What is so of a parameter file, whether a node gets it or not; None where it is not there."""
    document = context.document(path)
    if document is None:
        return None
    file = read_param_file(document)
    given = given_files(context).get(path, ())
    there = _names(context)
    reader = SectionReader(path, file)
    getters = _getters(context, path, given, reader, there)
    reaching: dict[int, list[Getter]] = defaultdict(list)
    named: set[str] = set()
    for getter, sections in getters:
        for at in sections:
            reaching[at].append(getter)
        if not all(is_for_all(file.sections[at]) for at in sections):
            named.add(getter.name)
    patterns = [reader.patterns(at) for at in range(len(file.sections))]
    unclear = {at for at, each in enumerate(patterns) if not each or any("$(" in p or is_unknown(p) for p in each)}
    lacking = [
        (getter, bool(at))
        for getter, at in getters
        if not unclear and getter.name not in named and (_has_a_name(getter, there) or _is_outside(getter, patterns))
    ]
    lost = [
        at
        for at, each in enumerate(patterns)
        if at not in reaching and at not in unclear and not _are_called(each, there)
    ]
    # Of a process the file is for whichever of its nodes it names.
    apart = {getter.node.name for getter, _ in getters if not named.isdisjoint(there.beside.get(getter.node.name, ()))}
    by_launch = {id(node) for node, _ in given}
    by_pattern = {pattern: at for at in reversed(lost) for pattern in patterns[at]}
    shared = sum(not getter.beside for getter, _ in getters) > 1
    search = _Search(context, file.sections, by_pattern, apart, shared, there.usual)
    meant = search.meant(getter for getter, _ in lacking) if lost else {}
    nodes = [getter.node for getter, _ in getters if not getter.beside]
    of_file = _doubts(context, path, nodes)
    uses = []
    for at, section in enumerate(file.sections):
        why: Why | None = None
        candidates: Iterable[Getter] = ()
        slip: Slip | None = None
        if at in reaching:
            pass
        elif not getters:
            why = "not-given"
        elif at in lost or at in unclear:
            why, candidates = meant.get(at, ("nowhere", ()))
            slip = _slip(context, section) if why == "nowhere" and at in lost else None
        else:
            fitting = [getter for getter, _ in getters if section.fits(getter.name)]
            why, candidates = ("wildcard", fitting) if fitting else ("elsewhere", _called(context, patterns[at]))
        said = doubts(
            NOT_ANALYSED=_may_take(nodes, patterns[at], unclear=at in unclear),
            COMPUTED=at in unclear,
            ASSUMED=any(
                each.node.name_inferred and any(_may_reach(one, each.node.namespace) for one in patterns[at])
                for each in candidates
            ),
            CATALOGUE=any(id(each.node) not in by_launch for each in candidates) and why != "elsewhere",
            UNSEEN=slip is not None,
        )
        unserved = _unserved(path, section, candidates) if why == "elsewhere" else None
        if unserved is not None:
            paths = (each.path for each in unserved.node.param_sources if not each.sections)
            unread = any(each is not None and context.document(each) is None for each in paths)
            partly = unread or bool(unserved.node.unknowns)
            said += doubts(INTENDED=_is_configured(unserved.node), PARTLY_READ=partly)
        against = (*of_file, *said) if why else ()
        uses.append(SectionUse(section, tuple(reaching[at]), why, tuple(candidates), slip, unserved, against))
    of_files = tuple(
        each
        for each in lacking
        if id(each[0].node) in by_launch and each[0].node.name not in apart and not each[0].beside
    )
    return FileUse(path, file, tuple(getter for getter, _ in getters), tuple(uses), of_files)


def _getters(
    context: Context, path: str, given: Sequence[tuple[LaunchNode, ParamSource]], reader: SectionReader, there: _Names
) -> list[tuple[Getter, set[int]]]:
    """Who gets the file, each with the numbers of the sections that apply to it."""
    found: dict[tuple[str, int], tuple[Getter, set[int]]] = {}
    for node, source in given:
        place = source.origin[-1]
        own = found.setdefault((node.name, id(node)), (Getter(node.name, node, place), set()))
        own[1].update(reader.reached(source, node))
        for name in dict.fromkeys((*there.beside.get(node.name, ()), *there.controllers.get(node.name, ()))):
            other = found.setdefault((name, id(node)), (Getter(name, node, place, True), set()))
            other[1].update(reader.reached(source, node, name))
    for node, place in _handed_on(context, path):
        for name in (node.name, *there.beside.get(node.name, ())):
            other = found.setdefault((name, id(node)), (Getter(name, node, place, name != node.name, True), set()))
            other[1].update(reader.in_namespace(name, node.namespace))
    for node, name in _controllers_given(context, path):
        other = found.setdefault((name, id(node)), (Getter(name, node, node.location, True), set()))
        other[1].update(reader.as_it_stands(name))
    return list(found.values())


_WRITERS = frozenset({"RewrittenYaml", "ReplaceString"})


def _handed_on(context: Context, path: str) -> Iterator[tuple[LaunchNode, Location]]:
    """The nodes of launch files from the catalogue that are handed the file and give their nodes what they make of it,
    each with the include."""
    tree = context.tree
    handed = [include for include in tree.includes if include.path is not None and path in include.args.values()]
    if not handed:
        return
    made = {(each.location.file, each.location.span.start) for each in tree.unknowns if each.what in _WRITERS}
    for node in tree.nodes:
        tag, file = node.action.span, node.location.file
        if not any(at == file and tag.start <= start < tag.end for at, start in made):
            continue
        below = next((each for each in handed if node.origin[: len(each.origin)] == each.origin), None)
        if below is not None:
            yield node, below.origin[-1]


def _controllers_given(context: Context, path: str) -> Iterator[tuple[LaunchNode, str]]:
    """The controllers whose spawner hands them the file, each with the spawner."""
    for node in context.tree.nodes:
        asked = asked_of(node) if is_spawner(node) else None
        if asked is not None and path in asked.files:
            for each in asked.controllers:
                yield node, names.join(asked.namespace, each)


def _are_called(patterns: Iterable[str], there: _Names) -> bool:
    """Whether some node of the launch is called so."""
    return any(p in there.all if "*" not in p else any(map(Section(p, (), ()).fits, there.all)) for p in patterns)


def _called(context: Context, patterns: Iterable[str]) -> list[Getter]:
    sections = [Section(pattern, (), ()) for pattern in patterns]
    nodes = context.tree.nodes_and_simulated
    return [Getter(n.name, n, n.location) for n in nodes if any(each.fits(n.name) for each in sections)]


def _unserved(path: str, section: Section, called: Iterable[Getter]) -> Getter | None:
    """The first of the nodes of a section's name that gets neither the file nor all that the section sets. What a
    launch file of the catalogue gives its nodes may be made of any file."""
    wanted = {param.name for param in section.params}
    return next(
        (
            each
            for each in called
            if path not in each.node.args
            and catalogued_file(each.location.file) is None
            and not wanted <= {param.name for param in each.node.params}
        ),
        None,
    )


def _is_configured(node: LaunchNode) -> bool:
    """Whether its launch file gives it values, or a file with some for it, and not only as one of a scope."""
    return any((each.path is None or each.params) and not each.pushed for each in node.param_sources)


def is_for_all(section: Section) -> bool:
    """Whether it is for any node, or for any of a namespace."""
    return names.leaf(section.pattern) in ("*", "**")


def _has_a_name(getter: Getter, there: _Names) -> bool:
    """Whether a section should have its name: a node that the launch file does not name may have any name in the file,
    and what a simulator makes or a spawner asks for is for others to judge."""
    node = getter.node
    if getter.beside:
        return getter.name in there.beside.get(node.name, ())
    return node.kind != "simulated" and (node.named or node.name_from_code)


def _is_outside(getter: Getter, patterns: Iterable[Iterable[str]]) -> bool:
    """Whether a node that the launch file does not name, but puts into a namespace, gets nothing of a file whatever its
    own code calls it."""
    node = getter.node
    hidden = not getter.beside and node.kind == "node" and node.namespace != "/" and not is_spawner(node)
    return hidden and not any(_may_reach(each, node.namespace) for each in chain.from_iterable(patterns))


def _may_reach(pattern: str, namespace: str) -> bool:
    """Whether a section is for some name in a namespace, or below it, but not for all."""
    is_for_all_in = names.leaf(pattern) in ("*", "**")
    return not is_for_all_in and ("*" in pattern or pattern.startswith(f"{namespace.rstrip('/')}/"))


@dataclass(frozen=True, slots=True)
class _Search:
    """Which sections that fit no node are meant for one that the file names nowhere. `lost` has their numbers by what
    they are for, `apart` the nodes of whose processes the file names others, `shared`: several nodes get the file,
    `usual` is what nodes are called by their code or program."""

    context: Context
    sections: Sequence[Section]
    lost: Mapping[str, int]
    apart: Collection[str]
    shared: bool
    usual: Mapping[str, Collection[str]]

    def meant(self, lacking: Iterable[Getter]) -> dict[int, tuple[Why, tuple[Getter, ...]]]:
        """By number: why it does not apply, and the nodes that it is meant for."""
        found: dict[int, tuple[Why, tuple[Getter, ...]]] = {}
        patterns = [pattern for pattern, at in self.lost.items() if not is_for_all(self.sections[at])]
        for getter in lacking:
            said = self._for(getter, patterns)
            if said is not None:
                at = self.lost[said[1]]
                why, others = found.get(at, (said[0], ()))
                found[at] = why, (*others, getter)
        return found

    def _for(self, getter: Getter, patterns: Sequence[str]) -> tuple[Why, str] | None:
        """That of the node's name in another namespace, else one with nearly its name, else the one that is called as
        its own code or its executable, else the only one of a file of its own."""
        name, base = getter.name, names.leaf(getter.name)
        same = [pattern for pattern in patterns if names.leaf(pattern) == base]
        if same:
            return "namespace", nearest(name, same) or same[0]
        if not (getter.node.named or getter.node.name_from_code):
            return None
        near = nearest(name, patterns)
        if near is not None and self._may_want(name, self.sections[self.lost[near]]):
            return "misspelt", near
        if getter.beside:
            return None
        own = {*self.usual.get(name, ()), getter.node.executable}
        called = [pattern for pattern in patterns if names.leaf(pattern) in own]
        if len(called) == 1:
            return "renamed", called[0]
        alone = getter.node.name not in self.apart
        return ("only", patterns[0]) if alone and len(patterns) == 1 and not self.shared else None

    def _may_want(self, name: str, section: Section) -> bool:
        """Whether the node declares one of the parameters of a section, as far as that is known: another one may have a
        name like its own, as `map_server` and `map_saver`."""
        known = _interfaces(self.context).get(name)
        declared = declared_params(*known) if known is not None and section.params else None
        return declared is None or any(param.name in declared for param in section.params)


def _slip(context: Context, section: Section) -> Slip | None:
    """That of a node that the launch has in another namespace: the one of the key is in no other parameter file, and a
    slip of one that several have."""
    _, space, *rest = section.pattern.split("/")
    below = f"/{'/'.join(rest)}"
    if not section.exact or not rest or not any(node.name.endswith(below) for node in context.tree.nodes):
        return None
    found = section_around(context, space)
    return Slip(f"/{found[0]}{below}", found[1]) if found is not None else None


@derived
def _interfaces(context: Context) -> Mapping[str, tuple[LaunchNode, Interface]]:
    graph = context.graph
    pairs = zip(graph.tree.nodes, graph.interfaces, strict=True) if graph is not None else ()
    return {node.name: (node, interface) for node, interface in pairs}


def _doubts(context: Context, path: str, nodes: Sequence[LaunchNode]) -> tuple[Doubt, ...]:
    """What speaks against it that a section applies to no node, whichever it is: who else may get the file, and names
    that are not known."""
    tree = context.tree
    unknown = (each for each in tree.includes if each.path is None or each.path not in tree.files)
    return doubts(
        PARTLY_READ=any(path in each.args.values() for each in unknown),
        COMPUTED=any(is_unknown(node.name) for node in nodes),
    )


def _may_take(nodes: Sequence[LaunchNode], patterns: Collection[str], *, unclear: bool) -> str:
    """A node whose own code may give it the name that a section is for; "" without one."""
    for node in nodes:
        unnamed = not (node.named or node.name_from_code) and not is_spawner(node)
        if unnamed and (unclear or any(_may_reach(each, node.namespace) for each in patterns)):
            return node.name
    return ""
