"""XML elements to actions: what the XML frontends of both generations share."""

from __future__ import annotations

from collections.abc import Callable

from preflight_analysis.documents.document import Comment, Element, SpannedText, Text
from preflight_analysis.documents.span import Span
from preflight_analysis.incremental.derived import derived
from preflight_analysis.launch.model import Action, ActionAttribute, Value

ParseValue = Callable[[SpannedText], Value]

MAX_DEPTH = 100
"""Elements nested deeper than this are left out; real launch files stay below ten."""


def action_of(element: Element, parse_value: ParseValue) -> Action:
    """The action of an element and those below it; `parse_value`, a pure function, cuts its values into pieces."""
    return _action_of(element, parse_value, 0)


def _action_of(element: Element, parse_value: ParseValue, depth: int) -> Action:
    comments: list[SpannedText] = []
    children: list[Action] = []
    texts: list[Text] = []
    for child in element.children:
        if isinstance(child, Element):
            if depth == 0:
                # Of one that an edit has only moved it is that of before.
                children.append(_action_below(child.original, parse_value).moved(child.moved_by))
            elif depth < MAX_DEPTH:
                children.append(_action_of(child, parse_value, depth + 1))
        elif isinstance(child, Comment):
            comments.append(child.content)
        elif isinstance(child, Text):
            texts.append(child)
    return Action(
        element.tag,
        element.tag_span,
        tuple([ActionAttribute(a.name, a.name_span, parse_value(a.value), a.span) for a in element.attributes]),
        tuple(children),
        tuple(comments),
        _body(texts, element, parse_value),
        element.open_span,
        element.span,
    )


@derived
def _action_below(element: Element, parse_value: ParseValue) -> Action:
    return _action_of(element, parse_value, 1)


def _body(texts: list[Text], element: Element, parse_value: ParseValue) -> Value:
    if len(texts) == 1:
        return parse_value(texts[0].content)
    if not texts:
        return Value("", Span(element.open_span.end, element.open_span.end), ())
    span = Span(texts[0].content.span.start, texts[-1].content.span.end)
    # Several pieces (CDATA, comments between): one text without a way back to single characters.
    return Value("".join([text.original.content.text for text in texts]), span, ())
