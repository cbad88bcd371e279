"""What kind of place a cursor is in, in a Python launch file that is being typed.

Only texts in calls of ROS 2's own are places; everything else belongs to the Python language server. The answer is in
the terms of the other formats: a call is an element, its arguments attributes.

A text whose quote, or a call whose bracket, is still missing is completed before it is parsed: where the cursor is, is
decided by what stands before it.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from typing import Literal

from tree_sitter import Node

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.document import Attribute, Element, SpannedText
from preflight_analysis.documents.span import Span
from preflight_analysis.evaluation.ros2.actions.registry import tags
from preflight_analysis.launch import schema
from preflight_analysis.launch.python_api import KINDS, NAMES, made_by, parameter_of, positional
from preflight_analysis.launch.python_source import open_brackets
from preflight_analysis.launch.python_tree import PythonTree, arguments, called, written
from preflight_analysis.launch.schema import Kind
from preflight_analysis.queries.cursor import Place

PythonKind = Literal[
    "package",
    "executable",
    "component",
    "namespace",
    "variable",
    "choice",
    "used",
    "argument",
    "parameter",
    "remap-from",
    "remap-to",
    "launch-file",
    "yaml-file",
    "file",
]
"""`choice`: one of those of the place; `used`: the name of a launch argument where its value is taken; `argument`:
where an include passes it."""

_STRING = re.compile(
    r"""(?P<quote>\"\"\"|'''|"|')(?P<text>(?:(?!(?P=quote))(?:[^\\]|\\.))*)(?P<end>(?P=quote))?|\#.*"""
)
_WORD = re.compile(r"[\w./~-]*")
_CODE = re.compile(r"[,=(){}\[\]:]")
_PLACES: Mapping[Kind, PythonKind] = {
    "package": "package",
    "executable": "executable",
    "component": "component",
    "namespace": "namespace",
    "variable": "variable",
    "text": "choice",
}
"""What can stand in a text, by what the other formats have there."""
_NAMES: Mapping[str, PythonKind] = {"find-pkg-share": "package", "find-pkg-prefix": "package", "var": "used"}
"""What is named where there would be such a substitution."""
_CONFIGURATIONS = "launch_configurations"
_FILES = ("launch-file", "yaml-file", "file")
_FILE = re.compile(r"\w\.\w+\Z")
_CLOSING = {"(": ")", "[": "]", "{": "}"}


@dataclass(frozen=True, slots=True)
class PythonPlace:
    """A place and what may stand there. `before` is what is known of the value in front of the text: the folder of a
    path, `outer.` of a parameter whose name is nested."""

    kind: PythonKind
    place: Place
    tree: PythonTree
    before: str = ""
    choices: tuple[str, ...] = ()


def place_at_python(text: str, offset: int) -> PythonPlace | None:
    """The place of a cursor at `offset`; None where it is in no text of ours."""
    found = _string_at(text, offset)
    if found is None:
        return None
    start, word, closed = found
    quote = text[word.start - 1]
    whole = text if closed else text[: word.end] + quote + text[word.end :]
    tree = PythonTree(whole)
    answer = _place(tree, start, word)
    if answer is not None:
        return answer
    # What follows is no help: as if the file ended here, with all that is open closed.
    head = text[: word.end]
    opened = open_brackets(head[:start])
    is_key = opened[-1:] == "{" and not head[:start].rstrip().endswith(":")
    tail = (": 0" if is_key else "") + "".join(_CLOSING[each] for each in reversed(opened))
    return _place(PythonTree(f"{head}{quote}{tail}\n"), start, word)


def written_paths(text: str) -> Iterator[tuple[Span, str]]:
    """The last pieces of paths to files, each with the whole path as launch files have it."""
    tree = PythonTree(text)
    for string in tree.strings():
        span = tree.span(string)
        name = text[span.start : span.end]
        found = _Reader(tree, span).place(string) if _FILE.search(name) and string.parent is not None else None
        if found is not None and found.kind in _FILES:
            yield span, found.before + name


