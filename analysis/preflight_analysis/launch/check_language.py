"""Tags and attributes that the roslaunch XML language does not know, wherever they stand in a file."""

from __future__ import annotations

import re
from collections.abc import Iterator

from preflight_analysis.documents.document import Element, Text
from preflight_analysis.documents.movable import moved
from preflight_analysis.documents.span import Span
from preflight_analysis.incremental.derived import derived
from preflight_analysis.launch.model import Action, LaunchFile, Literal, Value
from preflight_analysis.launch.problems import (
    IgnoredChild,
    LanguageProblem,
    StrayText,
    SubstitutionAsText,
    UnknownAttribute,
    UnknownElement,
)
from preflight_analysis.launch.schema_ros1 import ANNOTATIONS, TAGS
from preflight_analysis.launch.substitutions import COMMANDS_ROS1
from preflight_analysis.launch.xml_actions import MAX_DEPTH

_DEFUNCT = {"launch": ("master",), "group": ("master",)}
"""Accepted in silence, without meaning since ROS Fuerte."""

_LOWER_CASED = ("node", "test", "include")
"""roslaunch compares the tags in these without regard to case, those elsewhere exactly."""

_COMMANDS = "(?:" + "|".join(COMMANDS_ROS1) + ")"
_BARE = re.compile(r"(?<![$\w])\((?:arg|find) [A-Za-z]\w*\)")
_MEANT = re.compile(
    rf"\$(?:[{{\[](?P<braces>{_COMMANDS}(?: [^\]}}]*)?)[\]}}]"
    rf"|(?P<word>{_COMMANDS}\([^)]*)\)"
    rf"|\((?P<open>{_COMMANDS}\b(?: +[\w.-]*)?)(?=[^)]*\Z))"
)
"""`${arg x}` and `$[arg x]`, `$arg(x)`, and `$(arg x` without an end."""


def check_language(launch_file: LaunchFile) -> Iterator[LanguageProblem]:
    """Everything in the file that roslaunch would skip or complain of, in document order."""
    if launch_file.root is not None:
        yield from _check(launch_file.root, whole=True)
        # While a tag is being typed the rest of the file may be text for a moment.
        if not launch_file.document.problems and launch_file.root.gather(_stray_text):
            yield from _stray_texts(launch_file.document.root)


def _stray_text(action: Action) -> tuple[str, ...]:
    text = action.body.text
    return () if not text or _reads_text(action.kind) or text.isspace() else (text,)


def _reads_text(tag: str) -> bool:
    known = TAGS.get(tag) or TAGS.get(tag.lower())
    return known is not None and known.text


def _stray_texts(element: Element | None, depth: int = 0) -> Iterator[LanguageProblem]:
    """Text between tags, which means something in `<rosparam>` only."""
    if element is None or _reads_text(element.tag) or depth > MAX_DEPTH:
        return
    for child in element.children:
        if isinstance(child, Element):
            yield from _stray_texts(child, depth + 1)
        elif isinstance(child, Text) and (text := child.content.text.strip()):
            start = child.content.text.index(text)
            line = text.split("\n", 1)[0].rstrip()
            span = child.content.slice_span(start, start + len(line))
            yield LanguageProblem(StrayText(line, element.tag), span)


def _taken_as_text(value: Value) -> Iterator[LanguageProblem]:
    """What was meant as a substitution and is none: never closed, or with the wrong brackets."""
    for part in value.parts:
        if isinstance(part, Literal) and "$" in part.text:
            for found in _MEANT.finditer(part.text):
                exact = part.span.end - part.span.start == len(part.text)
                start = part.span.start
                span = Span(start + found.start(), start + found.end()) if exact else part.span
                inner = (found["braces"] or found["open"] or found["word"].replace("(", " ", 1)).strip()
                yield LanguageProblem(SubstitutionAsText(found[0], f"$({inner})"), span)


def _without_dollar(value: Value) -> Iterator[LanguageProblem]:
    """What would be a substitution with a `$` before it."""
    for part in value.parts:
        for found in _BARE.finditer(part.text) if isinstance(part, Literal) else ():
            exact = part.span.end - part.span.start == len(part.text)
            start = part.span.start
            span = Span(start + found.start(), start + found.end()) if exact else part.span
            yield LanguageProblem(SubstitutionAsText(found[0], f"${found[0]}"), span)


_OF_XML = ("xmlns", "xsi:")
"""How the attributes begin by which editors find the schema of a file."""


@derived
def _checked(action: Action) -> tuple[LanguageProblem, ...]:
    return tuple(_check(action))


def _check(action: Action, *, whole: bool = False) -> Iterator[LanguageProblem]:
    kind = action.kind if action.kind in TAGS else action.kind.lower()
    tag = TAGS[kind]
    for attribute in action.attributes:
        # What is refused is reported when the tag is evaluated, where it stops the launch.
        if attribute.name not in (*tag.attributes, *tag.refused) and not attribute.name.startswith(_OF_XML):
            unknown = UnknownAttribute(attribute.name, kind, tuple(tag.attributes))
            yield LanguageProblem(unknown, attribute.name_span)
        if "$" in attribute.value.text:
            yield from _taken_as_text(attribute.value)
        if attribute.name != "doc" and ("(arg " in attribute.value.text or "(find " in attribute.value.text):
            yield from _without_dollar(attribute.value)
    annotations = ANNOTATIONS if kind in ("node", "test") else ()
    for child in action.children:
        name = child.kind.lower() if kind in _LOWER_CASED else child.kind
        if name in annotations or name in _DEFUNCT.get(kind, ()) or name in tag.refused:
            continue
        if name in tag.children:
            # What is right below the root and an edit has only moved is as it was.
            yield from moved(_checked(child.original), child.moved_by) if whole else _check(child)
        elif kind == "include" and name in TAGS:
            yield LanguageProblem(IgnoredChild(name, kind), child.kind_span)
        else:
            yield LanguageProblem(UnknownElement(child.kind, kind, tuple(tag.children)), child.kind_span)
