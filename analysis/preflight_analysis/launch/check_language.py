"""Tags and attributes that the roslaunch XML language does not know, wherever they stand in a file."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from preflight_analysis.documents.span import Span
from preflight_analysis.launch.model import Action, LaunchFile
from preflight_analysis.launch.schema_ros1 import ANNOTATIONS, TAGS

_DEFUNCT = {"launch": ("master",), "group": ("master",)}
"""Accepted in silence, without meaning since ROS Fuerte."""

_LOWER_CASED = ("node", "test", "include")
"""roslaunch compares the tags in these without regard to case, those elsewhere exactly."""


@dataclass(frozen=True, slots=True)
class LanguageProblem:
    """As `evaluation.tree.Problem`, for what does not depend on any context."""

    kind: str
    span: Span
    data: Mapping[str, Any]


def check_language(launch_file: LaunchFile) -> Iterator[LanguageProblem]:
    """Everything in the file that roslaunch would skip or complain of, in document order."""
    if launch_file.root is not None:
        yield from _check(launch_file.root)


def _check(action: Action) -> Iterator[LanguageProblem]:
    kind = action.kind if action.kind in TAGS else action.kind.lower()
    tag = TAGS[kind]
    for attribute in action.attributes:
        # What is refused is reported when the tag is evaluated, where it stops the launch.
        if attribute.name not in (*tag.attributes, *tag.refused):
            data = {"name": attribute.name, "tag": kind, "allowed": list(tag.attributes)}
            yield LanguageProblem("unknown-attribute", attribute.name_span, data)
    annotations = ANNOTATIONS if kind in ("node", "test") else ()
    for child in action.children:
        name = child.kind.lower() if kind in _LOWER_CASED else child.kind
        if name in annotations or name in _DEFUNCT.get(kind, ()) or name in tag.refused:
            continue
        if name in tag.children:
            yield from _check(child)
        elif kind == "include" and name in TAGS:
            yield LanguageProblem("ignored-child", child.kind_span, {"tag": name, "parent": kind})
        else:
            data = {"tag": child.kind, "parent": kind, "allowed": list(tag.children)}
            yield LanguageProblem("unknown-element", child.kind_span, data)
