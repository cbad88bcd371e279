"""Topics, services and actions that parameters name, by what is known of a package: `odom0: /odom` is a subscription.

Where a run, the source or the catalogue told such an endpoint already, it learns which parameter names it. Where they
did not, and may have missed it, there is one more.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

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
from preflight_analysis.evaluation.tree import LaunchNode, LaunchTree, Param
from preflight_analysis.graph.build import effective_remaps
from preflight_analysis.incremental.kept import Kept
from preflight_analysis.tracing.interface import Endpoint, Interface, NamedBy, Role

_ROLES: Mapping[tuple[str, str], Role] = {
    ("topic", "publisher"): "publisher",
    ("topic", "subscriber"): "subscriber",
    ("service", "server"): "service",
    ("service", "client"): "client",
    ("action", "server"): "action_server",
    ("action", "client"): "action_client",
}
_KINDS = {"topic": "msg", "service": "srv", "action": "action"}
_SAYS_SO = re.compile(r"(?:^|[._])(?:topic|service|action)s?(?:$|[._])|topic(?:_?name)?$", re.IGNORECASE)
"""The name of a parameter that has the name of an endpoint, whatever node has it."""


def with_named_endpoints(
    tree: LaunchTree, interfaces: Sequence[Interface], known: KnownMeanings, kept: Kept
) -> Sequence[Interface]:
    """The interfaces of the nodes of `tree`, in order, those that a simulator makes last, with what their parameters
    name."""
    said = known_of_nodes(tree, known, kept)
    columns = tree.nodes_and_simulated, interfaces, said, params_of_nodes(tree, said, kept)
    return kept.each_row(_with_named, columns, known, tree.ros.kinds_in_types)


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
    typed: dict[int, str] = {}
    more: dict[tuple[str, str], Endpoint] = {}
    without: set[int] = set()
    may_have_more = not (interface.known_in_full or interface.declared)
    for each in meant:
        role = _ROLES.get((each.meaning.kind, each.meaning.role))
        if role is None or not isinstance(each.value, str) or not names.is_legal(each.value):
            continue
        name = f"{_base(node, each, every.generation)}{each.append}"
        named_by = NamedBy(each.param.name, each.param.place) if each.param is not None else None
        at = by_name.get((role, name))
        if at is not None:
            if named_by is not None:
                found.setdefault(at, named_by)
            if interface.endpoints[at].of_other_distribution and each.known.is_used:
                confirmed[at] = each.known.evidence
            if interface.endpoints[at].type is None and each.type is not None:
                typed[at] = _type_of(each, each.type, kinds_in_types)
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
    return replace(interface, source=source, endpoints=(*ends, *more.values()), whole=interface.whole or whole)


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
    if type_ == "*" or not kinds_in_types:
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
