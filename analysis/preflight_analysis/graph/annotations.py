"""What a launch file itself says of a node: `<topics>`, `<services>`, `<params>` and `<actions>` in its tag.

They stand there as elements, or in a comment, since roslaunch warns of elements that it does not know:

    <node pkg="p" type="t" name="n">
      <!-- <topics><topic name="chatter" type="std_msgs/String" class="sub"/></topics> -->
    </node>

An annotation is the user's word for all that a node does. It is used where no run tells better.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from xml.sax.saxutils import quoteattr

from preflight_analysis.documents.document import Document, Element
from preflight_analysis.documents.span import Span
from preflight_analysis.documents.xml import parse_xml
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.findings.finding import Edit
from preflight_analysis.findings.insertion import insert_child
from preflight_analysis.graph.actions import actions_of
from preflight_analysis.launch.model import Action
from preflight_analysis.tracing.interface import Endpoint, Interface, Outcome, ParamUse, Role

_CLASSES: Mapping[str, Mapping[str, Role]] = {
    "topics": {"pub": "publisher", "sub": "subscriber"},
    "services": {"server": "service", "client": "client"},
    "actions": {"server": "action_server", "client": "action_client"},
}
_ITEMS = {"topics": "topic", "services": "service", "actions": "action", "params": "param"}
_ATTRIBUTES = {
    "topic": ("name", "type", "class"),
    "service": ("name", "type", "class"),
    "action": ("name", "type", "class"),
    "param": ("name", "default"),
}
GROUPS = tuple(_ITEMS)
"""The tags that hold an annotation."""

_WRAPPER = "<_>"
_STARTS_ANNOTATION = re.compile(rf"\s*<({'|'.join(GROUPS)})\b")
_TYPE = re.compile(r"[A-Za-z]\w*/[A-Za-z]\w*\Z|\*\Z")


@dataclass(frozen=True, slots=True)
class AnnotationProblem:
    """Something in an annotation that cannot be understood; that item is left out. `span` is of the launch file."""

    message: str
    span: Span


@dataclass(frozen=True, slots=True)
class _Tag:
    """An element, from the launch file itself or from the text of a comment."""

    name: str
    name_span: Span
    attributes: tuple[tuple[str, str, Span], ...]
    """Name, value and the span of the value."""
    head: Span
    children: tuple[_Tag, ...]


def read_annotation(action: Action) -> tuple[Interface | None, tuple[AnnotationProblem, ...]]:
    """The interface that is annotated in a node's tag, None if there is no annotation, and what is malformed in it."""
    problems: list[AnnotationProblem] = []
    groups = [_from_action(child) for child in action.children if child.kind in GROUPS]
    for text, span in action.comments:
        if _STARTS_ANNOTATION.match(text):
            groups.extend(_from_comment(text, span.start, problems))
    if not groups and not problems:
        return None, ()
    endpoints: list[Endpoint] = []
    params: list[ParamUse] = []
    for group in groups:
        if group.name not in GROUPS:
            problems.append(AnnotationProblem(f"<{group.name}> is no annotation; {_one_of(GROUPS)}", group.name_span))
            continue
        for item in group.children:
            if item.name != _ITEMS[group.name]:
                message = f"<{group.name}> holds <{_ITEMS[group.name]}>, not <{item.name}>"
                problems.append(AnnotationProblem(message, item.name_span))
                continue
            read = _read_item(group.name, item, problems)
            if isinstance(read, Endpoint):
                endpoints.append(read)
            elif read is not None:
                params.append(read)
    interface = Interface("annotation", Outcome("not-run"), tuple(endpoints), tuple(params))
    return interface, tuple(problems)


def read_item(
    group: str, head: Span, attributes: Sequence[tuple[str, str, Span]], problems: list[AnnotationProblem]
) -> Endpoint | ParamUse | None:
    """One item of a group (`topics`), written elsewhere than in a tag; None after saying what is wrong with it."""
    return _read_item(group, _Tag(_ITEMS[group], head, tuple(attributes), head, ()), problems)


def annotated_names(action: Action) -> Iterator[tuple[str, str, Span]]:
    """What the annotation of a node's tag names, and where: the tag of the item (`topic`), the name, its place."""
    groups = [_from_action(child) for child in action.children if child.kind in GROUPS]
    for text, span in action.comments:
        if _STARTS_ANNOTATION.match(text):
            groups.extend(_from_comment(text, span.start, []))
    for group in groups:
        for item in group.children:
            for name, value, span in item.attributes:
                if name == "name" and item.name == _ITEMS.get(group.name):
                    yield item.name, value, span


def annotated(traced: Interface, action: Action) -> Interface:
    """`traced`, or where the run did not reach the event loop, what it saw together with what `action` annotates."""
    if traced.complete:
        return traced
    annotation, _ = read_annotation(action)
    if annotation is None:
        return traced
    return traced.with_more("annotation", annotation.endpoints, annotation.params)


