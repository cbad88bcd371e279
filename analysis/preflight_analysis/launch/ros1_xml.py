"""The frontend for ROS 1 launch files: Document to LaunchFile."""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.documents.document import Comment, Document, Element, SpannedText, Text
from preflight_analysis.documents.span import Span
from preflight_analysis.launch.model import Action, ActionAttribute, LaunchFile, Value
from preflight_analysis.launch.substitutions import parse_value

MAX_DEPTH = 100
"""Elements nested deeper than this are left out; real launch files stay below ten."""


def read_ros1(document: Document) -> LaunchFile:
    """The launch file in `document`. Any text gives one; its root is None where there is no `<launch>`.

    As roslaunch does, the only `<launch>` element counts, wherever it stands.
    """
    found = list(_find_launch(document))
    root = _action(found[0], 0) if found else None
    return LaunchFile(document.path, 1, root, document, tuple(element.tag_span for element in found[1:]))


def _find_launch(document: Document) -> Iterator[Element]:
    level = [child for child in document.children if isinstance(child, Element)]
    for _ in range(MAX_DEPTH):
        yield from (element for element in level if element.tag == "launch")
        level = [below for element in level for below in element.elements]
        if not level:
            return


def _action(element: Element, depth: int) -> Action:
    comments: list[SpannedText] = []
    children: list[Action] = []
    texts: list[SpannedText] = []
    for child in element.children:
        if isinstance(child, Element):
            if depth < MAX_DEPTH:
                children.append(_action(child, depth + 1))
        elif isinstance(child, Comment):
            comments.append(child.content)
        elif isinstance(child, Text):
            texts.append(child.content)
    return Action(
        element.tag,
        element.tag_span,
        tuple([ActionAttribute(a.name, a.name_span, parse_value(a.value), a.span) for a in element.attributes]),
        tuple(children),
        tuple(comments),
        _body(texts, element),
        element.open_span,
        element.span,
    )


def _body(texts: list[SpannedText], element: Element) -> Value:
    if len(texts) == 1:
        return parse_value(texts[0])
    if not texts:
        return Value("", Span(element.open_span.end, element.open_span.end), ())
    span = Span(texts[0].span.start, texts[-1].span.end)
    # Several pieces (CDATA, comments between): one text without a way back to single characters.
    return Value("".join(t.text for t in texts), span, ())
