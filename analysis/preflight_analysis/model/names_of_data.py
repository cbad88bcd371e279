"""The names in descriptions of robots and worlds, in manifests, in YAML and in configurations of RViz: see
`name_index`."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import suppress
from xml.parsers import expat

import yaml

from preflight_analysis.documents.xml import without_comments
from preflight_analysis.documents.yaml import CONSTRUCTION_ERRORS, compose_fast, span_of
from preflight_analysis.model.entry import JOINT, Entry, Mention, mention

_TOPIC = re.compile(r"\w*[tT]opic(?:_?[nN]ame)?")
_REMAPPED = re.compile(r".*:=\s*(/?\w[\w/]*)", re.DOTALL)
_NAME = re.compile(r"/?\w[\w/]*")
_OF_LIBRARY = "default_value"
"""A key of the declarations of generate_parameter_library."""
_IN_MANIFEST = re.compile(r"<(\w*depend|name)\b[^<>]*>\s*([\w.-]+)\s*</\1>")
"""https://reps.openrobotics.org/rep-0149/: the name of the package, and those that it depends on."""
_TOPICS_OF_RVIZ = ("Value", "Topic", "Marker Topic", "Image Topic", "Depth Map Topic")
_FRAMES_OF_RVIZ = ("Fixed Frame", "Reference Frame", "Target Frame")
_NO_FRAMES = ("", "<Fixed Frame>")


def names_of_xml(text: str) -> Iterator[Mention]:
    """Those of the elements up to the first mistake."""
    found, inside = list[Mention](), list[str]()
    parser = expat.ParserCreate("us-ascii")
    parser.buffer_text = True

    def note(entry: Entry, at: int) -> None:
        found.append(mention(at, at + len(entry.text), entry) if at >= 0 else mention(0, 0, entry))

    def start(tag: str, attributes: dict[str, str]) -> None:
        inside.append(tag)
        for value in attributes.values():
            for each in JOINT.findall(value):
                note(Entry("joint", each), text.find(each, parser.CurrentByteIndex))

    def data(content: str) -> None:
        tag, plain, end = inside[-1], content.strip(), parser.CurrentByteIndex
        for each in JOINT.findall(content):
            note(Entry("joint", each), text.rfind(each, 0, end))
        remapped = _REMAPPED.fullmatch(plain) if tag in ("remapping", "argument") else None
        if remapped is not None or (_TOPIC.fullmatch(tag) and _NAME.fullmatch(plain)):
            topic = remapped[1] if remapped is not None else plain
            note(Entry("simulated", topic), text.rfind(topic, 0, end))

    parser.StartElementHandler, parser.CharacterDataHandler = start, data
    parser.EndElementHandler = lambda tag: inside.pop()
    with suppress(expat.ExpatError, ValueError):
        # A byte for each character: places are those of the text. No name has others.
        parser.Parse(text.encode("ascii", "replace"), True)
    yield from found


def names_of_manifest(text: str) -> Iterator[Mention]:
    """The package that it is of, and those that it depends on."""
    for each in _IN_MANIFEST.finditer(without_comments(text)):
        role = "declares" if each[1] == "name" else "uses"
        yield mention(*each.span(2), Entry("package", each[2], role))


def names_of_yaml(text: str) -> Iterator[Mention]:
    """The keys that have others below them, at the top, the values of keys about topics, and what is called like a
    joint anywhere."""
    root = _composed(text)
    for key, value in root.value if isinstance(root, yaml.MappingNode) else ():
        if isinstance(value, yaml.MappingNode):
            yield _at(text, key, Entry("section", key.value))
    is_library = _OF_LIBRARY in text
    for key, node in _scalars(root):
        for each in JOINT.finditer(node.value):
            place = _place(text, node)
            yield mention(place[0] + each.start(1), place[0] + each.end(1), Entry("joint", each[1]))
        if key is None and is_library:
            yield _at(text, node, Entry("name", node.value))
        elif key is not None and "topic" in key:
            yield _at(text, node, Entry("value", f"/{node.value.strip('/')}"))


def names_of_rviz(text: str) -> Iterator[Mention]:
    """The topics of displays and tools, and the frames."""
    for key, node in _scalars(_composed(text)):
        if key in _TOPICS_OF_RVIZ and node.value.startswith("/"):
            yield _at(text, node, Entry("topic", node.value, "use"))
        elif key in _FRAMES_OF_RVIZ and node.value not in _NO_FRAMES:
            yield _at(text, node, Entry("frame", node.value, "use"))


def _composed(text: str) -> yaml.Node | None:
    try:
        return compose_fast(text)
    except CONSTRUCTION_ERRORS:
        return None


def _scalars(root: yaml.Node | None) -> Iterator[tuple[str | None, yaml.ScalarNode]]:
    """All texts, each with the key that it is the value of: keys have none, items of lists an empty one."""
    pending: list[tuple[str | None, yaml.Node]] = [("", root)] if root is not None else []
    while pending:
        key, node = pending.pop()
        if isinstance(node, yaml.ScalarNode):
            yield key, node
        elif isinstance(node, yaml.MappingNode):
            for name, value in node.value:
                pending += ((None, name), (name.value if isinstance(name, yaml.ScalarNode) else "", value))
        else:
            pending += (("", item) for item in node.value)


def _at(text: str, node: yaml.Node, entry: Entry) -> Mention:
    return mention(*_place(text, node), entry)


def _place(text: str, node: yaml.Node) -> tuple[int, int]:
    """Where a scalar is written, without its quotes."""
    start, end = span_of(node)
    return (start + 1, end - 1) if text[start : start + 1] in ("'", '"') else (start, end)
