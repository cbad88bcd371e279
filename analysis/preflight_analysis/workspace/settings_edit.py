"""Edits of the project settings file that leave alone what is written there, comments included."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator

import yaml

from preflight_analysis.documents.span import Span
from preflight_analysis.documents.yaml import CONSTRUCTION_ERRORS, compose, span_of
from preflight_analysis.findings.severities import OFF, Severities
from preflight_analysis.workspace.project_settings import settings_of_text

_PLAIN = re.compile(r"[A-Za-z0-9_][\w./-]*")


def turn_off(folder: str, text: str, rule: str, file: str | None) -> tuple[Span, str] | None:
    """What to replace by what in the settings of `folder`, whose text may be empty, so that the rule is off in `file`,
    or for None everywhere. None where the text is no settings file, or an entry that counts more says otherwise."""
    try:
        root = compose(text)
    except CONSTRUCTION_ERRORS:
        return None
    problems = len(settings_of_text(folder, text).problems)
    newline = "\r\n" if "\r\n" in text else "\n"
    for span, lines in _candidates(folder, text, root, rule, file):
        written = lines.replace("\n", newline)
        changed = settings_of_text(folder, text[: span.start] + written + text[span.end :])
        if len(changed.problems) <= problems and _is_off(changed.severities, rule, file):
            return span, written
    return None


def _is_off(severities: tuple[Severities, ...], rule: str, file: str | None) -> bool:
    """Whether the last entry that speaks of the rule turns it off; for all files only those without a pattern count."""
    wanted: object = rule
    for each in severities:
        if rule in each.rules and (each.speak_of(file) if file is not None else each.pattern is None):
            wanted = each.rules[rule]
    return wanted is None


def _candidates(
    folder: str, text: str, root: yaml.Node | None, rule: str, file: str | None
) -> Iterator[tuple[Span, str]]:
    if file is None:
        block, flow = f"severities:\n  {rule}: {OFF}", f"severities: {{{rule}: {OFF}}}"
        if isinstance(known := _value(root, "severities"), yaml.Node):
            yield from _set(text, known, rule)
            return
        yield from _added(text, root, block, flow)
        return
    path = _scalar(os.path.relpath(file, folder) if file.startswith(folder.rstrip("/") + "/") else file)
    off = f"severities: {{{rule}: {OFF}}}"
    paths = _value(root, "paths")
    if paths is None:
        yield from _added(text, root, f"paths:\n  - path: {path}\n    {off}", f"paths: [{{path: {path}, {off}}}]")
    elif isinstance(paths, yaml.SequenceNode):
        for item in paths.value:
            named, known = _value(item, "path"), _value(item, "severities")
            if isinstance(named, yaml.ScalarNode) and _scalar(named.value) == path and known is not None:
                yield from _set(text, known, rule)
        dash = " " * paths.start_mark.column
        yield from _added(text, paths, f"- path: {path}\n{dash}  {off}", f"{{path: {path}, {off}}}")
    elif _is_null(paths):
        yield _below(text, paths, f"\n  - path: {path}\n    {off}")


def _set(text: str, node: yaml.Node, rule: str) -> Iterator[tuple[Span, str]]:
    """Turn the rule off among these severities."""
    known = _value(node, rule)
    if known is not None:
        yield span_of(known), OFF
    elif isinstance(node, yaml.MappingNode):
        yield from _added(text, node, f"{rule}: {OFF}", f"{rule}: {OFF}")
    elif _is_null(node):
        yield _below(text, node, f"\n  {rule}: {OFF}")


def _added(text: str, node: yaml.Node | None, block: str, flow: str) -> Iterator[tuple[Span, str]]:
    """One more entry behind those of a mapping or sequence; at the end of a text that has nothing yet."""
    if node is None:
        missing = "" if not text or text.endswith("\n") else "\n"
        yield Span(len(text), len(text)), f"{missing}{block}\n"
    elif isinstance(node, yaml.CollectionNode) and node.flow_style:
        end = node.end_mark.index - 1
        while text[end - 1].isspace():
            end -= 1
        comma = ", " if node.value else ""
        yield Span(end, end), comma + flow
    elif isinstance(node, yaml.CollectionNode):
        yield _below(text, _last(node), "\n" + " " * node.start_mark.column + block)


def _below(text: str, node: yaml.Node, written: str) -> tuple[Span, str]:
    """Written behind the line on which a node ends."""
    end = text.find("\n", node.end_mark.index)
    end = len(text) if end < 0 else end
    if text[end - 1 : end] == "\r":
        end -= 1
    return Span(end, end), written + ("" if end < len(text) else "\n")


def _last(node: yaml.Node) -> yaml.Node:
    """What is written last in a node: a block ends only where something else begins."""
    while isinstance(node, yaml.CollectionNode) and not node.flow_style and node.value:
        last = node.value[-1]
        node = last[1] if isinstance(last, tuple) else last
    return node


def _value(node: yaml.Node | None, name: str) -> yaml.Node | None:
    """What a mapping has under a name."""
    pairs = node.value if isinstance(node, yaml.MappingNode) else ()
    return next((value for key, value in pairs if isinstance(key, yaml.ScalarNode) and key.value == name), None)


def _is_null(node: yaml.Node) -> bool:
    return isinstance(node, yaml.ScalarNode) and not node.value


def _scalar(text: str) -> str:
    return text if _PLAIN.fullmatch(text) else "'" + text.replace("'", "''") + "'"
