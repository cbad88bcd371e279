"""Changes that make the two ends of a near miss meet."""

from __future__ import annotations

from collections.abc import Iterable

from preflight_analysis.documents.document import Document
from preflight_analysis.documents.span import Span
from preflight_analysis.edits.writer import writer_of
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.tree import Remap
from preflight_analysis.evaluation.value_places import value_place
from preflight_analysis.findings.finding import Fix
from preflight_analysis.graph.model import Connection
from preflight_analysis.model.context import Context
from preflight_analysis.model.near_miss import NearMiss
from preflight_analysis.model.places import connection_location


def fixes(near: NearMiss, consumers: Document | None, providers: Document | None) -> tuple[Fix, ...]:
    """What makes the two ends meet: the remap that gave the wrong name corrected, else a remap into a node's tag.
    `consumers` and `providers` are the texts in which the ends have their places: see `documents_of`."""
    site, other = near.site, near.other
    if not near.mendable or _is_guessed(near.consumer) or _is_guessed(near.provider):
        return ()
    if site.remap is not None and near.likeness != "remap":
        document = consumers if site is near.consumer else providers
        corrected = _correct_remap(document, site, site.remap, other.name)
        if corrected is not None:
            return (corrected,)
    if site.remap is None and site.endpoint.named_by is not None:
        corrected = _correct_parameter(consumers if site is near.consumer else providers, site, other.name)
        return (corrected,) if corrected is not None else ()
    # A remap at a publisher that others listen to would only move the gap to them.
    movable = (near.consumer, *((near.provider,) if near.provider_dangles else ()))
    connections = [connection for connection in movable if not connection.is_placed]
    found = [
        _insert_remap(
            consumers if connection is near.consumer else providers,
            connection,
            _partner(near, connection).name,
            connection is connections[0],
        )
        for connection in connections
    ]
    return tuple(fix for fix in found if fix is not None)


def _is_guessed(connection: Connection) -> bool:
    """Whether a private name stands below a name that only the executable suggests for its node."""
    node = connection.node
    return connection.endpoint.name.startswith("~") and not (node.named or node.name_from_code)


def _partner(near: NearMiss, connection: Connection) -> Connection:
    return near.provider if connection is near.consumer else near.consumer


def fixes_in(context: Context, near: NearMiss) -> tuple[Fix, ...]:
    """`fixes` in the texts as they are."""
    (consumers,), (providers,) = documents_of(context, [near])
    return fixes(near, consumers, providers)


def documents_of(context: Context, near: Iterable[NearMiss]) -> tuple[list[Document | None], list[Document | None]]:
    """The texts in which the consumers have their places, and those of the providers."""
    get, pairs = context.documents.get, list(near)
    return (
        [get(connection_location(pair.consumer).file) for pair in pairs],
        [get(connection_location(pair.provider).file) for pair in pairs],
    )


def _correct_remap(document: Document | None, connection: Connection, remap: Remap, new: str) -> Fix | None:
    if document is None:
        return None
    span = remap.target_location.span
    written = document.text[span.start : span.end]
    if "$(" in written or "&" in written or not written:
        return None
    return _replacement(document, span, written, _in_style_of(written, connection.name, new))


def _correct_parameter(document: Document | None, connection: Connection, new: str) -> Fix | None:
    """The value of the parameter that names the end corrected."""
    end = connection.endpoint
    place = value_place(end.named_by.place, end.name, document) if end.named_by is not None else None
    if place is None or document is None:
        return None
    return _replacement(document, place.span, end.name, _in_style_of(end.name, connection.name, new))


def _replacement(document: Document, span: Span, old: str, new: str) -> Fix | None:
    edits = writer_of(document).replace(span, new)
    return Fix(f"Replace '{old}' with '{new}'", edits, True) if edits else None


def _in_style_of(written: str, full: str, new: str) -> str:
    """`new`, a full name, as relative as `written` is, which stands for `full`; as a full name if that cannot be."""
    if written.startswith("/"):
        return new
    mark = "~" if written.startswith("~") else ""
    stem = names.canonicalize(written[len(mark) :])
    prefix = full.removesuffix(stem)
    if full.endswith("/" + stem) and new.startswith(prefix) and len(new) > len(prefix):
        return mark + new[len(prefix) :]
    return new


def _insert_remap(document: Document | None, connection: Connection, target: str, preferred: bool) -> Fix | None:
    if document is None:
        return None
    source = connection.endpoint.name
    namespace = names.parent(connection.node.name)
    relative = not source.startswith("/") and target.startswith(namespace)
    written = target[len(namespace) :] if relative else target
    edits = writer_of(document).add_remap(connection.node.action, source, written)
    return Fix(f"Remap '{source}' to '{written}' in {connection.node.name}", edits, preferred) if edits else None
