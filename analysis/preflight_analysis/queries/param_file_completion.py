"""What can be written in a parameter file of ROS 2: names of nodes, `ros__parameters`, what the nodes declare."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import yaml

from preflight_analysis.documents.document import Document
from preflight_analysis.documents.span import Span
from preflight_analysis.evaluation.ros2.param_files import MARK
from preflight_analysis.model.sections import param_file
from preflight_analysis.queries.completion_graph import parameter_doc
from preflight_analysis.queries.completion_items import Completion, Item
from preflight_analysis.queries.cursor_yaml import Entry, outline
from preflight_analysis.queries.param_files import Reader, readers, readers_of
from preflight_analysis.queries.param_texts import default_text
from preflight_analysis.workspace.workspace import Analysis

_ANY = "/**"


def complete_param_file(analysis: Analysis, document: Document, offset: int, trigger: str | None) -> Completion | None:
    """What can be written at `offset`; None where nothing can. `trigger` as in `completion.complete`."""
    top, here = outline(document.text, offset)
    if here is None or here.dash is not None or offset < here.key_span.start:
        return None
    above = _above(here)
    keys = [entry.key for entry in above]
    if offset > here.key_span.end:
        asked_here = trigger in (None, " ") and MARK in keys and offset > here.key_span.end + 1
        return _value(analysis, document, here, keys, offset) if asked_here else None
    if trigger not in (None, "/"):
        return None
    siblings = {entry.key for entry in (above[-1].below if above else top) if entry is not here}
    colon = "" if document.text.startswith(":", here.key_span.end) else ":"
    if MARK in keys:
        items = _parameters(_fitting(analysis, document.path, keys), keys, siblings, colon)
    else:
        items = _names(readers(analysis, document.path), keys, siblings, colon)
    return Completion(here.key_span, tuple(items))


def _above(here: Entry) -> list[Entry]:
    found: list[Entry] = []
    entry = here.above
    while entry is not None:
        found.insert(0, entry)
        entry = entry.above
    return found


def _names(found: Sequence[Reader], keys: Sequence[str], siblings: set[str], colon: str) -> Iterator[Item]:
    """Above `ros__parameters`: nodes that get the file, and the mark below a name."""
    if keys and MARK not in siblings:
        snippet = f"{MARK}:\n  $0" if colon else None
        yield Item(
            "parameter", MARK, MARK + colon, "The parameters of the nodes that are named above.", snippet=snippet
        )
    prefix = "".join(f"/{key.strip('/')}" for key in keys)
    for reader in found:
        name = reader.node.name
        if not reader.node.named or not name.startswith(f"{prefix}/"):
            continue
        label = name if not keys else name[len(prefix) + 1 :]
        if label not in siblings:
            siblings.add(label)
            yield _node(label, colon, f"{reader.node.package}/{reader.node.executable}", "")
    if not keys and _ANY not in siblings:
        yield _node(_ANY, colon, "all nodes", "The parameters of every node that gets this file.")


def _node(label: str, colon: str, detail: str, doc: str) -> Item:
    snippet = f"{label.replace('$', '')}:\n  {MARK}:\n    $0" if colon else None
    return Item("namespace", label, label + colon, doc, detail, snippet=snippet)


def _parameters(found: Sequence[Reader], keys: list[str], siblings: set[str], colon: str) -> Iterator[Item]:
    """Below `ros__parameters`: what the nodes that the section is for declare, `a.b` as `b` below `a`."""
    prefix = "".join(f"{key}." for key in keys[keys.index(MARK) + 1 :])
    for reader in found:
        for use in reader.interface.params:
            name = use.name.removeprefix("~")
            if use.builtin or use.access == "set" or not name.startswith(prefix):
                continue
            label, dot, _ = name[len(prefix) :].partition(".")
            if not label or label in siblings:
                continue
            siblings.add(label)
            if dot:
                yield Item("parameter", label, label + colon, snippet=f"{label}:\n  $0" if colon else None)
                continue
            value = _written(use.default) if use.has_default and use.default is not None else ""
            snippet = f"{label}: ${{1:{_escaped(value)}}}" if colon else None
            text = label + (": " if colon else "")
            detail, doc = default_text(use).replace("`", ""), parameter_doc(reader.node, use, 2)
            yield Item("parameter", label, text, doc, detail, snippet=snippet)


def _fitting(analysis: Analysis, path: str, keys: list[str]) -> tuple[Reader, ...]:
    """The nodes that a section below these keys is for."""
    parts = [part for key in keys[: keys.index(MARK)] for part in key.split("/") if part]
    used = param_file(analysis.context, path)
    return readers_of(analysis, used.nodes_for("/" + "/".join(parts))) if used is not None else ()


def _value(analysis: Analysis, document: Document, here: Entry, keys: list[str], offset: int) -> Completion | None:
    """The default, or both truth values."""
    span = here.value_span if here.value else Span(offset, offset)
    name = ".".join((*keys[keys.index(MARK) + 1 :], here.key))
    for reader in _fitting(analysis, document.path, keys):
        use = reader.declared(name)
        if use is None or not use.has_default or use.default is None or not span.start <= offset <= span.end:
            continue
        default = _written(use.default)
        others = ["true" if default == "false" else "false"] if isinstance(use.default, bool) else []
        return Completion(
            span, tuple(Item("value", v, v, detail="default" * (v == default)) for v in [default, *others])
        )
    return None


def _written(value: object) -> str:
    """A value in YAML, on one line."""
    text: str = yaml.safe_dump(value, default_flow_style=True, width=10_000)
    return text.removesuffix("\n").removesuffix("\n...").strip()


def _escaped(text: str) -> str:
    return text.replace("\\", "\\\\").replace("$", "\\$").replace("}", "\\}")
