"""The call hierarchy of launch files: who includes a file, and what it includes."""

from __future__ import annotations

import os
from collections.abc import Iterable
from dataclasses import dataclass

from preflight_analysis.documents.span import Location, Span
from preflight_analysis.queries.scene import Scene
from preflight_analysis.queries.subject import subject_at
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


def items_at(scene: Scene, offset: int) -> tuple[Item, ...]:
    """The files that the include at `offset` leads to; anywhere else the file itself."""
    subject = subject_at(scene, offset)
    here = scene.current.included_from(scene.path)
    targets = [i.target for i in here if i.tag.span.contains(offset)]
    if subject is not None and subject.kind == "file":
        targets = list(subject.files)
    return tuple(_item(scene, path) for path in dict.fromkeys(targets or [scene.path]))


def incoming(scene: Scene) -> tuple[Call, ...]:
    """Who includes the scene's file, in the order of their paths."""
    return _calls(scene, ((i.includer, i) for i in scene.current.includers(scene.path)))


def outgoing(scene: Scene) -> tuple[Call, ...]:
    """What the scene's file includes, in the order of its text."""
    return _calls(scene, ((i.target, i) for i in scene.current.included_from(scene.path)))


def _calls(scene: Scene, ends: Iterable[tuple[str, Inclusion]]) -> tuple[Call, ...]:
    by_file: dict[str, list[Inclusion]] = {}
    for path, inclusion in ends:
        by_file.setdefault(path, []).append(inclusion)
    return tuple(
        Call(_item(scene, path, found), tuple(sorted({i.place for i in found}, key=lambda place: place.span)))
        for path, found in by_file.items()
    )


def _item(scene: Scene, path: str, inclusions: Iterable[Inclusion] = ()) -> Item:
    launch_file = scene.launch_file(path)
    root = launch_file.root if launch_file else None
    given = dict.fromkeys(
        " ".join(f"{name}:={'?' if value is None else value}" for name, value in i.args.items()) for i in inclusions
    )
    folder = os.path.dirname(scene.shown(path))
    detail = ", ".join(part for part in (folder, *given) if part)
    nowhere = Span(0, 0)
    return Item(
        path, os.path.basename(path), detail, root.span if root else nowhere, root.head_span if root else nowhere
    )
