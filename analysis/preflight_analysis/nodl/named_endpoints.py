"""Topics, services and actions that parameters name, by what is known of a package: `odom0: /odom` is a subscription.

Where a run, the source or the catalogue told such an endpoint already, it learns which parameter names it. Where they
did not, and may have missed it, there is one more.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from preflight_analysis.documents.document import Document
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.meanings import (
    Known,
    KnownMeanings,
    Meant,
    known_of_nodes,
    meant_of_node,
    names_not_made,
    own_params,
    params_of_nodes,
)
from preflight_analysis.evaluation.ros2.params import of_name
from preflight_analysis.evaluation.tree import LaunchNode, LaunchTree, Param
from preflight_analysis.graph.build import effective_remaps
from preflight_analysis.incremental.kept import Kept
from preflight_analysis.knowledge.model import Knowledge
from preflight_analysis.tracing.interface import ENDS, Endpoint, Interface, NamedBy, Role

_ROLES: Mapping[tuple[str, str], Role] = {
    ("topic", "publisher"): "publisher",
    ("topic", "subscriber"): "subscriber",
    ("service", "server"): "service",
    ("service", "client"): "client",
    ("action", "server"): "action_server",
    ("action", "client"): "action_client",
}
_KINDS = {"topic": "msg", "service": "srv", "action": "action"}
_ANY, _OTHER = "*", "$"
"""A type that may be any; in a default the beginning of another parameter's name."""
_SAYS_SO = re.compile(r"(?:^|[._])(?:topic|service|action)s?(?:$|[._])|topic(?:_?name)?$", re.IGNORECASE)
"""The name of a parameter that has the name of an endpoint, whatever node has it."""


def with_named_endpoints(
    tree: LaunchTree,
    interfaces: Sequence[Interface],
    known: KnownMeanings,
    documents: Mapping[str, Document],
    kept: Kept,
) -> Sequence[Interface]:
    """The interfaces of the nodes of `tree`, in order, those that a simulator makes last, with what their parameters
    name, and those of the nodes that their processes make beside them."""
    said = known_of_nodes(tree, known, kept)
    columns = tree.nodes_and_simulated, interfaces, said, params_of_nodes(tree, said, kept)
    whole = list(kept.each_row(_with_named, columns, known, tree.ros.kinds_in_types))
    for at, node in enumerate(tree.nodes_and_simulated if tree.ros.own_parameters else ()):
        if whole[at].names:
            files = tuple(filter(None, (documents.get(each.path or "") for each in node.param_sources)))
            of_known = known.own, known.distro, known.generation
            whole[at] = kept.get(_with_named_within, at, node, whole[at], files, of_known, tree.ros.kinds_in_types)
    return whole


def _with_named_within(
    process: LaunchNode,
    interface: Interface,
    files: tuple[Document, ...],
    known: tuple[tuple[Knowledge, ...], str | None, int],
    kinds_in_types: bool,
) -> Interface:
    """The same of the other nodes of a process, such as the controllers of their manager."""
    every, documents = KnownMeanings(*known), {each.path: each for each in files}
    changed: dict[str | None, Interface] = {}
    _, *others = interface.apart(process.name).items()
    for name, part in others:
        beside = of_name(process, name, documents, inferred=True)._replace(within=process.name)
        said = every.within(beside, process)
        if said is not None:
            made = _with_named(beside, part, said, beside.params, every, kinds_in_types)
            if made is not part:
                changed[name] = made
    if not changed:
        return interface
    ends = [end for end in interface.endpoints if end.node not in changed]
    for full, made in changed.items():
        on_demand = all(end.conditional for end in made.endpoints if end.node == full)
        ends += [replace(end, node=full, conditional=end.conditional or on_demand) for end in made.endpoints]
    return replace(interface, endpoints=tuple(ends))


