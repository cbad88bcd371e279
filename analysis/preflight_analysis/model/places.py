"""Where a finding about a node is shown."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.quoted import Program
from preflight_analysis.documents.span import Location, Span
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.finding import EndpointRef, Related
from preflight_analysis.graph.model import Connection, ParamRead
from preflight_analysis.incremental.derived import derived
from preflight_analysis.model.context import Context
from preflight_analysis.tracing.interface import Endpoint, ParamUse, Role

_KINDS: Mapping[Role, Literal["topic", "service", "action"]] = {
    "publisher": "topic",
    "subscriber": "topic",
    "service": "service",
    "client": "service",
    "action_server": "action",
    "action_client": "action",
}

_PROGRAM = frozenset({"pkg", "type", "exec"})
"""The attributes that say what is started."""


@dataclass(frozen=True, slots=True)
class Verbs:
    """How to say what the two ends do: `publishes`, `subscribes to`."""

    provides: str
    consumes: str


@derived
def known_by_source(context: Context) -> frozenset[int]:
    """The ids of the nodes that are known from their source alone."""
    graph = context.graph
    pairs = zip(graph.tree.nodes, graph.interfaces, strict=True) if graph is not None else ()
    return frozenset(id(node) for node, interface in pairs if interface.source == "source")


def program_known(node: LaunchNode) -> bool:
    """Whether the package and the executable of a node are known, whatever else is not."""
    return all(each.what not in _PROGRAM for each in node.unknowns)


def attribute_location(context: Context, node: LaunchNode, name: str) -> Location:
    """The value of an attribute of the node's tag; the start tag if it has none of that name."""
    span = node.tag.span_of(name)
    return context.location(node.location.file, span) if span is not None else node.location


def argument_location(context: Context, node: LaunchNode, text: str) -> Location:
    """The argument of a node's command line that has `text` in it: a value of its own in Python; else all arguments."""
    for child in node.action.children:
        value = child.value("value") if child.kind == "argument" else None
        if value is not None and text in value.text:
            return context.location(node.location.file, value.span)
    return attribute_location(context, node, "cmd" if node.kind == "process" else "args")


def connection_location(connection: Connection) -> Location:
    """Where the launch decides on the name of the connection: the remap's `to`, the parameter that names it, else the
    node's start tag."""
    if connection.remap is not None:
        return connection.remap.target_location
    named_by = connection.endpoint.named_by
    return named_by.place if named_by is not None else connection.node.location


def related_endpoint(connection: Connection, verb: str) -> Related:
    """The other end, `verb` says what it does: `publishes`, `subscribes to`, ..."""
    known = _how_known(connection.endpoint)
    return Related(f"{connection.node.name} {verb} {connection.name}{known}", connection_location(connection))


def endpoints_of(*connections: Connection) -> tuple[EndpointRef, ...]:
    """The ends as a finding names them."""
    return tuple(EndpointRef(_KINDS[c.endpoint.role], c.name, c.node.name) for c in connections)


def subject_of(connection: Connection) -> Subject:
    """The topic, service or action of an end."""
    return Subject(_KINDS[connection.endpoint.role], connection.name)


def related_node(node: LaunchNode) -> Related:
    """Where the node is started."""
    return Related(f"{node.name} is started here", node.location)


def related_param_read(read: ParamRead) -> Related:
    """The node that reads a parameter."""
    known = _how_known(read.use)
    return Related(f"{read.node.name} reads {read.name}{known}", read.node.location)


def _how_known(what: Endpoint | ParamUse) -> str:
    if what.evidence.source == "similar":
        return " (from a run with other settings)"
    if isinstance(what, Endpoint) and what.displayed:
        return " (from its configuration)"
    if what.evidence.said_by:
        return f" (from {what.evidence.said_by})"
    return " (from its source)" if what.evidence.inferred else ""


def quoted_once(context: Context, file: str, text: str) -> Location | None:
    """Where a file has a text in quotes, if that is once."""
    document = context.document(file)
    quoted = [each for each in Program(file, document.text).quoted if each.text == text] if document is not None else []
    return context.location(file, Span(quoted[0].start + 1, quoted[0].end - 1)) if len(quoted) == 1 else None
