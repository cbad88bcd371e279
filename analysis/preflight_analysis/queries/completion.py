"""What can be written at a cursor: elements, attributes and end tags by the schema of the language.

What can stand in a value is in `completion_values`. The kind of place comes from the text as it is now, facts (which
packages there are, what a node subscribes to) from an analysis that may be older.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from preflight_analysis.documents.document import Document, Element
from preflight_analysis.evaluation.files import Files
from preflight_analysis.launch.model import LaunchFile
from preflight_analysis.launch.schema import Attribute
from preflight_analysis.launch.schema_ros1 import TAGS
from preflight_analysis.queries.completion_items import Completion, Item
from preflight_analysis.queries.completion_values import Asked, complete_value
from preflight_analysis.queries.cursor import Place, is_closed, place_at
from preflight_analysis.queries.language import attribute_doc, tag_of
from preflight_analysis.rules.rule import ExecutableNames
from preflight_analysis.workspace.workspace import Analysis

TRIGGERS = ("<", " ", '"', "'", "/", "$", "(", ":")
"""Characters after which an editor should ask by itself."""

_ALSO_WRITTEN = {"arg": "default", "param": "value", "rosparam": "file"}
"""Attributes that are not required but nearly always there."""
_EXCLUDES = {
    "arg": (("default", "value"),),
    "param": (("value", "textfile", "binfile", "command"),),
}


def complete(
    analysis: Analysis,
    launch_file: LaunchFile,
    offset: int,
    files: Files,
    executables: ExecutableNames,
    trigger: str | None = None,
) -> Completion | None:
    """What can be written at `offset` of a file, best first; None where nothing can.

    `launch_file` is the text as it is now, `analysis` may be one of an earlier text. `trigger` is the character of
    `TRIGGERS` that was just typed, None where the user asked.
    """
    document = launch_file.document
    place = place_at(document, offset)
    if place is None or not _wanted(place, trigger):
        return None
    if place.kind == "value":
        return complete_value(Asked(analysis, launch_file, offset, place, files, executables), trigger)
    return Completion(place.word, tuple(_items(document, place)))


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


def _items(document: Document, place: Place) -> Iterator[Item]:
    following = document.text[place.word.end : place.word.end + 1]
    match place.kind:
        case "end-tag":
            if place.parent is not None:
                yield Item("end-tag", f"{place.parent.tag}>", place.parent.tag + (">" if following != ">" else ""))
        case "attribute" if place.element is not None:
            yield from _attributes(place.element, place, has_value=following == "=")
        case "element":
            goes_on = following in (">", "/") or (place.element is not None and bool(place.element.attributes))
            yield from _elements(place.parent, document, "", bare=goes_on)
            if place.parent is not None and not is_closed(document.text, place.parent):
                yield Item("end-tag", f"/{place.parent.tag}>", f"/{place.parent.tag}>")
        case "content":
            yield from _elements(place.parent, document, "<", bare=False)
            if place.parent is not None and not is_closed(document.text, place.parent):
                yield Item("end-tag", f"</{place.parent.tag}>", f"</{place.parent.tag}>")


def _elements(parent: Element | None, document: Document, less: str, *, bare: bool) -> Iterator[Item]:
    """The elements that roslaunch reads below `parent`, as templates unless more of the tag is there already."""
    if parent is None:
        names: Iterable[str] = ("launch",) if document.root is None or document.root.tag not in TAGS else ()
    else:
        tag = tag_of(parent)
        names = tag.children if tag is not None else ()
    for name in names:
        template = None if bare else less + _template(name, parent)
        yield Item("element", name, less + name, TAGS[name].doc, snippet=template)


def _template(name: str, parent: Element | None) -> str:
    """A snippet of the element with what it needs: `node pkg="$1" type="$2" name="$3"/>`."""
    if name in ("launch", "group"):
        return f"{name}>\n\t$0\n</{name}>"
    written = list(TAGS[name].required)
    if parent is not None and parent.tag.lower() == "include" and name == "arg":
        written.append("value")
    elif name in _ALSO_WRITTEN:
        written.append(_ALSO_WRITTEN[name])
    return name + "".join(f' {attribute}="${n}"' for n, attribute in enumerate(written, 1)) + "/>"


def _attributes(element: Element, place: Place, *, has_value: bool) -> Iterator[Item]:
    tag = tag_of(element)
    present = {a.name for a in element.attributes if a is not place.attribute}
    if tag is None:
        return
    excluded = {"unless"} if "if" in present else {"if"} if "unless" in present else set()
    for group in _EXCLUDES.get(element.tag.lower(), ()):
        if not present.isdisjoint(group):
            excluded.update(group)
    passed = place.parent is not None and place.parent.tag.lower() == "include"
    if passed and element.tag.lower() == "arg":
        excluded |= {"default", "doc"}
    for attribute in tag.attributes.values():
        if attribute.name not in present and attribute.name not in excluded:
            yield Item(
                "attribute",
                attribute.name,
                attribute.name if has_value else f'{attribute.name}=""',
                attribute_doc(attribute),
                "required" if attribute.required else "",
                snippet=None if has_value else f'{attribute.name}="{_tab_stop(attribute)}"',
            )


def _tab_stop(attribute: Attribute) -> str:
    """A place to type in, or to choose in: first what is not the default, which would not have to be written."""
    if attribute.kind not in ("choice", "flag"):
        return "$1"
    choices = sorted(attribute.choices, key=lambda choice: choice == attribute.default)
    return f"${{1|{','.join(choices)}|}}"
