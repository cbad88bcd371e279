"""Files that parameters and arguments of a node name, whose content is parameters for what is known of its package:
`yaml_cfg_file.subscribers.0.topic`, below the name of the parameter."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import yaml

from preflight_analysis.documents.document import Document
from preflight_analysis.documents.reading import Unreadable
from preflight_analysis.documents.span import Span
from preflight_analysis.documents.yaml import CONSTRUCTION_ERRORS, compose_fast, constructed, span_of
from preflight_analysis.evaluation.collector import Collector
from preflight_analysis.evaluation.known_arguments import arguments_of
from preflight_analysis.evaluation.lua_options import assignments, included
from preflight_analysis.evaluation.meanings import KnownMeanings
from preflight_analysis.evaluation.tree import LaunchNode, Param, ParamValue
from preflight_analysis.incremental.derived import derived
from preflight_analysis.knowledge.model import Meaning

_MOST = 1000
"""Values of a file."""
_MAX_DEPTH = 8
_MAX_FILES = 8
"""That include each other."""


class _Row(NamedTuple):
    """A value of a file by the names on the way to it, joined by dots, and where the last of them is written."""

    name: str
    value: ParamValue
    span: Span


def params_of_files(
    found: Collector, nodes: Sequence[LaunchNode], params: Mapping[str, Param] | None, known: KnownMeanings
) -> Mapping[str, tuple[Param, ...]]:
    """What the files of nodes have, by the full name of the node. `params` are those of ROS 1."""
    made: dict[str, tuple[Param, ...]] = {}
    for node in nodes:
        said = known.of_node(node)
        files = [each for each in said.entry.meanings if each.kind == "file"] if said is not None else []
        if said is None or not files:
            continue
        values = {**_values(node, params), **arguments_of(node, said.entry)}
        rows = tuple(param for each in files for param in _of_file(found, each, values))
        if rows:
            made[node.name] = rows
    return made


def _values(node: LaunchNode, params: Mapping[str, Param] | None) -> Mapping[str, Any]:
    if params is None:
        return {param.name: param.value for param in node.params}
    below = f"{node.name}/"
    given = (param for name, param in params.items() if name.startswith(below))
    return {param.name.removeprefix(below).replace("/", "."): param.value for param in given}


def _of_file(found: Collector, meaning: Meaning, values: Mapping[str, Any]) -> Iterator[Param]:
    path, folder = values.get(meaning.pattern), values.get(meaning.folder, "")
    if not isinstance(path, str) or not path or not isinstance(folder, str):
        return
    path = os.path.join(folder, path)
    if not path.startswith("/"):
        return
    for document, rows in (_lua if meaning.role == "lua" else _yaml)(found, path):
        for row in rows:
            location = document.location(row.span)
            yield Param(f"{meaning.pattern}.{row.name}", row.value, (location,), name_location=location)


_Rows = Iterator[tuple[Document, Sequence[_Row]]]


def _yaml(found: Collector, path: str) -> _Rows:
    document = found.read_text(found.located(path))
    if not isinstance(document, Unreadable):
        yield document, _yaml_rows(document)


@derived
def _yaml_rows(document: Document) -> tuple[_Row, ...]:
    try:
        root = compose_fast(document.text)
        rows: list[_Row] = []
        if root is not None:
            _add(rows, root, "", span_of(root), 0)
    except CONSTRUCTION_ERRORS:
        return ()
    return tuple(rows)


def _add(rows: list[_Row], node: yaml.Node, name: str, span: Span, depth: int) -> None:
    if len(rows) >= _MOST or depth > _MAX_DEPTH:
        return
    below = f"{name}." if name else ""
    if isinstance(node, yaml.MappingNode):
        for key, value in node.value:
            if isinstance(key, yaml.ScalarNode):
                _add(rows, value, f"{below}{key.value}", span_of(key), depth + 1)
    elif isinstance(node, yaml.SequenceNode):
        for at, value in enumerate(node.value):
            _add(rows, value, f"{below}{at}", span_of(value), depth + 1)
    elif name:
        rows.append(_Row(name, constructed(node), span))


def _lua(found: Collector, path: str) -> _Rows:
    """The last assignment of each name counts, that of an included file before those of the file."""
    last: dict[str, tuple[Document, _Row | None]] = {}
    folder = os.path.dirname(path)
    waiting, read = [path], list[Document]()
    while waiting and len(read) < _MAX_FILES:
        document = found.read_text(found.located(waiting.pop()))
        if isinstance(document, Document) and all(document.path != each.path for each in read):
            read.append(document)
            waiting += (os.path.join(folder, name) for name in included(document))
    for document in reversed(read):
        for name, value, span in assignments(document):
            last[name] = document, _Row(name, value, span) if value is not None else None
    for document in read:
        yield document, [row for of, row in last.values() if of is document and row is not None]
