"""The names in a launch file of any format: see `name_index`."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping

from preflight_analysis.documents.quoted import Program, Quoted
from preflight_analysis.documents.span import Span
from preflight_analysis.evaluation.tags import tags_of
from preflight_analysis.launch.model import Action, ActionAttribute, LaunchFile, Substitution, Value
from preflight_analysis.launch.references import COMPONENT, NAMES, Named, arg_references, first_word
from preflight_analysis.launch.schema import Kind as ValueKind
from preflight_analysis.launch.schema import Tag
from preflight_analysis.launch.substitutions_ros2 import nested
from preflight_analysis.model.entry import BRIDGED, FILE, GRAPH_NAME, JOINT, Entry, Kind, Mention, in_quotes

_BELOW_PACKAGE = re.compile(r"\$\(find(?:-pkg-share)? ([\w-]+)\)/([\w./-]+\.[A-Za-z]\w*)")
_FULL_NAME = re.compile(r"/[\w/]+")
_ARGUMENT = re.compile(r"[\w./-]+")
_ARGUMENTS = ("arg", "let")
_FIXED = ("find", "find-pkg-share", "dirname")
"""Substitutions that give the same in every launch."""
_IN_PACKAGE = "exec-in-pkg"
_WORD = re.compile(r"\S+")
_REMAPS = ("remap", "set_remap")
_CONTAINERS = ("target", "target_container")
_OF_VALUE: Mapping[ValueKind, tuple[Kind, str]] = {
    "package": ("package", ""),
    "executable": ("program", ""),
    "component": ("component", ""),
    "node": ("node", ""),
    "launch-file": ("include", ""),
    "parameter": ("parameter", "set"),
    "remap-from": ("remap", "from"),
    "remap-to": ("remap", "to"),
    "variable": ("variable", ""),
    "machine": ("machine", ""),
}
_OF_SUBSTITUTION: Mapping[Named | None, tuple[Kind, str]] = {
    "argument": ("argument", "uses"), "package": ("package", ""), "variable": ("variable", ""),
}  # fmt: skip
_DECLARES: dict[str, Kind] = {"DeclareLaunchArgument": "argument"}
_OF_KEYWORD: dict[str, Kind] = {"package": "package", "executable": "program", "target_container": "container"}

_IN_TEXTS: tuple[tuple[str, re.Pattern[str], Kind], ...] = (
    (".", FILE, "file"), ("@", BRIDGED, "bridged"), ("_", JOINT, "joint"),
)  # fmt: skip
"""What may be a part of any text, with a sign that each has."""


def names_of_launch_file(file: LaunchFile) -> Iterator[Mention]:
    """Those of its tags and substitutions, with their places."""
    for action in file.root.walk() if file.root is not None else ():
        yield from _of_action(action, file.generation, file.named is None)
    for part in file.named or ():
        yield from _of_substitution(part, Span(0, 0))


def packages_of_launch_file(file: LaunchFile) -> Iterator[tuple[str, Span]]:
    """The packages among them: a tag that only moves is not looked at again."""
    yield from file.root.gather(_packages_of, file.generation, file.named is None) if file.root is not None else ()
    for part in file.named or ():
        yield from _packages_among(_of_substitution(part, Span(0, 0)))


def _packages_of(action: Action, generation: int, substitutions: bool) -> Iterator[tuple[str, Span]]:
    return _packages_among(_of_action(action, generation, substitutions))


def _packages_among(found: Iterable[Mention]) -> Iterator[tuple[str, Span]]:
    return ((each.entry.text, each.span) for each in found if each.entry.kind == "package")


def entries_of_launch_file(file: LaunchFile) -> Iterable[Entry]:
    """Likewise without: a tag that only moves is not looked at again."""
    return file.root.gather(_entries_of, file.generation) if file.root is not None else ()


def _entries_of(action: Action, generation: int) -> Iterable[Entry]:
    return dict.fromkeys(found.entry for found in _of_action(action, generation, True))


def _of_action(action: Action, generation: int, substitutions: bool) -> Iterator[Mention]:
    tags, tag = tags_of(generation), action.head_span
    for attribute in action.attributes:
        yield from _of_attribute(action, attribute, tags.get(action.kind))
        if substitutions and "$" in attribute.value.text:
            yield from _of_substitutions(attribute.value, tag)
    if "$" in action.body.text:
        yield from (_uses(name, span, tag) for name, span in arg_references(action.body))
    yield from _found(JOINT, "joint", action.body, tag)
    is_include = action.kind == "include"
    for child in action.children:
        for name in _argument_names(child, tags.get(child.kind)):
            where, role = (tag, "passes") if is_include else (child.head_span, "declares")
            yield Mention(Entry("argument", name.text, role), name.span, where)
    file = action.value("file") or action.value("path") if is_include else None
    if file is not None and all(part.command in _FIXED for part in file.substitutions):
        for child in action.children:
            given = child.value("name") if child.kind in _ARGUMENTS else None
            if given is not None and child.value("value") is not None:
                yield Mention(Entry("passed", given.text, of=file.text.rpartition("/")[2]), given.span, tag)


def _argument_names(action: Action, tag: Tag | None) -> Iterator[Value]:
    if tag is not None:
        for each in action.attributes:
            if (known := tag.attributes.get(each.name)) is not None and known.kind == "argument":
                yield each.value


def _of_attribute(action: Action, attribute: ActionAttribute, tag: Tag | None) -> Iterator[Mention]:
    name, text = attribute.name, attribute.value.text
    for entry in _said(action, attribute, tag):
        yield Mention(entry, attribute.value.span, action.head_span)
    if name == "args":
        words = text.split()
        yield from (Mention(Entry("flag", w), attribute.value.span, action.head_span) for w in words if w[:2] == "--")
        if len(words) > 2 and words[0] == "load":
            yield Mention(Entry("container", words[2]), attribute.value.span, action.head_span)
    for mark, pattern, kind in _IN_TEXTS:
        if mark in text:
            yield from _found(pattern, kind, attribute.value, action.head_span)


def _said(action: Action, attribute: ActionAttribute, tag: Tag | None) -> Iterator[Entry]:
    """What the whole of an attribute names."""
    name, text = attribute.name, attribute.value.text
    known = tag.attributes.get(name) if tag is not None else None
    # The `param` of a `<rosparam>` is what several parameters have in common.
    if known is not None and action.kind != "rosparam" and (named := _OF_VALUE.get(known.kind)) is not None:
        kind, role = named
        leaf = text.rpartition("/")[2] if kind == "parameter" else text
        package = action.value("pkg") if kind in ("program", "component") else None
        yield Entry(kind, leaf, role, package.text if package is not None else text[: len(text) - len(leaf)])
    if name in _CONTAINERS:
        yield Entry("container", text)
    if name in ("from", "to") and action.kind in _REMAPS and text.startswith("/") and GRAPH_NAME.fullmatch(text):
        yield Entry("value", text)
    elif name in ("value", "default") and action.kind in (*_ARGUMENTS, "param"):
        given, below = action.value("name"), _BELOW_PACKAGE.fullmatch(text)
        if _FULL_NAME.fullmatch(text):
            yield Entry("value", text)
        elif below is not None and given is not None:
            yield Entry("given", below[2], of=given.text, type=below[1])


def _of_substitutions(value: Value, tag: Span) -> Iterator[Mention]:
    if value.problem is None:
        yield from (_uses(name, span, tag) for name, span in arg_references(value))
        for part in nested(value.parts):
            if NAMES.get(part.command) != "argument":
                yield from _of_substitution(part, tag)


def _of_substitution(part: Substitution, tag: Span) -> Iterator[Mention]:
    name, span = first_word(part)
    if part.command == _IN_PACKAGE and len(words := [*_WORD.finditer(part.arguments)]) > 1:
        start, program, package = part.arguments_span.start, words[0][0], words[1][0]
        places = [Span(start + word.start(), start + word.end()) for word in words]
        yield Mention(Entry("program", program, of=package), places[0], tag)
        yield Mention(Entry("package", package), places[1], tag)
    if part.command == COMPONENT:
        package, _, cls = name.partition("/")
        yield Mention(Entry("component", cls, of=package), span, tag)
    elif (named := _OF_SUBSTITUTION.get(NAMES.get(part.command))) is not None:
        yield Mention(Entry(named[0], name, named[1]), span, tag)


def _uses(name: str, span: Span, tag: Span) -> Mention:
    return Mention(Entry("argument", name, "uses"), span, tag)


def _found(pattern: re.Pattern[str], kind: Kind, value: Value, tag: Span) -> Iterator[Mention]:
    """What of a value is like the pattern; with entities in it the whole of that stands in for the place."""
    start, exact = value.span.start, value.span.end - value.span.start == len(value.text)
    for each in pattern.finditer(value.text):
        span = Span(start + each.start(1), start + each.end(1)) if exact else value.span
        yield Mention(Entry(kind, each[1]), span, tag)


def names_of_python_launch_file(program: Program) -> Iterator[Mention]:
    """Those that one in Python has in quotes, wherever that is, without those of any program."""
    previous: Quoted | None = None
    for each in program.quoted:
        yield from (in_quotes(each, entry) for entry in _of_quoted(program.text, previous, each))
        previous = each


def _of_quoted(text: str, previous: Quoted | None, each: Quoted) -> Iterator[Entry]:
    for _, pattern, found in _IN_TEXTS[:2]:
        yield from (Entry(found, name) for name in pattern.findall(each.text))
    kind = _OF_KEYWORD.get(each.before.removesuffix("=").strip()) if each.before else _DECLARES.get(each.called)
    if kind is not None:
        yield Entry(kind, each.text)
    if not each.before and _ARGUMENT.fullmatch(each.text):
        yield from _of_pair(text, previous, each)


def _of_pair(text: str, previous: Quoted | None, each: Quoted) -> Iterator[Entry]:
    """`('from', 'to')` may be a remap, `('name', ...)` and `{'name': ...}` what an include is given."""
    behind = text[each.end : each.end + 8].lstrip()[:1]
    is_pair = not each.call and each.bracket >= 0 and text[each.bracket] == "("
    if behind == ":" or (each.nth == 0 and is_pair and behind == ","):
        yield Entry("argument", each.text)
    elif is_pair and each.nth == 1 and behind in (",", ")") and GRAPH_NAME.fullmatch(each.text):
        first = previous if previous is not None and previous.bracket == each.bracket else None
        if first is not None and not first.before and GRAPH_NAME.fullmatch(first.text):
            yield Entry("remap", each.text, "to")