def _with_named(
    node: LaunchNode,
    interface: Interface,
    known: Known | None,
    given: Sequence[Param],
    every: KnownMeanings,
    kinds_in_types: bool,
) -> Interface:
    if interface.pending or (known is None and not given):
        return interface
    params = own_params(node, given)
    meant = meant_of_node(node, known, given, every) if known is not None else ()
    by_name = {(end.role, end.name): at for at, end in enumerate(interface.endpoints)}
    found: dict[int, NamedBy] = {}
    confirmed: dict[int, str] = {}
    typed: dict[int, str | None] = {}
    more: dict[tuple[str, str], Endpoint] = {}
    without: set[int] = set()
    replaced: set[int] = set()
    named: set[int] = set()
    may_have_more = not (interface.tells_all(*ENDS) or interface.declared)
    for each in meant:
        role = _ROLES.get((each.meaning.kind, each.meaning.role))
        if role is None or not isinstance(each.value, str) or not names.is_legal(each.value):
            continue
        instead = _default(node, each, every.generation)
        if instead is not None and (role, instead) in by_name:
            replaced.add(by_name[role, instead])
        name = f"{_base(node, each, every.generation)}{each.append}"
        named_by = NamedBy(each.param.name, each.param.place) if each.param is not None else None
        at = by_name.get((role, name))
        if at is not None:
            named.add(at)
            if named_by is not None:
                found.setdefault(at, named_by)
            if interface.endpoints[at].of_other_distribution and each.known.is_used:
                confirmed[at] = each.known.evidence
            type_ = _type_of(each, each.type, kinds_in_types) if each.type is not None else None
            if type_ not in (None, interface.endpoints[at].type) and _says_type(each, interface.endpoints[at]):
                typed[at] = type_
        elif name and may_have_more:
            more[role, name] = _endpoint(role, name, each, named_by, kinds_in_types)
            if name != each.value and (role, each.value) in by_name:
                without.add(by_name[role, each.value])
    for at, named_by in _by_their_names(interface, params):
        found.setdefault(at, named_by)
    for kind, role_in_kind, name in names_not_made(node, known, given) if known is not None else ():
        role = _ROLES.get((kind, role_in_kind))
        at = by_name.get((role, name)) if role is not None else None
        if at is not None and interface.endpoints[at].catalogued:
            without.add(at)
    # What the catalogue has by default has the other name instead, unless something else names it as well.
    without |= {at for at in replaced - named if interface.endpoints[at].catalogued}
    if not (found or confirmed or typed or more or without):
        return interface
    ends = [replace(end, named_by=found[at]) if at in found else end for at, end in enumerate(interface.endpoints)]
    for at, evidence in confirmed.items():
        ends[at] = replace(ends[at], catalogued=evidence, of_other_distribution=False)
    for at, type_ in typed.items():
        ends[at] = replace(ends[at], type=type_)
    if without:
        ends = [end for at, end in enumerate(ends) if at not in without]
    whole = known is not None and known.entry.whole and may_have_more
    source = interface.source if interface.known else "source" if whole else "catalogue"
    return replace(
        interface,
        source=source,
        endpoints=(*ends, *more.values()),
        whole=(*interface.whole, *ENDS) if whole else interface.whole,
    )


def _says_type(meant: Meant, end: Endpoint) -> bool:
    """Whether the type counts: nothing else says it, or only the catalogue, which has the one of no parameters."""
    default_of_catalogue = bool(end.catalogued) and end.typed_by is None and meant.known.is_used
    return end.type is None or (default_of_catalogue and meant.type != _ANY)


def _default(node: LaunchNode, meant: Meant, generation: int) -> str | None:
    """The name that it would have if no parameter set it."""
    default = meant.meaning.default
    if meant.param is None or not isinstance(default, str) or default == meant.value or _OTHER in default:
        return None
    return f"{_base(node, meant._replace(value=default), generation)}{meant.append}"


def _base(node: LaunchNode, meant: Meant, generation: int) -> str:
    """The value, or what a remap makes of it where that changes the beginning of the name."""
    value = str(meant.value)
    if meant.meaning.private and value and not value.startswith(("/", "~")):
        value = f"~{value}"
    if not (meant.meaning.remapped and meant.append):
        return value
    found = effective_remaps(node, generation).get(names.resolve(value, node.name))
    return found[1] if found is not None else names.resolve(value, node.name)


def _endpoint(role: Role, name: str, meant: Meant, named_by: NamedBy | None, kinds_in_types: bool) -> Endpoint:
    type_ = _type_of(meant, meant.type, kinds_in_types) if meant.type is not None else None
    if meant.known.entry.whole:
        return Endpoint(role, name, type_, None, meant.meaning.qos, named_by=named_by)
    return Endpoint(
        role,
        name,
        type_,
        None,
        meant.meaning.qos,
        inferred=True,
        catalogued=meant.known.evidence,
        of_other_distribution=not meant.known.is_used,
        named_by=named_by,
    )


def _type_of(meant: Meant, type_: str, kinds_in_types: bool) -> str:
    if type_ == _ANY or not kinds_in_types:
        return type_
    package, _, rest = type_.partition("/")
    return f"{package}/{_KINDS[meant.meaning.kind]}/{rest.rpartition('/')[2]}"


def _by_their_names(interface: Interface, params: Sequence[tuple[str, Param]]) -> Iterator[tuple[int, NamedBy]]:
    """The endpoints whose name is the value of one parameter, which by its own name has that of an endpoint."""
    values: dict[str, list[Param]] = {}
    for name, param in params:
        if isinstance(param.value, str) and param.value and _SAYS_SO.search(name):
            values.setdefault(param.value, []).append(param)
    for at, end in enumerate(interface.endpoints) if values else ():
        named = values.get(end.name, ())
        if len(named) == 1:
            yield at, NamedBy(named[0].name, named[0].place)
