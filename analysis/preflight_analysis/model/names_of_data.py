"""The names in descriptions of robots and worlds, and in YAML: see `name_index`."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import suppress
from xml.parsers import expat

import yaml

from preflight_analysis.documents.yaml import CONSTRUCTION_ERRORS, compose_fast
from preflight_analysis.model.entry import JOINT, Entry

_TOPIC = re.compile(r"\w*[tT]opic(?:_?[nN]ame)?")
_REMAPPED = re.compile(r".*:=\s*(/?\w[\w/]*)", re.DOTALL)
_NAME = re.compile(r"/?\w[\w/]*")
_OF_LIBRARY = "default_value"
"""A key of the declarations of generate_parameter_library."""


def names_of_xml(text: str) -> Iterator[Entry]:
    """Those of the elements up to the first mistake."""
    found, inside = list[Entry](), list[str]()
    parser = expat.ParserCreate()
    parser.buffer_text = True

    def start(tag: str, attributes: dict[str, str]) -> None:
        inside.append(tag)
        for value in attributes.values():
            found.extend(Entry("joint", each) for each in JOINT.findall(value))

    def data(content: str) -> None:
        tag, plain = inside[-1], content.strip()
        found.extend(Entry("joint", each) for each in JOINT.findall(content))
        remapped = _REMAPPED.fullmatch(plain) if tag in ("remapping", "argument") else None
        if remapped is not None or (_TOPIC.fullmatch(tag) and _NAME.fullmatch(plain)):
            found.append(Entry("simulated", remapped[1] if remapped is not None else plain))

    parser.StartElementHandler, parser.CharacterDataHandler = start, data
    parser.EndElementHandler = lambda tag: inside.pop()
    with suppress(expat.ExpatError, ValueError):
        parser.Parse(text, True)
    yield from found


def names_of_yaml(text: str) -> Iterator[Entry]:
    """The keys that have others below them, at the top, the values of keys about topics, and what is called like a
    joint anywhere."""
    try:
        root = compose_fast(text)
    except CONSTRUCTION_ERRORS:
        return
    for key, value in root.value if isinstance(root, yaml.MappingNode) else ():
        if isinstance(value, yaml.MappingNode):
            yield Entry("section", key.value)
    is_library, pending = _OF_LIBRARY in text, [root] if root is not None else []
    while pending:
        node = pending.pop()
        if isinstance(node, yaml.ScalarNode):
            yield from (Entry("joint", each) for each in JOINT.findall(node.value))
        elif isinstance(node, yaml.MappingNode):
            keys = [key for key, _ in node.value if isinstance(key, yaml.ScalarNode)]
            yield from (Entry("name", key.value) for key in keys if is_library)
            yield from (
                Entry("value", f"/{value.value.strip('/')}")
                for key, value in node.value
                if isinstance(key, yaml.ScalarNode) and "topic" in key.value and isinstance(value, yaml.ScalarNode)
            )
            pending += [part for pair in node.value for part in pair]
        else:
            pending += node.value
