"""The frontend for ROS 1 launch files: Document to LaunchFile."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import compress

from preflight_analysis.documents.document import Document, Element
from preflight_analysis.incremental.derived import derived
from preflight_analysis.launch.model import LaunchFile
from preflight_analysis.launch.substitutions import parse_value
from preflight_analysis.launch.xml_actions import MAX_DEPTH, action_of


def read_ros1(document: Document) -> LaunchFile:
    """The launch file in `document`. Any text gives one; its root is None where there is no `<launch>`.

    As roslaunch does, the only `<launch>` element counts, wherever it stands.
    """
    found = list(_find_launch(document))
    root = action_of(found[0], parse_value) if found else None
    return LaunchFile(document.path, 1, root, document, tuple(element.tag_span for element in found[1:]))


def _find_launch(document: Document) -> Iterator[Element]:
    level = [child for child in document.children if isinstance(child, Element)]
    for depth in range(MAX_DEPTH):
        yield from (element for element in level if element.tag == "launch")
        level = [below for element in level for below in element.elements]
        if depth == 0:
            originals = [element.original for element in level]
            level = [*compress(level, map(_has_launch, originals))]
        if not level:
            return


@derived
def _has_launch(element: Element) -> bool:
    """Whether it, or an element below it, is a `<launch>`."""
    level = [element]
    while level and all(each.tag != "launch" for each in level):
        level = [below for each in level for below in each.elements]
    return bool(level)
