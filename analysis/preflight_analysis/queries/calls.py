"""The call hierarchy of launch files: who includes a file, and what it includes."""

from __future__ import annotations

import os
from collections.abc import Iterable

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Location, Span
from preflight_analysis.queries.handed_over import is_handed_over
from preflight_analysis.queries.query_context import QueryContext
from preflight_analysis.queries.symbol_at import symbol_at
from preflight_analysis.workspace.index import Inclusion


@dataclass(frozen=True, slots=True)
class Item:
    """A launch file. `detail` says where it is and, for a call, what it is given; `head` is its `<launch>` tag."""

    path: str
    name: str
    detail: str
    span: Span
    head: Span


@dataclass(frozen=True, slots=True)
class Call:
    """The file at the other end, and the `file` values of the includes, which stand in the including file."""

    item: Item
    places: tuple[Location, ...]


def items_at(context: QueryContext, offset: int) -> tuple[Item, ...]:
    """The files that the include at `offset` leads to; anywhere else the file itself, where it is a launch file."""
    if is_handed_over(context.analyses, context.path):
        return ()
    symbol = symbol_at(context, offset)
    here = context.current.included_from(context.path)
    targets = [i.target for i in here if i.tag.span.contains(offset)]
    if symbol is not None and symbol.kind == "file":
        targets = list(symbol.files)
    return tuple(_item(context, path) for path in dict.fromkeys(targets or [context.path]))


def incoming(context: QueryContext) -> tuple[Call, ...]:
    """Who includes the file of the context, in the order of their paths."""
    return _calls(context, ((i.includer, i) for i in context.current.includers(context.path)))


def outgoing(context: QueryContext) -> tuple[Call, ...]:
    """What the file of the context includes, in the order of its text."""
    return _calls(context, ((i.target, i) for i in context.current.included_from(context.path)))


def _calls(context: QueryContext, ends: Iterable[tuple[str, Inclusion]]) -> tuple[Call, ...]:
    by_file: dict[str, list[Inclusion]] = {}
    for path, inclusion in ends:
        by_file.setdefault(path, []).append(inclusion)
    return tuple(
        Call(_item(context, path, found), tuple(sorted({i.place for i in found}, key=lambda place: place.span)))
        for path, found in by_file.items()
    )


def _item(context: QueryContext, path: str, inclusions: Iterable[Inclusion] = ()) -> Item:
    launch_file = context.launch_file(path)
    root = launch_file.root if launch_file else None
    given = dict.fromkeys(
        " ".join(f"{name}:={'?' if value is None else value}" for name, value in i.args.items()) for i in inclusions
    )
    folder = os.path.dirname(context.shown(path))
    detail = ", ".join(part for part in (folder, *given) if part)
    nowhere = Span(0, 0)
    return Item(
        path, os.path.basename(path), detail, root.span if root else nowhere, root.head_span if root else nowhere
    )