def annotation_text(interface: Interface, indent: str = "") -> str:
    """A comment that annotates `interface`, its lines after the first indented by `indent`; without a final newline.

    What every node has by its client library, and what was found after a made-up answer, is left out. Names are as
    the node gave them. Empty when there is nothing to write.
    """
    actions = actions_of(interface.endpoints)
    parts = {id(topic) for action in actions for topic in action.topics}
    endpoints = [e for e in interface.endpoints if id(e) not in parts and not e.role.startswith("action_")]
    endpoints += [action.endpoint for action in actions]
    blocks: list[tuple[str, list[str]]] = []
    for group, classes in _CLASSES.items():
        words = {role: word for word, role in classes.items()}
        items = sorted(
            {
                (word, e.name, e.type or "*")
                for e in endpoints
                if (word := words.get(e.role)) is not None and not e.builtin and not e.speculative
            }
        )
        tag = _ITEMS[group]
        blocks.append(
            (group, [f"<{tag} name={_quoted(n)} type={_quoted(t)} class={_quoted(w)}/>" for w, n, t in items])
        )
    reads = sorted({p.name for p in interface.params if p.access in ("get", "has") and not p.builtin})
    blocks.append(("params", [f"<param name={_quoted(name)}/>" for name in reads]))
    lines: list[str] = []
    for group, items_text in blocks:
        if items_text:
            lines += [f"<{group}>", *(f"  {item}" for item in items_text), f"</{group}>"]
    if not lines:
        return ""
    return f"\n{indent}".join(["<!--", *(f"  {line}" for line in lines), "-->"])


def annotation_edit(node: LaunchNode, interface: Interface, document: Document) -> Edit | None:
    """The edit that writes `interface` into the tag of `node`, opening `<node .../>` if need be.

    `document` is the file of the node's tag. None if there is nothing to write or an annotation stands there already.
    """
    if read_annotation(node.action)[0] is not None:
        return None
    text = annotation_text(interface)
    return insert_child(node.action, document, text) if text else None


def _from_action(action: Action) -> _Tag:
    return _Tag(
        action.kind,
        action.kind_span,
        tuple((a.name, a.value.text, a.value.span) for a in action.attributes),
        action.head_span,
        tuple(_from_action(child) for child in action.children),
    )


def _from_comment(text: str, offset: int, problems: list[AnnotationProblem]) -> Iterator[_Tag]:
    wrapped = parse_xml("", f"{_WRAPPER}{text}</_>")
    offset -= len(_WRAPPER)
    end = offset + len(_WRAPPER) + len(text)
    for problem in wrapped.problems:
        span = _moved(problem.span, offset)
        problems.append(AnnotationProblem(problem.message, Span(min(span.start, end), min(span.end, end))))
    if wrapped.root is not None:
        for child in wrapped.root.elements:
            yield _from_element(child, offset)


def _from_element(element: Element, offset: int) -> _Tag:
    return _Tag(
        element.tag,
        _moved(element.tag_span, offset),
        tuple((a.name, a.value.text, _moved(a.value.span, offset)) for a in element.attributes),
        _moved(element.open_span, offset),
        tuple(_from_element(child, offset) for child in element.elements),
    )


def _moved(span: Span, offset: int) -> Span:
    return Span(span.start + offset, span.end + offset)


def _read_item(group: str, item: _Tag, problems: list[AnnotationProblem]) -> Endpoint | ParamUse | None:
    """The item, or None after saying what is wrong with it."""
    given = {name: (value, span) for name, value, span in item.attributes}
    found: list[AnnotationProblem] = []
    allowed = _ATTRIBUTES[item.name]
    found += [
        AnnotationProblem(f"attribute '{name}' is not read here; {_one_of(allowed)}", span)
        for name, (_, span) in given.items()
        if name not in allowed
    ]
    name, name_span = given.get("name", ("", item.head))
    if not name:
        found.append(AnnotationProblem(f"<{item.name}> needs a name", name_span))
    elif not names.is_legal(name):
        found.append(AnnotationProblem(f"'{name}' is not a name; substitutions are not evaluated here", name_span))
    if group == "params":
        problems += found
        default = given.get("default")
        if found:
            return None
        return ParamUse(name, "get", default[0] if default else None, default is not None)
    type_, type_span = given.get("type", (None, item.head))
    if type_ is not None and not _TYPE.match(type_):
        found.append(AnnotationProblem(f"'{type_}' is not a type; write package/Name, or * for any", type_span))
    classes = _CLASSES[group]
    class_, class_span = given.get("class", (None, item.head))
    if class_ is None:
        found.append(AnnotationProblem(f"<{item.name}> needs a class; {_one_of(tuple(classes))}", class_span))
    elif class_ not in classes:
        found.append(AnnotationProblem(f"class '{class_}' is not known; {_one_of(tuple(classes))}", class_span))
    problems += found
    if found or class_ is None:
        return None
    return Endpoint(classes[class_], name, type_)


def _one_of(words: Sequence[str]) -> str:
    return "allowed: " + ", ".join(words)


def _quoted(value: str) -> str:
    # A comment must not hold two hyphens in a row; no legal ROS name or type has one.
    return quoteattr(value, {'"': "&quot;"})
