"""Edits of the project settings file that leave alone what is written there, comments included."""

from __future__ import annotations

import os
from collections.abc import Iterator

import yaml

from preflight_analysis.documents.document import Document
from preflight_analysis.documents.reading import digest
from preflight_analysis.documents.span import LineIndex
from preflight_analysis.documents.yaml import CONSTRUCTION_ERRORS, compose
from preflight_analysis.edits.edit import Edit, applied
from preflight_analysis.edits.yaml import YamlWriter, scalar
from preflight_analysis.findings.severities import OFF, Severities
from preflight_analysis.workspace.project_settings import settings_of_text


def turn_off(folder: str, path: str, text: str, rule: str, file: str | None) -> Edit | None:
    """The edit of the settings of `folder` at `path`, whose text may be empty, that turns the rule off in `file`, or
    for None everywhere. None where the text is no settings file, or an entry that counts more says otherwise."""
    try:
        root = compose(text)
    except CONSTRUCTION_ERRORS:
        return None
    problems = len(settings_of_text(folder, text).problems)
    writer = YamlWriter(Document(path, text, digest(text), (), (), LineIndex(text)))
    for edit in _candidates(folder, writer, root, rule, file):
        changed = settings_of_text(folder, applied(text, [edit]))
        if len(changed.problems) <= problems and _is_off(changed.severities, rule, file):
            return edit
    return None


def _is_off(severities: tuple[Severities, ...], rule: str, file: str | None) -> bool:
    """Whether the last entry that speaks of the rule turns it off; for all files only those without a pattern count."""
    wanted = [each.of(rule) for each in severities if (each.speak_of(file) if file else each.pattern is None)]
    return [each for each in wanted if each is not None][-1:] == [OFF]


def _candidates(folder: str, writer: YamlWriter, root: yaml.Node | None, rule: str, file: str | None) -> Iterator[Edit]:
    if file is None:
        block, flow = f"severities:\n  {rule}: {OFF}", f"severities: {{{rule}: {OFF}}}"
        if isinstance(known := _value(root, "severities"), yaml.Node):
            yield from _set(writer, known, rule)
            return
        yield from writer.append(root, block, flow)
        return
    path = scalar(os.path.relpath(file, folder) if file.startswith(folder.rstrip("/") + "/") else file)
    off = f"severities: {{{rule}: {OFF}}}"
    paths = _value(root, "paths")
    if paths is None:
        yield from writer.append(root, f"paths:\n  - path: {path}\n    {off}", f"paths: [{{path: {path}, {off}}}]")
    elif isinstance(paths, yaml.SequenceNode):
        for item in paths.value:
            named, known = _value(item, "path"), _value(item, "severities")
            if isinstance(named, yaml.ScalarNode) and scalar(named.value) == path and known is not None:
                yield from _set(writer, known, rule)
        yield from writer.append(paths, f"- path: {path}\n  {off}", f"{{path: {path}, {off}}}")
    elif _is_null(paths):
        yield from writer.write_below(paths, f"\n  - path: {path}\n    {off}")


def _set(writer: YamlWriter, node: yaml.Node, rule: str) -> Iterator[Edit]:
    """Turn the rule off among these severities."""
    known = _value(node, rule)
    if known is not None:
        yield from writer.write_over(known, OFF)
    elif isinstance(node, yaml.MappingNode):
        yield from writer.append(node, f"{rule}: {OFF}", f"{rule}: {OFF}")
    elif _is_null(node):
        yield from writer.write_below(node, f"\n  {rule}: {OFF}")


def _value(node: yaml.Node | None, name: str) -> yaml.Node | None:
    """What a mapping has under a name."""
    pairs = node.value if isinstance(node, yaml.MappingNode) else ()
    return next((value for key, value in pairs if isinstance(key, yaml.ScalarNode) and key.value == name), None)


def _is_null(node: yaml.Node) -> bool:
    return isinstance(node, yaml.ScalarNode) and not node.value
