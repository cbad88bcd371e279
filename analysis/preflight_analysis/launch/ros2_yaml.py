"""The frontend for ROS 2's YAML launch files (`launch_yaml`): a map with one key is an entity, named by that key.

An entity's scalars and lists of scalars are its attributes; lists of maps are the entities that XML has as child
elements; `children`, or a list in place of the map, are the actions inside it.
"""

from __future__ import annotations

import yaml

from preflight_analysis.documents.document import Comment, Document, SpannedText
from preflight_analysis.documents.hash_comments import above
from preflight_analysis.documents.span import Span
from preflight_analysis.documents.yaml import CONSTRUCTION_ERRORS, YamlDocument, constructed, span_of
from preflight_analysis.launch.model import Action, ActionAttribute, LaunchFile, Literal, Typed, Value
from preflight_analysis.launch.substitutions_ros2 import parse_value_ros2

MAX_ACTIONS = 20_000
"""Entities of one file; aliases of aliases would otherwise make any number of them."""
MAX_DEPTH = 60


def read_ros2_yaml(parsed: YamlDocument) -> LaunchFile:
    """The launch file in a YAML text. Its root is None where there is no `launch:`."""
    return _Reader(parsed.document).file(parsed.node)


class _Reader:
    def __init__(self, document: Document) -> None:
        self._document = document
        self._comments = tuple(c for c in document.children if isinstance(c, Comment))
        self._actions = 0

    def file(self, node: yaml.Node | None) -> LaunchFile:
        root = None
        if isinstance(node, yaml.MappingNode):
            for key, value in node.value:
                if isinstance(key, yaml.ScalarNode) and key.value == "launch":
                    root = self._entity("launch", span_of(key), value, 0)
        return LaunchFile(self._document.path, 2, root, self._document)

    def _entity(self, kind: str, kind_span: Span, node: yaml.Node, depth: int) -> Action:
        attributes: list[ActionAttribute] = []
        children: list[Action] = []
        self._actions += 1
        if depth < MAX_DEPTH and self._actions < MAX_ACTIONS:
            if isinstance(node, yaml.SequenceNode):
                children += self._children(node, depth)
            elif isinstance(node, yaml.MappingNode):
                for key, value in node.value:
                    if isinstance(key, yaml.ScalarNode):
                        self._member(key, value, attributes, children, depth)
        end = max(kind_span.end, node.end_mark.index)
        stop = len(self._document.text[:end].rstrip()) if end > kind_span.end else end
        return Action(
            kind,
            kind_span,
            tuple(attributes),
            tuple(children),
            above(self._comments, self._document.lines, kind_span.start),
            Value("", Span(stop, stop), ()),
            kind_span,
            Span(kind_span.start, max(stop, kind_span.end)),
        )

    def _member(
        self,
        key: yaml.ScalarNode,
        value: yaml.Node,
        attributes: list[ActionAttribute],
        children: list[Action],
        depth: int,
    ) -> None:
        name, name_span = str(key.value), span_of(key)
        if name == "children" and isinstance(value, yaml.SequenceNode):
            children += self._children(value, depth)
        elif isinstance(value, yaml.SequenceNode) and any(isinstance(n, yaml.MappingNode) for n in value.value):
            children += [
                self._entity(name, _head(each, name_span), each, depth + 1)
                for each in value.value
                if isinstance(each, yaml.MappingNode)
            ]
        else:
            span = Span(name_span.start, max(name_span.end, value.end_mark.index))
            attributes.append(ActionAttribute(name, name_span, self._value(value), span))

    def _children(self, node: yaml.SequenceNode, depth: int) -> list[Action]:
        found = []
        for each in node.value:
            if isinstance(each, yaml.MappingNode):
                found += [
                    self._entity(str(key.value), span_of(key), value, depth + 1)
                    for key, value in each.value
                    if isinstance(key, yaml.ScalarNode)
                ]
            elif isinstance(each, yaml.ScalarNode) and each.value:
                # `- log` without a colon: while it is typed, or an action without attributes by mistake.
                found.append(self._entity(str(each.value), span_of(each), each, depth + 1))
        return found

    def _value(self, node: yaml.Node) -> Value:
        span = span_of(node)
        if isinstance(node, yaml.ScalarNode):
            typed = _scalar(node)
            if isinstance(typed, str):
                return parse_value_ros2(self._text(node))
            return Value(str(node.value), span, (Literal(str(node.value), span),), typed=Typed(typed))
        if isinstance(node, yaml.SequenceNode):
            items = [_scalar(each) if isinstance(each, yaml.ScalarNode) else None for each in node.value]
            text = self._document.text[span.start : span.end]
            return Value(text, span, (Literal(text, span),), typed=Typed(items))
        return Value("", span, (), typed=Typed(None))

    def _text(self, node: yaml.ScalarNode) -> SpannedText:
        """The text of a scalar with the way back to the file: exact in the usual case, in which each character stands
        for itself."""
        span, text = span_of(node), str(node.value)
        start, end = span
        if node.style in ("'", '"'):
            start, end = start + 1, end - 1
        if self._document.text[start:end] == text:
            return SpannedText(text, Span(start, end))
        return SpannedText(text, Span(start, end), _offsets(text, self._document.text, start, end))


def _head(node: yaml.Node, otherwise: Span) -> Span:
    """What a finding about an entity without a name of its own underlines: its first key."""
    if isinstance(node, yaml.MappingNode) and node.value:
        return span_of(node.value[0][0])
    return otherwise


def _scalar(node: yaml.ScalarNode) -> object:
    """What YAML makes of a scalar: a str, bool, int, float or None; text for what it cannot make (`!tag`, a date)."""
    if node.tag == "tag:yaml.org,2002:str":
        return str(node.value)
    try:
        value = constructed(node)
    except CONSTRUCTION_ERRORS:
        return str(node.value)
    return value if value is None or isinstance(value, (bool, int, float, str)) else str(node.value)


def _offsets(text: str, source: str, start: int, end: int) -> tuple[int, ...]:
    """Where each character of a folded or escaped scalar stands, found by going through both side by side."""
    offsets: list[int] = []
    at = start
    for character in text:
        found = source.find(character, at, min(end, at + 200)) if not character.isspace() else -1
        if found >= 0:
            at = found
        offsets.append(min(at, end))
        at = min(at + 1, end)
    return (*offsets, end)
