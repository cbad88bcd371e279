"""What a launch file itself says of a node: `<topics>`, `<services>`, `<params>` and `<actions>` in its tag.

They stand there as elements, or in a comment, since roslaunch warns of elements that it does not know:

    <node pkg="p" type="t" name="n">
      <!-- <topics><topic name="chatter" type="std_msgs/String" class="sub"/></topics> -->
    </node>

In YAML and Python they stand in a comment right above the node: `# preflight: <topics>...</topics>`.

An annotation is the user's word for all that a node does. It is used where no run tells better.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import lru_cache

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.document import Document, Element, SpannedText
from preflight_analysis.documents.span import Span
from preflight_analysis.documents.xml import parse_xml
from preflight_analysis.documents.xml_text import quoted_attribute
from preflight_analysis.edits.edit import Edit
from preflight_analysis.edits.writer import writer_of
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.findings.printable import printable
from preflight_analysis.graph.actions import actions_of
from preflight_analysis.incremental.derived import derived
from preflight_analysis.launch.model import Action
from preflight_analysis.tracing.interface import Endpoint, Interface, Outcome, ParamUse, Role

CLASSES: Mapping[str, Mapping[str, Role]] = {
    "topics": {"pub": "publisher", "sub": "subscriber"},
    "services": {"server": "service", "client": "client"},
    "actions": {"server": "action_server", "client": "action_client"},
}
"""What a class means in each group; parameters have none."""
ITEMS: Mapping[str, str] = {"topics": "topic", "services": "service", "actions": "action", "params": "param"}
"""The tag of an item in each group."""
ATTRIBUTES: Mapping[str, tuple[str, ...]] = {
    "topic": ("name", "type", "class"),
    "service": ("name", "type", "class"),
    "action": ("name", "type", "class"),
    "param": ("name", "default"),
}
"""The attributes of each item."""
GROUPS = tuple(ITEMS)
"""The tags that hold an annotation."""

_WRAPPER = "<_>"
_STARTS_ANNOTATION = re.compile(rf"\s*<({'|'.join(GROUPS)})\b")
_TYPE = re.compile(r"(?:[A-Za-z]\w*/(?:(?:msg|srv|action)/)?)?[A-Za-z]\w*\Z|\*\Z")
"""Without a package it is that of the known package that has it (`graph/bare_types.py`)."""


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
    span: Span
    children: tuple[_Tag, ...]


@dataclass(frozen=True, slots=True)
class AnnotatedItem:
    """One endpoint or parameter of an annotation, with the spans of its element and of the values of its attributes."""

    what: Endpoint | ParamUse
    span: Span
    values: Mapping[str, Span]


@dataclass(frozen=True, slots=True)
class AnnotatedGroup:
    """A `<topics>` or the like: its tag, its element, the elements in it, and what of these is well formed."""

    name: str
    head: Span
    span: Span
    elements: tuple[Span, ...]
    items: tuple[AnnotatedItem, ...]


def annotated_groups(action: Action) -> tuple[AnnotatedGroup, ...]:
    """The groups of a node's annotation in the order of the file."""
    found = []
    for group in _groups(action):
        items = []
        for item in group.children:
            read = _read_item(group.name, item, []) if item.name == ITEMS.get(group.name) else None
            if read is not None:
                items.append(AnnotatedItem(read, item.span, {name: span for name, _, span in item.attributes}))
        if group.name in GROUPS:
            elements = tuple(item.span for item in group.children)
            found.append(AnnotatedGroup(group.name, group.head, group.span, elements, tuple(items)))
    return tuple(sorted(found, key=lambda group: group.span))


def _groups(action: Action) -> list[_Tag]:
    """The tags of an annotation, those in comments last."""
    groups = [_from_action(child) for child in action.children if child.kind in GROUPS]
    for content in action.comments:
        if _STARTS_ANNOTATION.match(content.text):
            groups.extend(_from_comment(content, []))
    return groups


@derived
def read_annotation(action: Action) -> tuple[Interface | None, tuple[AnnotationProblem, ...]]:
    """The interface that is annotated in a node's tag, None if there is no annotation, and what is malformed in it."""
    problems: list[AnnotationProblem] = []
    groups = [_from_action(child) for child in action.children if child.kind in GROUPS]
    there = bool(groups)
    items = list(_items(groups, problems))
    for content in action.comments:
        if _STARTS_ANNOTATION.match(content.text):
            there = True
            read, wrong = _read_comment(content.text)
            items += read
            problems += (AnnotationProblem(each.message, _in_document(content, each.span)) for each in wrong)
    if not there:
        return None, ()
    endpoints = tuple(item for item in items if isinstance(item, Endpoint))
    params = tuple(item for item in items if isinstance(item, ParamUse))
    return Interface("annotation", Outcome("not-run"), endpoints, params), tuple(problems)


