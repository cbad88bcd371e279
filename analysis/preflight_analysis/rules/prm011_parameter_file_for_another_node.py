"""PRM011: a parameter file that is given to a node and has nothing for it (ROS 2)."""

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import chain

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.document import Document
from preflight_analysis.documents.span import Location
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.meanings import known_of_nodes
from preflight_analysis.evaluation.ros2.containers import container_of, containers_of
from preflight_analysis.evaluation.ros2.param_files import ParamFile, Section, read_param_file
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.findings.claim import Subject, say
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding, Fix, Related
from preflight_analysis.model.context import Context
from preflight_analysis.model.nearest import likeness, nearest
from preflight_analysis.model.problems import enumerated, include_chain, quoted, replacement
from preflight_analysis.model.written_elsewhere import around
from preflight_analysis.rules.further_reading import COMMAND_LINE, NODE_ARGUMENTS, PARAMETERS
from preflight_analysis.rules.rule import Rule

_SHOWN = 3
_OF_OTHERS = "section '{section}' applies to no node that gets this file (only {node}{others})"
_NOT_OF_NODE = "no section of this file applies to {node}; it has sections for {sections}{inferred}"
_KEYS = (re.compile(r"^([A-Za-z]\w*):[ \t]*$", re.MULTILINE),)
_ENOUGH = 2
"""Parameter files that have to agree on a namespace."""


@dataclass(frozen=True, slots=True)
class _Given:
    """A node that a parameter file is given to, and where. `reached`: something in the file is for all nodes."""

    node: LaunchNode
    location: Location
    reached: bool


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    given: dict[str, list[tuple[LaunchNode, Location]]] = {}
    for path, node, location in chain.from_iterable(context.kept.each(_files_of, context.tree.nodes)):
        given.setdefault(path, []).append((node, location))
    if not given:
        return
    beside = _beside(context)
    known = {node.name for node in context.tree.nodes}.union(*beside.values())
    for path, nodes in given.items():
        document = context.documents.get(path)
        if not isinstance(document, Document):
            continue
        file = read_param_file(document)
        sections = file.sections
        if not sections or any("$(" in section.pattern for section in sections):
            continue  # launch may make any name of a substitution
        # Those that fit no node at all are the ones that may be misspelt.
        lost = [s for s in sections if not (s.pattern in known if s.exact else any(map(s.fits, known)))]
        # Of a process the file is for whichever of its nodes it names.
        alone = [each for each in nodes if not any(_named(file, name) for name in beside.get(each[0].name, ()))]
        lacking = list(_without_own(file, alone))
        meant = {each.node.name: _meant(each.node, lost, shared=len(nodes) > 1) for each in lacking}
        for section in lost:
            ignoring = {each.node.name: each for each in lacking if meant[each.node.name] is section}
            if ignoring:
                yield _about_key(rule, context, path, section, list(ignoring.values()))
            elif (meant_key := _of_other_namespace(context, section, known)) is not None:
                yield _about_namespace(rule, context, path, section, meant_key)
        for each in lacking:
            # One file for several nodes, with nothing for this one: that is usual.
            if not each.reached and (len(nodes) == 1 or meant[each.node.name] is not None):
                yield _about_file(rule, context, path, sections, each, meant[each.node.name])


def _files_of(node: LaunchNode) -> tuple[tuple[str, LaunchNode, Location], ...]:
    """The parameter files that a node is given, and where."""
    return tuple((each.path, node, each.origin[-1]) for each in node.param_sources if each.path is not None)


def _beside(context: Context) -> dict[str, list[str]]:
    """The other nodes that the processes of nodes were seen to make, or are known to. What a component makes gets the
    files of its container."""
    found: dict[str, list[str]] = {}
    containers: Mapping[str, LaunchNode] | None = None
    tree = context.graph.tree if context.graph is not None else context.tree
    known = known_of_nodes(tree, context.known, context.kept)
    for node, said in zip(tree.nodes_and_simulated, known, strict=True):
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
    return found


def _named(file: ParamFile, node: str) -> bool:
    """Whether a key of the file is for the node, and not for all."""
    return not all(_is_for_all(section) for section in file.reaching(node))


def _without_own(file: ParamFile, nodes: Iterable[tuple[LaunchNode, Location]]) -> Iterator[_Given]:
    """The nodes that the file names nowhere. One that the launch file does not name may have any name in the file."""
    for node, location in nodes:
        reaching = file.reaching(node.name, composable=node.container is not None)
        if (node.named or node.name_from_code) and all(_is_for_all(section) for section in reaching):
            yield _Given(node, location, bool(reaching))


def _is_for_all(section: Section) -> bool:
    return names.leaf(section.pattern) in ("*", "**")


def _meant(node: LaunchNode, lost: Sequence[Section], *, shared: bool) -> Section | None:
    """Which of the keys that fit no node is meant for this one: that of its name in another namespace, else one with
    nearly its name, else the only one of a file of its own, or the only one and called as its executable."""
    name, base = node.name, names.leaf(node.name)
    patterns = [section.pattern for section in lost if not _is_for_all(section)]
    same = [pattern for pattern in patterns if names.leaf(pattern) == base]
    own = not shared or (names.leaf(patterns[0]) == node.executable if patterns else False)
    only = patterns[0] if len(patterns) == 1 and own else None
    wanted = nearest(name, same) or next(iter(same), None) or nearest(name, patterns) or only
    return next((section for section in lost if section.pattern == wanted), None)