def _string_at(text: str, offset: int) -> tuple[int, Span, bool] | None:
    """Where the text around the cursor begins (at its quote), what of it is to be replaced, and whether it is closed.
    Goes by the line alone, on which such texts begin and end."""
    begin = text.rfind("\n", 0, offset) + 1
    end = text.find("\n", offset)
    line = text[begin : end if end >= 0 else len(text)].rstrip("\r")
    cursor = offset - begin
    for found in _STRING.finditer(line):
        quote, inner = found["quote"], found.start("text")
        if quote is None or len(quote) > 1:
            if found.start() < cursor <= found.end():
                return None
            continue
        if not inner <= cursor:
            return None
        if cursor > found.end("text"):
            continue
        rest = line[cursor : found.end("text")]
        closed = found["end"] is not None and not _CODE.search(rest)
        if closed:
            stop = found.end("text")
        else:
            word = _WORD.match(line, cursor)
            stop = word.end() if word else cursor
        if found.start() > 0 and line[found.start() - 1] in "fFbB":
            return None
        return begin + found.start(), Span(begin + inner, begin + stop), closed
    return None


def _place(tree: PythonTree, start: int, word: Span) -> PythonPlace | None:
    string = tree.string_at(start)
    if string is None or string.parent is None:
        return None
    return _Reader(tree, word).place(string)