@lru_cache(maxsize=2048)
def _read_comment(text: str) -> tuple[tuple[Endpoint | ParamUse, ...], tuple[AnnotationProblem, ...]]:
    """What a comment says and what is malformed in it, with places in its text. It is asked for at each keystroke, by
    several rules, and once for each node of the tag."""
    problems: list[AnnotationProblem] = []
    groups = list(_from_comment(SpannedText(text, Span(0, len(text))), problems))
    items = tuple(_items(groups, problems))
    return items, tuple(problems)


def _items(groups: Iterable[_Tag], problems: list[AnnotationProblem]) -> Iterator[Endpoint | ParamUse]:
    for group in groups:
        if group.name not in GROUPS:
            problems.append(AnnotationProblem(f"unknown annotation <{group.name}>; {_one_of(GROUPS)}", group.name_span))
            continue
        for item in group.children:
            if item.name != ITEMS[group.name]:
                message = f"unexpected <{item.name}> in <{group.name}>; expected <{ITEMS[group.name]}>"
                problems.append(AnnotationProblem(message, item.name_span))
                continue
            read = _read_item(group.name, item, problems)
            if read is not None:
                yield read


def read_item(
    group: str, head: Span, attributes: Sequence[tuple[str, str, Span]], problems: list[AnnotationProblem]
) -> Endpoint | ParamUse | None:
    """One item of a group (`topics`), written elsewhere than in a tag; None after saying what is wrong with it."""
    return _read_item(group, _Tag(ITEMS[group], head, tuple(attributes), head, head, ()), problems)


def annotated_names(action: Action) -> Iterator[tuple[str, str, Span]]:
    """What the annotation of a node's tag names, and where: the tag of the item (`topic`), the name, its place."""
    for group in _groups(action):
        for item in group.children:
            for name, value, span in item.attributes:
                if name == "name" and item.name == ITEMS.get(group.name):
                    yield item.name, value, span


def worth_writing(interface: Interface) -> Iterator[Endpoint | ParamUse]:
    """What of an interface belongs into an annotation, actions as such. What every node has by its client library, and
    what was found after a made-up answer, is left out; so are parameters that it does not read."""
    actions = actions_of(interface.endpoints)
    parts = {id(part) for action in actions for part in action.parts}
    alone = (e for e in interface.endpoints if id(e) not in parts and not e.role.startswith("action_"))
    for endpoint in (*alone, *(action.endpoint for action in actions)):
        if not endpoint.builtin and "made-up answer" not in endpoint.evidence.doubts:
            yield endpoint
    yield from (p for p in interface.params if p.access in ("get", "has") and not p.builtin)


def written(what: Endpoint | ParamUse) -> tuple[str, str]:
    """The group that an endpoint or a parameter belongs into, and its element there."""
    if isinstance(what, ParamUse):
        return "params", f"<param name={_quoted(what.name)}/>"
    group, word = next((g, w) for g, classes in CLASSES.items() for w, role in classes.items() if role == what.role)
    attributes = f"name={_quoted(what.name)} type={_quoted(what.type or '*')} class={_quoted(word)}"
    return group, f"<{ITEMS[group]} {attributes}/>"


def annotation_text(interface: Interface, indent: str = "") -> str:
    """A comment that annotates `interface`, its lines after the first indented by `indent`; without a final newline.

    Names are as the node gave them. Empty when there is nothing to write.
    """
    blocks: dict[str, dict[str, tuple[str, str]]] = {group: {} for group in (*CLASSES, "params")}
    for what in worth_writing(interface):
        group, text = written(what)
        order = list(CLASSES.get(group, {}).values())
        place = str(order.index(what.role)) if isinstance(what, Endpoint) else ""
        blocks[group].setdefault(text, (place, what.name))
    return _comment({group: sorted(items, key=items.__getitem__) for group, items in blocks.items()}, indent)


def annotation_template(indent: str = "") -> str:
    """A comment with one of each kind, for the user to fill in."""
    blocks = {
        group: [f'<{ITEMS[group]} name="" type="" class="{word}"/>' for word in classes]
        for group, classes in CLASSES.items()
        if group != "actions"
    }
    return _comment({**blocks, "params": ['<param name=""/>']}, indent)


