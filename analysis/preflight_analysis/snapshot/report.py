"""Differences for people (text, markdown for a pull request) and for programs (JSON)."""

from __future__ import annotations

import itertools
import json
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from preflight_analysis.findings.markdown import code, escaped
from preflight_analysis.findings.printable import printable
from preflight_analysis.snapshot.difference import Change, Difference
from preflight_analysis.snapshot.model import GROUPS, Snapshot

SCHEMA = "ros-preflight/diff/1"
_SIGNS = {"added": "+", "removed": "-", "changed": "~"}
_VERBS = {
    "publisher": "publishes",
    "subscriber": "subscribes to",
    "service": "offers service",
    "client": "calls service",
    "action_server": "offers action",
    "action_client": "uses action",
    "read": "reads parameter",
    "fact": "",
    "env": "environment",
}
_COLOURS = {"added": "\x1b[32m", "removed": "\x1b[31m", "changed": "\x1b[33m"}


def to_json(found: Difference) -> dict[str, Any]:
    """The contract's object."""
    return {
        "schema": SCHEMA,
        "before": _operand(found.before),
        "after": _operand(found.after),
        "same": found.same,
        "changes": [
            {
                "kind": change.kind,
                "what": change.what,
                "node": change.node,
                "name": change.name,
                "before": change.before,
                "after": change.after,
            }
            for change in found.changes
        ],
        "connections": [
            {"kind": link.kind, "what": link.what, "name": link.name, "offers": link.provider, "wants": link.consumer}
            for link in found.links
        ],
        "not_compared": [{"node": node, "reason": reason} for node, reason in found.not_compared.items()],
    }


def to_text(found: Difference, before: str, after: str, *, colour: bool = False) -> str:
    """Lines with a sign in front: what came (+), went (-) and changed (~). `before` and `after` name the sides."""

    def line(kind: str, text: str, indent: str = "") -> str:
        formatted = f"{indent}{_SIGNS[kind]} {printable(text)}"
        return f"{_COLOURS[kind]}{formatted}\x1b[0m" if colour else formatted

    lines = [f"before: {before}", f"after:  {after}", ""]
    for node, changes in itertools.groupby(found.changes, key=lambda change: change.node):
        of_node = list(changes)
        whole = of_node[0]
        if node is None:
            lines += [line(change.kind, _describe(change)) for change in of_node]
        elif whole.what == "node":
            lines.append(line(whole.kind, f"node {node}  {_about(whole.before or whole.after)}"))
        else:
            lines.append(line("changed", f"node {node}"))
            lines += [line(change.kind, _describe(change), "  ") for change in of_node]
    if found.links:
        lines += ["", "connections"]
        lines += [
            line(link.kind, f"{link.what} {link.name}  {link.provider} -> {link.consumer}", "  ")
            for link in found.links
        ]
    if found.not_compared:
        lines += ["", "not compared to the end"]
        lines += [f"  {node}: {reason}" for node, reason in found.not_compared.items()]
    if found.changes or found.links or found.not_compared:
        lines.append("")
    lines.append(summary(found))
    return "\n".join(lines) + "\n"


def to_markdown(found: Difference, before: str, after: str) -> str:
    """For a comment on a pull request: a sentence, and tables of what is not the same."""
    lines = ["### Launch configuration", "", f"{_code(before)} → {_code(after)}: **{summary(found)}**"]
    if found.changes:
        lines += ["", "| | node | what | before | after |", "| --- | --- | --- | --- | --- |"]
        lines += [_row(change) for change in found.changes]
    if found.links:
        lines += ["", "| | connection | from | to |", "| --- | --- | --- | --- |"]
        lines += [
            f"| {_SIGNS[link.kind]} | {link.what} {_code(link.name)} "
            f"| {_code(link.provider)} | {_code(link.consumer)} |"
            for link in found.links
        ]
    if found.not_compared:
        lines += ["", "Not compared to the end:", ""]
        lines += [f"- {_code(node)}: {escaped(reason)}" for node, reason in found.not_compared.items()]
    return "\n".join(lines) + "\n"


