"""What can be written at a cursor: elements, attributes and end tags by the schema of the language.

What can stand in a value is in `completion_values`. The kind of place comes from the text as it is now, facts (which
packages there are, what a node subscribes to) from an analysis that may be older.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from preflight_analysis.documents.span import Span
from preflight_analysis.launch.model import LaunchFile
from preflight_analysis.launch.recognize import is_yaml
from preflight_analysis.launch.schema import Attribute
from preflight_analysis.queries.completion_annotation import annotation_place, complete_annotation
from preflight_analysis.queries.completion_handed_over import complete_handed_over
from preflight_analysis.queries.completion_items import Completion, Item
from preflight_analysis.queries.completion_python import complete_python
from preflight_analysis.queries.completion_values import Asked, Lookup, complete_value
from preflight_analysis.queries.completion_writing import Writing, XmlWriting, YamlWriting
from preflight_analysis.queries.cursor import Place, is_closed
from preflight_analysis.queries.handed_over import is_handed_over
from preflight_analysis.queries.language import Language, language_of, place_in
from preflight_analysis.queries.param_file_completion import complete_param_file
from preflight_analysis.queries.param_files import is_param_file
from preflight_analysis.workspace.workspace import Analysis

TRIGGERS = ("<", " ", '"', "'", "/", "$", "(", ":", ">")
"""Characters after which an editor should ask by itself."""


def complete(
    analysis: Analysis,
    launch_file: LaunchFile,
    offset: int,
    lookup: Lookup,
    trigger: str | None = None,
) -> Completion | None:
    """What can be written at `offset` of a file, best first; None where nothing can.

    `launch_file` is the text as it is now, `analysis` may be one of an earlier text. `trigger` is the character of
    `TRIGGERS` that was just typed, None where the user asked.
    """
    found = _completed(analysis, launch_file, offset, lookup, trigger)
    if found is None or not launch_file.document.text.startswith("/", found.span.end):
        return found
    # A folder brings its slash along, unless that is there already.
    items = (replace(each, text=each.text.rstrip("/")) if each.kind == "folder" else each for each in found.items)
    return Completion(found.span, tuple(items))


def _completed(
    analysis: Analysis,
    launch_file: LaunchFile,
    offset: int,
    lookup: Lookup,
    trigger: str | None,
) -> Completion | None:
    if is_handed_over([analysis], launch_file.path):
        return complete_handed_over(analysis, launch_file.document, offset, trigger)
    annotation = annotation_place(launch_file, offset)
    if annotation is not None:
        return complete_annotation(lookup.ahead_of_runs(analysis), launch_file, annotation, trigger)
    if trigger == ">":
        return _closing(launch_file, offset) if _is_xml(launch_file) else None
    if is_param_file(analysis, launch_file.path):
        return complete_param_file(lookup.ahead_of_runs(analysis), launch_file.document, offset, trigger)
    if launch_file.is_python:
        return complete_python(analysis, launch_file, offset, lookup, trigger)
    place = place_in(launch_file, offset)
    if place is None:
        return None
    if is_yaml(launch_file.path):
        if place.kind == "attribute" and trigger is not None:
            return None  # blanks indent there
        trigger = _as_in_xml(place, trigger)
    if not _wanted(place, trigger):
        return None
    if place.kind == "value":
        return complete_value(Asked(analysis, launch_file, offset, place, lookup), trigger)
    return Completion(place.word, tuple(_items(launch_file, place)))


def _is_xml(launch_file: LaunchFile) -> bool:
    return not launch_file.is_python and not is_yaml(launch_file.path)


def _closing(launch_file: LaunchFile, offset: int) -> Completion | None:
    """The end tag of the start tag that was just typed, behind the cursor; None where there is one."""
    place = place_in(launch_file, offset)
    parent = place.parent if place is not None else None
    text = launch_file.document.text
    if parent is None or parent.open_span.end != offset or text[:offset].endswith("/>") or is_closed(text, parent):
        return None
    end = f"</{parent.tag}>"
    return Completion(Span(offset, offset), (Item("end-tag", end, end, snippet=f"$0{end}"),))


def _as_in_xml(place: Place, trigger: str | None) -> str | None:
    """Of what is typed in YAML the blank begins a value or, after a dash, an entity."""
    if trigger != " " or place.word.start != place.word.end:
        return trigger
    return {"value": '"', "element": "<"}.get(place.kind, trigger)


def _wanted(place: Place, trigger: str | None) -> bool:
    """Whether that character means that something is asked for: blanks are also typed to indent."""
    match place.kind:
        case "element":
            return trigger in (None, "<")
        case "end-tag":
            return trigger in (None, "/")
        case "attribute":
            return trigger in (None, " ")
        case "content":
            return trigger is None
    return True


def _items(launch_file: LaunchFile, place: Place) -> Iterator[Item]:
    document, language = launch_file.document, language_of(launch_file)
    writing: Writing = YamlWriting(language) if is_yaml(launch_file.path) else XmlWriting(language)
    match place.kind:
        case "end-tag":
            if place.parent is not None:
                close = ">" if not document.text.startswith(">", place.word.end) else ""
                yield Item("end-tag", f"{place.parent.tag}>", place.parent.tag + close)
        case "attribute":
            yield from writing.attributes(document, place, tuple(_attributes(language, place)))
        case "element" | "content":
            yield from writing.elements(document, place, _elements(language, launch_file, place))


def _elements(language: Language, launch_file: LaunchFile, place: Place) -> tuple[str, ...]:
    """The elements that the launcher reads at a place."""
    if place.parent is None:
        root = launch_file.document.root
        return ("launch",) if root is None or root.tag not in language.tags else ()
    tag = language.tag(place.parent.tag)
    return tag.children if tag is not None else ()


def _attributes(language: Language, place: Place) -> Iterator[Attribute]:
    """The attributes that the element at a place does not have yet and can have."""
    element = place.element
    tag = language.tag(element.tag) if element is not None else None
    if element is None or tag is None:
        return
    present = {a.name for a in element.attributes if a is not place.attribute}
    excluded = {"unless"} if "if" in present else {"if"} if "unless" in present else set[str]()
    for group in language.excludes.get(element.tag.lower(), ()):
        if not present.isdisjoint(group):
            excluded.update(group)
    if place.parent is not None and place.parent.tag.lower() == "include" and element.tag.lower() == "arg":
        excluded |= language.only_declared
    for attribute in tag.attributes.values():
        if attribute.name not in present and attribute.name not in excluded:
            yield attribute