def _comment(blocks: Mapping[str, Sequence[str]], indent: str) -> str:
    lines: list[str] = []
    for group, items in blocks.items():
        if items:
            lines += [f"<{group}>", *(f"  {item}" for item in items), f"</{group}>"]
    if not lines:
        return ""
    return f"\n{indent}".join(["<!--", *(f"  {line}" for line in lines), "-->"])


def annotation_edits(node: LaunchNode, text: str, document: Document) -> tuple[Edit, ...]:
    """The edits that write an annotation into the tag of `node`, opening `<node .../>` if need be, or above it.

    `document` is the file of the node's tag. None if there is nothing to write, an annotation stands there already, or
    the tag is still being typed.
    """
    if not text or read_annotation(node.action)[0] is not None:
        return ()
    inside = [line.removeprefix("  ") for line in text.splitlines()[1:-1]]
    return writer_of(document).annotate(node.action, inside)


def _from_action(action: Action) -> _Tag:
    return _Tag(
        action.kind,
        action.kind_span,
        tuple((a.name, a.value.text, a.value.span) for a in action.attributes),
        action.head_span,
        action.span,
        tuple(_from_action(child) for child in action.children),
    )


def _from_comment(content: SpannedText, problems: list[AnnotationProblem]) -> Iterator[_Tag]:
    def moved(span: Span) -> Span:
        return _in_document(content, Span(span.start - len(_WRAPPER), span.end - len(_WRAPPER)))

    wrapped = parse_xml("", f"{_WRAPPER}{content.text}</_>")
    problems += (AnnotationProblem(problem.message, moved(problem.span)) for problem in wrapped.problems)
    if wrapped.root is not None:
        for child in wrapped.root.elements:
            yield _from_element(child, moved)


def _in_document(content: SpannedText, span: Span) -> Span:
    """A span of a comment's text as one of the document."""
    last = len(content.text)
    return content.slice_span(min(max(0, span.start), last), min(max(0, span.end), last))


def _from_element(element: Element, moved: Callable[[Span], Span]) -> _Tag:
    return _Tag(
        element.tag,
        moved(element.tag_span),
        tuple((a.name, a.value.text, moved(a.value.span)) for a in element.attributes),
        moved(element.open_span),
        moved(element.span),
        tuple(_from_element(child, moved) for child in element.elements),
    )


def _read_item(group: str, item: _Tag, problems: list[AnnotationProblem]) -> Endpoint | ParamUse | None:
    """The item, or None after saying what is wrong with it."""
    given = {name: (value, span) for name, value, span in item.attributes}
    found: list[AnnotationProblem] = []
    allowed = ATTRIBUTES[item.name]
    found += [
        AnnotationProblem(f"unknown attribute '{name}'; {_one_of(allowed)}", span)
        for name, (_, span) in given.items()
        if name not in allowed
    ]
    name, name_span = given.get("name", ("", item.head))
    if not name:
        found.append(AnnotationProblem(f"required attribute 'name' of <{item.name}> is missing", name_span))
    elif not names.is_legal(name):
        found.append(AnnotationProblem(f"invalid name '{name}'; substitutions are not evaluated here", name_span))
    if group == "params":
        problems += found
        default = given.get("default")
        if found:
            return None
        return ParamUse(name, "get", default[0] if default else None, default is not None)
    type_, type_span = given.get("type", (None, item.head))
    if type_ is not None and not _TYPE.match(type_):
        found.append(AnnotationProblem(f"invalid type '{type_}'; write package/Name, or * for any", type_span))
    classes = CLASSES[group]
    class_, class_span = given.get("class", (None, item.head))
    if class_ is None:
        found.append(
            AnnotationProblem(
                f"required attribute 'class' of <{item.name}> is missing; {_one_of(tuple(classes))}", class_span
            )
        )
    elif class_ not in classes:
        found.append(AnnotationProblem(f"unknown class '{class_}'; {_one_of(tuple(classes))}", class_span))
    problems += found
    if found or class_ is None:
        return None
    return Endpoint(classes[class_], name, type_)


def _one_of(words: Sequence[str]) -> str:
    return "allowed: " + ", ".join(words)


def _quoted(value: str) -> str:
    # A comment of XML must not hold two hyphens in a row; a line break or another control character would end what
    # begins with a hash, or be no XML at all. No legal name or type has any of them, but a node may send what it likes.
    return quoted_attribute(printable(value), {'"': "&quot;", "--": "-&#45;"})
