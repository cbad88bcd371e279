"""What can be written at a cursor in a Python launch file: in texts, and as keywords of calls of launch.

The names come from the same sources as in the other formats; the Python language server next door has the rest.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace

from preflight_analysis.documents.span import Span
from preflight_analysis.launch.model import LaunchFile
from preflight_analysis.launch.python_tree import arguments
from preflight_analysis.launch.schema import Kind
from preflight_analysis.queries.arguments import accepted, argument_values, resolved
from preflight_analysis.queries.call_python import complete_keywords
from preflight_analysis.queries.completion_items import Completion, Item
from preflight_analysis.queries.completion_paths import listed
from preflight_analysis.queries.completion_values import Asked, Lookup, argument_detail, argument_doc, whole_values
from preflight_analysis.queries.cursor_python import PythonKind, PythonPlace, place_at_python
from preflight_analysis.workspace.facts import ArgDeclaration
from preflight_analysis.workspace.workspace import Analysis

_SUFFIXES: Mapping[PythonKind, tuple[str, ...]] = {
    "launch-file": (".py", ".xml", ".yaml", ".yml", ".launch"),
    "yaml-file": (".yaml", ".yml"),
}
_KINDS: Mapping[PythonKind, Kind] = {
    "package": "package",
    "executable": "executable",
    "component": "component",
    "namespace": "namespace",
    "variable": "variable",
    "argument": "argument",
    "parameter": "parameter",
    "remap-from": "remap-from",
    "remap-to": "remap-to",
}


def complete_python(
    analysis: Analysis,
    launch_file: LaunchFile,
    offset: int,
    lookup: Lookup,
    trigger: str | None = None,
) -> Completion | None:
    """What can be written at `offset`, best first; None where it is not ours to say. As in `completion.complete`,
    `launch_file` is the text as it is now, and `analysis` may be one of an earlier text."""
    document = launch_file.document
    if trigger not in (None, "'", '"', "/", "("):
        return None
    found = place_at_python(document.text, offset) if trigger != "(" else None
    if found is None:
        return complete_keywords(document.text, offset) if trigger in (None, "(") else None
    word, kind = found.place.word, found.kind
    typed = document.text[word.start : offset]
    if kind in ("launch-file", "yaml-file", "file"):
        folder, slash, _ = typed.rpartition("/")
        span = Span(word.start + len(folder) + len(slash), word.end)
        return Completion(span, tuple(_paths(analysis, document.path, found, folder + slash)))
    if trigger == "/" and kind not in ("remap-from", "remap-to", "namespace"):
        return None
    if kind == "choice":
        return Completion(word, tuple(Item("value", each, each) for each in found.choices))
    if kind == "used":
        return Completion(word, tuple(_arguments(analysis, document.path, found)))
    asked = Asked(analysis, launch_file, offset, found.place, lookup)
    return Completion(word, tuple(_below(whole_values(asked, _KINDS[kind]), found.before)))


def _below(items: Iterable[Item], outer: str) -> Iterator[Item]:
    """Names without what the maps around them say already."""
    for item in items:
        if item.label.startswith(outer):
            name = item.label[len(outer) :]
            yield replace(item, label=name, text=name)


def _paths(analysis: Analysis, file: str, found: PythonPlace, folder: str) -> Iterator[Item]:
    where = resolved(analysis, file, found.before + folder)
    if where is not None and where.startswith("/"):
        written = (found.before + folder).rstrip("/")
        yield from listed(analysis.context, written, where, _SUFFIXES.get(found.kind, ()))


def _arguments(analysis: Analysis, file: str, found: PythonPlace) -> Iterator[Item]:
    """What this file declares: as it is written now, and as it was when the file was run."""
    declared = {each.name: each for each in _declared(found)}
    known = analysis.launch_files.get(file)
    for each in accepted(known) if known is not None else ():
        declared.setdefault(each.name, each)
    values = argument_values(analysis, file)
    for each in declared.values():
        value = values.get(each.name)
        detail = f"= {value}" if value is not None else argument_detail(each)
        yield Item("argument", each.name, each.name, argument_doc(each), detail)


def _declared(found: PythonPlace) -> Iterator[ArgDeclaration]:
    tree = found.tree
    for call in tree.calls("DeclareLaunchArgument"):
        given = arguments(call)
        name = given.get("name", given.get("0"))
        text = tree.launch_text(name) if name is not None else None
        if name is None or text is None:
            continue
        default, doc = given.get("default_value"), given.get("description")
        shown = (tree.launch_text(default) or "…") if default is not None else None
        yield ArgDeclaration(text, shown, None, tree.launch_text(doc) if doc is not None else None, tree.span(name))
