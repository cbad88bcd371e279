"""Topics, services and actions that parameters name, by what is known of a package: `odom0: /odom` is a subscription.

Where a run, the source or the catalogue told such an endpoint already, it learns which parameter names it. Where they
did not, and may have missed it, there is one more.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

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
from preflight_analysis.evaluation.tree import LaunchNode, Param
from preflight_analysis.graph.build import effective_remaps
from preflight_analysis.interfaces.part import Launch, Part, Rows
from preflight_analysis.tracing.interface import (
    ENDS,
    Endpoint,
    Evidence,
    Interface,
    NamedBy,
    ParamUse,
    Role,
    Source,
    Unsure,
)

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


def names_asked(launch: Launch, known: Sequence[Interface]) -> Rows:
    """What is known of each node, and the parameters that may name something."""
    said = known_of_nodes(launch.tree, launch.known, launch.kept)
    columns = said, params_of_nodes(launch.tree, said, launch.kept)
    return Rows(columns, (launch.known, launch.tree.ros.kinds_in_types))


def named(
    node: LaunchNode,
    interface: Interface,
    known: Known | None,
    given: Sequence[Param],
    every: KnownMeanings,
    kinds_in_types: bool,
) -> Part | None:
    """What the parameters of a node name."""
    if interface.pending or (known is None and not given):
        return None
    params = own_params(node, given)
    by_name = {(end.role, end.name): end for end in interface.endpoints}
    may_have_more = not (interface.tells_all(*ENDS) or interface.declared)
    changes = _Changes()
    for each in meant_of_node(node, known, given, every) if known is not None else ():
        role = _ROLES.get((each.meaning.kind, each.meaning.role))
        if role is None or not isinstance(each.value, str) or not names.is_legal(each.value):
            continue
        instead = _default(node, each, every.generation)
        if instead is not None and (role, instead) in by_name:
            changes.replaced.append(by_name[role, instead])
        name = f"{_base(node, each, every.generation)}{each.append}"
        named_by = NamedBy(each.param.name, each.param.place) if each.param is not None else None
        end = by_name.get((role, name))
        if end is not None:
            changes.named.add(id(end))
            changes.learn(end, _learned(end, each, named_by, kinds_in_types))
        elif name and may_have_more:
            changes.more[role, name] = _endpoint(role, name, each, named_by, kinds_in_types)
            if name != each.value and (role, each.value) in by_name:
                changes.without.append(by_name[role, each.value])
    for end, named_by in _by_their_names(interface, params):
        changes.learn(end, {"named_by": named_by})
    for kind, role_in_kind, name in names_not_made(node, known, given) if known is not None else ():
        role = _ROLES.get((kind, role_in_kind))
        end = by_name.get((role, name)) if role is not None else None
        if end is not None and end.evidence.of_catalogue:
            changes.without.append(end)
    # What the catalogue has by default has the other name instead, unless something else names it as well.
    changes.without += (end for end in changes.replaced if id(end) not in changes.named and end.evidence.of_catalogue)
    corrected, more = changes.corrected(interface), tuple(changes.more.values())
    if not (corrected or more):
        return None
    whole = known is not None and known.entry.whole and may_have_more
    source: Source = "source" if whole else "catalogue"
    return Part(source, more, corrected=corrected, closed=ENDS if whole else (), leads=False)


class _Changes:
    """What the parameters of a node say of the ends that it is known to have, and of more."""

    def __init__(self) -> None:
        self.more: dict[tuple[str, str], Endpoint] = {}
        self.without: list[Endpoint] = []
        self.replaced: list[Endpoint] = []
        """Those that have another name where no parameter gives it."""
        self.named: set[int] = set()
        """The ids of those that something names."""
        self._learned: dict[int, dict[str, Any]] = {}

    def learn(self, end: Endpoint, fields: Mapping[str, Any]) -> None:
        """What is said first of a field counts, but for the type."""
        known = self._learned.setdefault(id(end), {})
        for name, value in fields.items():
            if name == "type" or name not in known:
                known[name] = value

    def corrected(self, interface: Interface) -> tuple[tuple[Endpoint, Endpoint | None], ...]:
        """The ends of the interface that are others than it was known."""
        without = {*map(id, self.without)}
        return tuple(
            (end, None if id(end) in without else replace(end, **self._learned[id(end)]))
            for end in interface.endpoints
            if id(end) in without or self._learned.get(id(end))
        )


def _learned(end: Endpoint, meant: Meant, named_by: NamedBy | None, kinds_in_types: bool) -> Mapping[str, Any]:
    """What is known of an end that a parameter names beyond that it is there."""
    learned: dict[str, Any] = {"named_by": named_by} if named_by is not None else {}
    if "other distribution" in end.evidence.doubts and meant.known.is_used:
        confirmed = end.evidence.without("other distribution")
        learned["evidence"] = replace(confirmed, said_by=meant.known.evidence)
    type_ = _type_of(meant, meant.type, kinds_in_types) if meant.type is not None else None
    if type_ not in (None, end.type) and _says_type(meant, end):
        learned["type"] = type_
    return learned


def names_within_asked(launch: Launch, known: Sequence[Interface]) -> Rows | None:
    """The parameter files of each node whose process makes others beside it."""
    if not launch.tree.ros.own_parameters or not any(interface.names for interface in known):
        return None
    pairs = enumerate(zip(launch.nodes, known, strict=True))
    found = {at: _files_of(launch, at, node) for at, (node, interface) in pairs if interface.names}
    return Rows((launch.shown(found),), (launch.known, launch.tree.ros.kinds_in_types))


def _files_of(launch: Launch, at: int, node: LaunchNode) -> tuple[Document, ...]:
    """The same object as last time where the files are."""
    files = (launch.documents.get(each.path or "") for each in node.param_sources)
    return launch.kept.get(_documents, at, *filter(None, files))


def _documents(*files: Document) -> tuple[Document, ...]:
    return files


def named_within(
    process: LaunchNode,
    interface: Interface,
    files: tuple[Document, ...] | None,
    every: KnownMeanings,
    kinds_in_types: bool,
) -> Part | None:
    """The same of the other nodes of a process, such as the controllers of their manager."""
    if files is None:
        return None
    documents = {each.path: each for each in files}
    more: list[Endpoint] = []
    corrected: list[tuple[Endpoint | ParamUse, Endpoint | ParamUse | None]] = []
    _, *others = interface.apart(process.name).items()
    for name, apart in others:
        beside = of_name(process, name, documents, inferred=True)._replace(within=process.name)
        said = every.within(beside, process)
        part = named(beside, apart, said, beside.params, every, kinds_in_types) if said is not None else None
        if part is not None:
            on_demand = all(end.evidence.conditional for end in apart.endpoints if end.node == name)
            doubts: tuple[Unsure, ...] = ("condition",) if on_demand else ()
            more += (replace(end, node=name, evidence=end.evidence.but(*doubts)) for end in part.endpoints)
            corrected += part.corrected
    return Part("catalogue", tuple(more), corrected=tuple(corrected), leads=False) if more or corrected else None


def _says_type(meant: Meant, end: Endpoint) -> bool:
    """Whether the type counts: nothing else says it, or only the catalogue, which has the one of no parameters."""
    default_of_catalogue = bool(end.evidence.of_catalogue) and end.typed_by is None and meant.known.is_used
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
    known = Evidence("catalogue", meant.known.evidence)
    if meant.known.entry.whole:
        known = Evidence("configuration")
    elif not meant.known.is_used:
        known = known.but("other distribution")
    return Endpoint(role, name, type_, None, meant.meaning.qos, evidence=known, named_by=named_by)


def _type_of(meant: Meant, type_: str, kinds_in_types: bool) -> str:
    if type_ == _ANY or not kinds_in_types:
        return type_
    package, _, rest = type_.partition("/")
    return f"{package}/{_KINDS[meant.meaning.kind]}/{rest.rpartition('/')[2]}"


def _by_their_names(interface: Interface, params: Sequence[tuple[str, Param]]) -> Iterator[tuple[Endpoint, NamedBy]]:
    """The endpoints whose name is the value of one parameter, which by its own name has that of an endpoint."""
    values: dict[str, list[Param]] = {}
    for name, param in params:
        if isinstance(param.value, str) and param.value and _SAYS_SO.search(name):
            values.setdefault(param.value, []).append(param)
    for end in interface.endpoints if values else ():
        naming = values.get(end.name, ())
        if len(naming) == 1:
            yield end, NamedBy(naming[0].name, naming[0].place)
