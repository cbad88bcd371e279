"""A Python launch file that is being typed, as tree-sitter reads it: also where Python's own parser takes nothing.

What expressions come to is given as texts of ROS 2's launch language (`$(find-pkg-share demo)/launch`), in which the
questions of the other formats are asked.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cached_property

import tree_sitter_python
from tree_sitter import Language, Node, Parser

from preflight_analysis.documents.span import ByteOffsets, Span
from preflight_analysis.launch.python_api import NAMES
from preflight_analysis.launch.python_source import MAX_CHARACTERS

_LANGUAGE = Language(tree_sitter_python.language())
MAX_BRACKETS = 200
"""As many may be open at once; Python itself refuses more. tree-sitter takes long to get over them."""
_MAX_DEPTH = 20
_SAME = frozenset({"str", "Path", "TextSubstitution", "realpath", "abspath", "normpath", "ParameterFile"})
"""Calls that come to what they are given."""
_BRACKET = re.compile(r"[()\[\]{}]")
_PREFIX = re.compile(r"[A-Za-z]*")
_HERE = "$(dirname)"


class PythonTree:
    """The tree of a text. Nodes speak of bytes, everything else of code points."""

    def __init__(self, text: str) -> None:
        self.text = text
        self._bytes = ByteOffsets(text)
        read = text if len(text) <= MAX_CHARACTERS and not _is_deep(text) else ""
        self.root = Parser(_LANGUAGE).parse(read.encode(errors="replace")).root_node

    def span(self, node: Node) -> Span:
        """Where a node stands; of a text what is between its quotes."""
        start, end = self._offset(node.start_byte), self._offset(node.end_byte)
        if node.type == "string" and len(node.children) > 1:
            first, last = node.children[0], node.children[-1]
            return Span(self._offset(first.end_byte), self._offset(last.start_byte))
        return Span(start, end)

    def string_at(self, offset: int) -> Node | None:
        """The text that begins at `offset`."""
        at = self._bytes.bytes_before(offset)
        node = self.root.descendant_for_byte_range(at, at + 1)
        while node is not None and node.type != "string":
            node = node.parent
        return node if node is not None and node.start_byte == at else None

    def strings(self) -> list[Node]:
        """All texts."""
        return self._nodes["string"]

    def calls(self, name: str) -> Iterator[Node]:
        """All calls of that name."""
        for call in self._nodes["call"]:
            given = call.child_by_field_name("arguments")
            if given is not None and given.type == "argument_list" and called(call) == name:
                yield call

    def launch_texts(self) -> Iterator[str]:
        """What all expressions come to that are put together."""
        for kind in ("call", "binary_operator", "list"):
            yield from (text for node in self._nodes[kind] if (text := self.launch_text(node)) is not None)

    @cached_property
    def _nodes(self) -> dict[str, list[Node]]:
        """The nodes of the types that are asked for, in the order of the text. A query of tree-sitter takes a time that
        grows with the square of the children of a node."""
        found: dict[str, list[Node]] = {"string": [], "call": [], "assignment": [], "binary_operator": [], "list": []}
        cursor = self.root.walk()
        while True:
            node = cursor.node
            if node is not None and node.type in found and node.is_named:
                found[node.type].append(node)
            if cursor.goto_first_child():
                continue
            while not cursor.goto_next_sibling():
                if not cursor.goto_parent():
                    return found

    @cached_property
    def _assigned(self) -> dict[str, Node]:
        """What names stand for that are assigned in one place only."""
        found: dict[str, list[Node]] = {}
        for node in self._nodes["assignment"]:
            name, value = node.child_by_field_name("left"), node.child_by_field_name("right")
            if name is not None and name.type == "identifier" and value is not None:
                found.setdefault(written(name), []).append(value)
        return {name: values[0] for name, values in found.items() if len(values) == 1}

    def resolved(self, node: Node) -> Node:
        """What a name stands for; anything else is itself."""
        for _ in range(_MAX_DEPTH):
            known = self._assigned.get(written(node)) if node.type == "identifier" else None
            if known is None:
                break
            node = known
        return node

    def launch_text(self, node: Node, depth: int = 0) -> str | None:
        """What an expression comes to, with substitutions; None where that is not written out."""
        node = self.resolved(node)
        if depth > _MAX_DEPTH:
            return None
        match node.type:
            case "string":
                return _plain(node)
            case "concatenated_string" | "list" | "tuple":
                return self._joined(node.named_children, "", depth)
            case "parenthesized_expression":
                return self.launch_text(node.named_children[0], depth + 1) if node.named_children else None
            case "binary_operator":
                operator = node.child_by_field_name("operator")
                between = {"+": "", "/": "/"}.get(operator.type if operator is not None else "")
                ends = (node.child_by_field_name("left"), node.child_by_field_name("right"))
                found = [end for end in ends if end is not None]
                return self._joined(found, between, depth) if between is not None and len(found) == len(ends) else None
            case "call":
                return self._called_text(node, depth)
        return None

    def path_before(self, node: Node, among: list[Node], between: str) -> str | None:
        """What stands in front of one of several pieces of a path."""
        before = [each for each in among if each.start_byte < node.start_byte]
        text = self._joined(before, between, 0)
        return None if text is None else text + between if before else ""

    def _joined(self, nodes: list[Node], between: str, depth: int) -> str | None:
        texts = [self.launch_text(each, depth + 1) for each in nodes if each.type != "comment"]
        known = [text for text in texts if text is not None]
        return between.join(known) if len(known) == len(texts) else None

    def _called_text(self, call: Node, depth: int) -> str | None:
        name, given = called(call), arguments(call)
        values = list(given.values())
        if name == "ThisLaunchFileDir":
            return _HERE
        if name == "dirname" and values:
            return _HERE if "__file__" in written(values[0]) else None
        if name == "join":
            return self._joined(values, "/", depth)
        if not values:
            return None
        if name == "PathJoinSubstitution":
            inner = self.resolved(values[0])
            return self._joined(inner.named_children, "/", depth) if inner.type in ("list", "tuple") else None
        first = self.launch_text(values[0], depth + 1)
        if first is None or name in _SAME or name.endswith("LaunchDescriptionSource"):
            return first
        return f"$({NAMES[name][0]} {first})" if name in NAMES else None

    def _offset(self, byte: int) -> int:
        return self._bytes.offset(byte)


def _is_deep(text: str) -> bool:
    """Whether more brackets are open at once than Python takes, those in texts and comments counted too."""
    depth = 0
    for bracket in _BRACKET.findall(text):
        depth = depth + 1 if bracket in "([{" else max(0, depth - 1)
        if depth > MAX_BRACKETS:
            return True
    return False


def written(node: Node) -> str:
    """The text of a node."""
    return (node.text or b"").decode(errors="replace")


def called(call: Node) -> str:
    """`Node` of a call of `launch_ros.actions.Node`."""
    function = call.child_by_field_name("function")
    if function is not None and function.type == "attribute":
        function = function.child_by_field_name("attribute")
    return written(function) if function is not None else ""


def arguments(call: Node) -> dict[str, Node]:
    """What a call is given, by keyword or by position (`0`, `1`, ...). The first counts where one is given twice."""
    found: dict[str, Node] = {}
    given = call.child_by_field_name("arguments")
    position = 0
    for each in given.named_children if given is not None else ():
        if each.type == "keyword_argument":
            name, value = each.child_by_field_name("name"), each.child_by_field_name("value")
            if name is not None and value is not None:
                found.setdefault(written(name), value)
        elif each.type not in ("comment", "ERROR"):
            found[str(position)] = each
            position += 1
    return found


def _plain(string: Node) -> str | None:
    """A text without anything in it that is computed."""
    prefix = _PREFIX.match(written(string))
    pieces = [each for each in string.named_children if each.type not in ("string_start", "string_end")]
    if any(each.type != "string_content" for each in pieces) or (prefix and "b" in prefix[0].lower()):
        return None
    text = "".join(written(each) for each in pieces)
    return None if "\\" in text or "$(" in text else text