def _of_other_namespace(context: Context, section: Section, known: Iterable[str]) -> tuple[str, int] | None:
    """The key that was meant, and how many files say so, of a node that the launch has in another namespace: the one of
    the key is in no other parameter file, and a slip of one that several have."""
    _, space, *rest = section.pattern.split("/") if section.pattern.startswith("/") else ("", "")
    below = "/".join(rest)
    if not section.exact or not below or not any(name.endswith(f"/{below}") for name in known):
        return None
    keys = around(context, _KEYS, (".yaml", ".yml"))
    if keys.get(space, 0) > 1:
        return None
    found = [(each, count) for each, count in keys.items() if count >= _ENOUGH and _is_slip_of(space, each)]
    return (f"/{found[0][0]}/{below}", found[0][1]) if len(found) == 1 else None


def _is_slip_of(name: str, other: str) -> bool:
    return likeness(f"/{name}", f"/{other}") == ("typo", 1)


def _about_namespace(rule: Rule, context: Context, path: str, section: Section, meant: tuple[str, int]) -> Finding:
    return rule.claim(
        f"section '{section.pattern}' applies to no node; did you mean '{meant[0]}'? {meant[1]} parameter files nearby "
        "have that namespace",
        context.location(path, section.spans[-1]),
        subject=Subject("section", section.pattern),
        kind="near",
        doubts=doubts(UNSEEN=True),
        candidates=meant[:1],
        every_root=True,
    )


def _about_key(rule: Rule, context: Context, path: str, section: Section, ignoring: list[_Given]) -> Finding:
    nodes = [each.node.name for each in ignoring]
    shown = nodes[:_SHOWN] if len(nodes) <= _SHOWN else [*nodes[:_SHOWN], "others"]
    others = enumerated(shown).removeprefix(nodes[0])
    inferred = any(each.node.name_inferred for each in ignoring)
    return rule.claim(
        say(_OF_OTHERS, section=section.pattern, node=nodes[0], others=others),
        context.location(path, section.spans[-1]),
        subject=Subject("section", section.pattern),
        doubts=doubts(ASSUMED=inferred),
        candidates=nodes[:1],
        related=[Related(f"{each.node.name} gets the file here", each.location) for each in ignoring[:_SHOWN]],
        fixes=_rewrite(context, path, section, nodes[0] if len(nodes) == 1 else _for_each(nodes)),
        every_root=True,
    )


def _about_file(
    rule: Rule, context: Context, path: str, sections: Sequence[Section], given: _Given, meant: Section | None
) -> Finding:
    node = given.node
    named = quoted(s.pattern for s in sections[:_SHOWN]) + (" and others" if len(sections) > _SHOWN else "")
    inferred = "; the name is from its source" if node.name_inferred else ""
    key = meant or sections[0]
    return rule.claim(
        say(_NOT_OF_NODE, node=node.name, sections=named, inferred=inferred),
        given.location,
        subject=Subject("file", path),
        kind="absent" if meant is None else "near",
        doubts=doubts(ASSUMED=bool(inferred)),
        candidates=(meant.pattern if meant is not None else None,),
        related=(
            Related("the section" if meant is not None else "its first section", context.location(path, key.spans[-1])),
            *include_chain(node.origin),
        ),
        fixes=_rewrite(context, path, meant, node.name) if meant is not None else (),
    )


def _for_each(nodes: Sequence[str]) -> str | None:
    """A key for all nodes of one name, in whatever namespace."""
    bases = {names.leaf(node) for node in nodes}
    return f"/**/{bases.pop()}" if len(bases) == 1 else None


def _rewrite(context: Context, path: str, section: Section, name: str | None) -> tuple[Fix, ...]:
    """The key as the node's name, where the key is in one piece; a name in the root needs no slash."""
    if name is None or len(section.spans) != 1:
        return ()
    key = name.removeprefix("/") if name.count("/") == 1 else name
    return replacement(context, context.location(path, section.spans[0]), key, f"Replace the key with '{key}'")


RULE = Rule(
    id="PRM011",
    name="parameter-file-for-another-node",
    effect="no-effect",
    kind="unreachable",
    sometimes=(Reason.ASSUMED, Reason.UNSEEN),
    what="Checks for a parameter file in which no section applies to the node that gets it, and for a key that "
    "matches no node and is close to one. A file that several nodes share may have no section for one of them.",
    why="The node starts with its defaults. Neither `ros2 launch` nor the node reports it.",
    example="<!-- params.yaml: 'amcl: {ros__parameters: {max_particles: 800}}' -->\n"
    '<node pkg="localizer" exec="localizer" name="localizer">\n  <param from="params.yaml"/>\n</node>',
    instead="localizer:\n  ros__parameters:\n    max_particles: 800",
    references=(
        PARAMETERS,
        NODE_ARGUMENTS,
        COMMAND_LINE,
    ),
    generations=(2,),
    check=_check,
)
