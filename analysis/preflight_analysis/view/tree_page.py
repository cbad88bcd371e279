"""What a launch starts as one page that needs nothing else, coloured by the launch file that each thing comes from."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from html import escape

from preflight_analysis.documents.document import Document
from preflight_analysis.findings.printable import printable
from preflight_analysis.findings.report import place, relative
from preflight_analysis.queries.node_tree import Item, NodeTree
from preflight_analysis.view.page_parts import part, policy, script, template
from preflight_analysis.view.svg import COLOURS

_OPEN = ("namespace", "section")
_PLACED = ("node", "include", "not-taken")
"""The kinds of items at which the line stands that they are written in."""
_MANY = 40
"""Branches of more are closed at first."""


def tree_page(tree: NodeTree, documents: Mapping[str, Document], base: str | None) -> str:
    """The page of a tree. `documents` has the texts that its places are in."""
    drawing, style, code = part("drawing.css"), part("view.css"), script("tree.js")
    writer = _Writer({file: i % COLOURS for i, file in enumerate(tree.files)}, documents, base)
    root = _text(relative(tree.files[0], base) if tree.files else "")
    return template(
        "tree.html",
        {
            "POLICY": policy((drawing, style), (code,)),
            "TITLE": f"{root} – ROS launch",
            "DRAWING": drawing,
            "STYLE": style,
            "NAME": f"<bdi>{root}</bdi>",
            "TREE": writer.listed(tree.items),
            "LEGEND": "".join(
                f'<span role="listitem">{_colour(i % COLOURS)}{_text(relative(file, base))}</span>'
                for i, file in enumerate(tree.files)
            ),
            "COUNT": f"{tree.nodes} node{'' if tree.nodes == 1 else 's'}",
            "SCRIPT": code,
        },
    )


class _Writer:
    def __init__(self, colours: Mapping[str, int], documents: Mapping[str, Document], base: str | None) -> None:
        self._colours = colours
        self._documents = documents
        self._base = base

    def listed(self, items: Iterable[Item]) -> str:
        rows = "".join(map(self._item, items))
        return f"<ul>{rows}</ul>" if rows else ""

    def _item(self, item: Item) -> str:
        colour = self._colours.get(item.file) if item.file is not None and item.kind in _PLACED else None
        where = place(item.location, self._documents, self._base) if item.location and item.kind in _PLACED else ""
        dim = " · ".join(filter(None, (item.detail, where)))
        head = (
            f"{_colour(colour) if colour is not None else ''}<b>{_text(item.label)}</b> "
            f'<span class="dim">{_text(dim)}</span>{_count(item)}'
        )
        open_ = " open" if item.kind in _OPEN and len(item.children) <= _MANY else ""
        body = (
            f"<details{open_}><summary>{head}</summary>{self.listed(item.children)}</details>"
            if item.children
            else f"<span>{head}</span>"
        )
        text = _text(f"{item.name} {item.label} {item.detail}".lower())
        return f'<li class="{item.kind}" data-text="{text}">{body}</li>'


def _count(item: Item) -> str:
    if item.worst is None:
        return ""
    noun = item.worst if item.findings == 1 else f"findings, the worst is: {item.worst}"
    return f'<span class="count {item.worst}" aria-label="{item.findings} {noun}">{item.findings}</span>'


def _colour(index: int) -> str:
    return (
        '<svg class="graph colour" width="12" height="12" aria-hidden="true">'
        f'<rect class="accent f{index}" width="12" height="12" rx="3"/></svg>'
    )


def _text(text: str) -> str:
    return escape(printable(text))