def summary(found: Difference) -> str:
    """How much came, went and changed, in one line."""
    if found.same:
        return "no differences"
    nodes = Counter(change.kind for change in found.changes if change.what == "node")
    changed = len({change.node for change in found.changes if change.node is not None and change.what != "node"})
    links = Counter(link.kind for link in found.links)
    others = sum(change.node is None for change in found.changes)
    said = [
        *_counted("node", {"added": nodes["added"], "removed": nodes["removed"], "changed": changed}),
        *_counted("connection", {"added": links["added"], "removed": links["removed"]}),
        *_counted("difference", {"beside the nodes": others}),
    ]
    return ", ".join(said)


def _counted(noun: str, counts: Mapping[str, int]) -> Iterator[str]:
    return (f"{count} {noun}{'' if count == 1 else 's'} {word}" for word, count in counts.items() if count)


def _operand(snapshot: Snapshot) -> dict[str, Any]:
    return {"launch": snapshot.launch, "generation": snapshot.generation, "args": dict(snapshot.args)}


def _describe(change: Change) -> str:
    words = " ".join(word for word in (_VERBS.get(change.what, change.what), change.name) if word)
    if change.what in GROUPS.values():
        if change.kind == "changed":
            return f"{words}  {', '.join(_steps(change))}"
        return f"{words}  {_endpoint(change.before or change.after)}"
    if change.what in ("error", "unknown"):
        return words
    if change.kind == "changed":
        return f"{words}  {_value(change.before)} -> {_value(change.after)}"
    value = change.after if change.kind == "added" else change.before
    return words if value == {} else f"{words}  {_value(value)}"


def _steps(change: Change) -> Iterator[str]:
    return (f"{key} {_value(change.before[key])} -> {_value(change.after[key])}" for key in change.before)


def _endpoint(endpoint: Mapping[str, Any]) -> str:
    qos = ", ".join(f"{key} {_value(value)}" for key, value in endpoint.items() if key != "type")
    return f"{endpoint['type'] or 'type not known'}{f' ({qos})' if qos else ''}"


def _about(node: Mapping[str, Any]) -> str:
    """A whole node in a line."""
    counts = ((len(node.get(group, ())), group.replace("_", " ")) for group in (*GROUPS, "parameters"))
    has = ", ".join(f"{count} {noun[:-1] if count == 1 else noun}" for count, noun in counts if count)
    return f"{node.get('package', '')}/{node.get('executable', '')}{f'  ({has})' if has else ''}"


def _value(value: Any) -> str:
    if isinstance(value, str):
        return value or '""'
    if isinstance(value, Mapping) and value.keys() == {"characters", "sha1"}:
        return f"{value['characters']} characters (sha1 {str(value['sha1'])[:8]})"
    return json.dumps(value, ensure_ascii=False, sort_keys=True, default=str)


def _row(change: Change) -> str:
    words = " ".join(
        word for word in (_VERBS.get(change.what, change.what), change.name and _code(change.name)) if word
    )
    cells: Iterable[str]
    if change.what == "node":
        words = "node"
        cells = (_about(side) if side else "" for side in (change.before, change.after))
    elif change.what in ("error", "unknown"):
        words, cells = change.what, (change.name or "" if change.kind == kind else "" for kind in ("removed", "added"))
    elif change.what in GROUPS.values():
        whole = change.kind != "changed"
        cells = ((_endpoint(side) if whole else _qos(side)) if side else "" for side in (change.before, change.after))
    else:
        present = ((change.before, change.kind != "added"), (change.after, change.kind != "removed"))
        cells = (_value(side) if there else "" for side, there in present)
    before, after = (_code(cell) if cell else "" for cell in cells)
    return f"| {_SIGNS[change.kind]} | {_code(change.node) if change.node else ''} | {words} | {before} | {after} |"


def _qos(side: Mapping[str, Any]) -> str:
    return ", ".join(f"{key} {_value(value)}" for key, value in side.items())


def _code(text: str) -> str:
    """Text in a table's cell, to be shown as it is."""
    return code(" ".join(text.split()).replace("|", "\\|"))