class _Reader:
    def __init__(self, tree: PythonTree, word: Span) -> None:
        self._tree = tree
        self._word = word

    def place(self, string: Node) -> PythonPlace | None:
        """By what the text stands in."""
        parent = string.parent
        assert parent is not None
        match parent.type:
            case "argument_list" | "keyword_argument":
                return self._argument(string, parent)
            case "pair" if parent.child_by_field_name("key") == string and parent.parent is not None:
                return self._key(parent.parent, "")
            case "set":
                return None
            case "tuple" | "parenthesized_expression":
                return self._of_pair(string, parent)
            case "list" | "binary_operator":
                return self._path(string, parent)
            case "subscript":
                value = parent.child_by_field_name("value")
                if value is not None and written(value).endswith(_CONFIGURATIONS) and string != value:
                    return self._answer("used")
        return None

    def _answer(
        self, kind: PythonKind, element: Element | None = None, parents: tuple[Element, ...] = (), before: str = ""
    ) -> PythonPlace:
        return PythonPlace(kind, Place("value", self._word, parents, element), self._tree, before)

    def _argument(self, string: Node, parent: Node) -> PythonPlace | None:
        around = parent if parent.type == "argument_list" else parent.parent
        call = around.parent if around is not None else None
        if call is None or call.type != "call" or around is None or around.has_error:
            return None
        given = arguments(call)
        key = next((key for key, value in given.items() if value == string), None)
        name = called(call)
        command, parameter = NAMES.get(name, ("", ""))
        if command in _NAMES and key in ("0", parameter):
            return self._answer(_NAMES[command])
        if key == "0" and name == "get" and _of_context(call):
            return self._answer("used")
        if name == "join":
            return self._path(string, around)
        asked = next((each for each, value in self._given(call) if value == string), None)
        kind = _PLACES.get(asked.kind) if asked is not None else None
        if asked is None or kind is None or (kind == "choice" and not asked.choices):
            return None
        return replace(self._answer(kind, self._tag(call)), choices=asked.choices)

    def _given(self, call: Node) -> Iterator[tuple[schema.Attribute, Node]]:
        """What a call is given, by the attributes of the tag that would say the same."""
        given, kind = arguments(call), _kind(call)
        made, tag = made_by(kind), tags().get(kind)
        by_place = {str(n): name for n, name in enumerate(positional(made))}
        by_name = {by_place.get(key, key): value for key, value in given.items()}
        for attribute in tag.attributes.values() if tag is not None else ():
            value = by_name.get(parameter_of(made, attribute.name))
            if value is not None:
                yield attribute, value

    def _tag(self, call: Node) -> Element:
        """A call as the tag that would say the same."""
        attributes = [self._attribute(each.name, value) for each, value in self._given(call)]
        named = (("param", "parameters"), ("arg", "launch_arguments"))
        given = arguments(call)
        children = [self._named(tag, "name", key) for tag, each in named for key in self._keys(given.get(each))]
        return self._element(_kind(call), call, [each for each in attributes if each is not None], children)

    def _keys(self, node: Node | None) -> Iterator[Node]:
        """The keys of the maps in a list, or of one, and the first texts of pairs."""
        found = self._tree.resolved(node) if node is not None else None
        if found is not None and found.type == "call":
            function = found.child_by_field_name("function")
            inner = function.child_by_field_name("object") if function is not None else None
            found = self._tree.resolved(inner) if inner is not None else None
        for each in (found, *(found.named_children if found is not None and found.type == "list" else ())):
            if each is not None and each.type == "dictionary":
                keys = (pair.child_by_field_name("key") for pair in each.named_children if pair.type == "pair")
                yield from (key for key in keys if key is not None and key.type == "string")
            elif each is not None and each.type == "tuple" and each.named_children:
                yield each.named_children[0]

    def _key(self, holder: Node, prefix: str) -> PythonPlace | None:
        """The key of a map: of parameters, or of what an include passes."""
        above = holder.parent
        if holder.has_error or above is None:
            return None
        if above.type == "pair" and above.parent is not None:
            key = above.child_by_field_name("key")
            outer = self._tree.launch_text(key) if key is not None else None
            return self._key(above.parent, f"{outer}.{prefix}") if outer is not None else None
        if above.type == "attribute" and above.parent is not None:  # `{...}.items()`
            above = above.parent.parent
        elif above.type == "list":
            above = above.parent
        return self._of_keyword(above, "from", prefix)

    def _of_pair(self, string: Node, pair: Node) -> PythonPlace | None:
        """One of two texts in brackets: of a remap, or of what an include passes."""
        above = pair.parent
        if pair.has_error or above is None or above.type != "list":
            return None
        first = pair.named_children[0] == string
        other = None if first or len(pair.named_children) != 2 else pair.named_children[0]
        return self._of_keyword(above.parent, "from" if first else "to", "", pair, other)

    def _of_keyword(
        self, keyword: Node | None, end: str, before: str, pair: Node | None = None, other: Node | None = None
    ) -> PythonPlace | None:
        around = keyword.parent if keyword is not None and keyword.type == "keyword_argument" else None
        call = around.parent if around is not None else None
        name = keyword.child_by_field_name("name") if keyword is not None else None
        if call is None or call.type != "call" or name is None:
            return None
        own = Element("", self._word, (), (), self._word, self._word)
        match written(name), end:
            case "parameters", "from":
                return self._answer("parameter", own, (self._tag(call),), before)
            case "remappings", "from":
                return self._answer("remap-from", own, (self._tag(call),))
            case "remappings", "to" if pair is not None and other is not None:
                written_from = self._attribute("from", other)
                remap = self._element("remap", pair, [written_from] if written_from is not None else [], ())
                return self._answer("remap-to", remap, (self._tag(call),))
            case "launch_arguments", "from":
                return self._answer("argument", own, (self._tag(call),))
        return None

    def _path(self, string: Node, parent: Node) -> PythonPlace | None:
        """One piece of a path: an argument of `join`, an element of a list, the right side of `/` or `+`."""
        holder = parent.parent
        name = called(holder) if holder is not None and holder.type == "call" else ""
        between, among = "/", parent.named_children
        if parent.type == "binary_operator":
            operator = parent.child_by_field_name("operator")
            between = "/" if operator is not None and operator.type == "/" else ""
        elif parent.type == "list":
            outer = holder.parent if holder is not None and holder.type == "argument_list" else None
            between = "/" if outer is not None and called(outer) == "PathJoinSubstitution" else ""
        elif name != "join":
            return None
        before = self._tree.path_before(string, among, between) if not parent.has_error else None
        return self._answer(_file_kind(parent), before=before) if before else None

    def _named(self, tag: str, attribute: str, node: Node) -> Element:
        found = self._attribute(attribute, node)
        return self._element(tag, node, [found] if found is not None else [], ())

    def _attribute(self, name: str, node: Node) -> Attribute | None:
        text = self._tree.launch_text(node)
        span = self._tree.span(node)
        return Attribute(name, span, SpannedText(text, span), span) if text is not None else None

    def _element(self, tag: str, node: Node, attributes: Iterable[Attribute], children: Iterable[Element]) -> Element:
        span = self._tree.span(node)
        return Element(tag, span, tuple(attributes), tuple(children), span, span)


def _kind(call: Node) -> str:
    """What a call makes; of one that is not known what it seems to, by what it is given."""
    given = arguments(call)
    seems = {"executable": "node", "plugin": "composable_node", "launch_arguments": "include"}
    return KINDS.get(called(call)) or next((kind for name, kind in seems.items() if name in given), "")


def _of_context(call: Node) -> bool:
    """Whether it is `context.launch_configurations.get(...)`."""
    function = call.child_by_field_name("function")
    holder = function.child_by_field_name("object") if function is not None else None
    return holder is not None and written(holder).endswith(_CONFIGURATIONS)


def _file_kind(node: Node | None) -> PythonKind:
    """What kind of file a path names, by what it is given to."""
    while node is not None and node.type not in ("block", "module"):
        if node.type == "call" and called(node).endswith("LaunchDescriptionSource"):
            return "launch-file"
        if node.type == "keyword_argument" and written(node).startswith("parameters"):
            return "yaml-file"
        node = node.parent
    return "file"
