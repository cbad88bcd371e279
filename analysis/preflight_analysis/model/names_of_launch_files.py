"""The names in a launch file of any format: see `name_index`."""

from __future__ import annotations

import re
from collections.abc import Iterator

from preflight_analysis.documents.quoted import Program, Quoted
from preflight_analysis.launch.model import Action, ActionAttribute, LaunchFile
from preflight_analysis.launch.references import NAMES, first_word
from preflight_analysis.launch.substitutions_ros2 import nested
from preflight_analysis.model.entry import BRIDGED, FILE, GRAPH_NAME, JOINT, Entry, Kind

_BELOW_PACKAGE = re.compile(r"\$\(find(?:-pkg-share)? ([\w-]+)\)/([\w./-]+\.[A-Za-z]\w*)")
_FULL_NAME = re.compile(r"/[\w/]+")
_ARGUMENT = re.compile(r"[\w./-]+")
_ARGUMENTS = ("arg", "let")
_FIXED = ("find", "find-pkg-share", "dirname")
"""Substitutions that give the same in every launch."""
_REMAPS = ("remap", "set_remap")
_OF_ATTRIBUTE: dict[str, Kind] = {
    "pkg": "package", "target": "container", "target_container": "container",
}  # fmt: skip
_OF_KEYWORD: dict[str, Kind] = {"package": "package", "executable": "program", "target_container": "container"}
_OF_CALL: dict[str, Kind] = {
    "DeclareLaunchArgument": "argument",
    "FindPackageShare": "package",
    "get_package_share_directory": "package",
    "get_package_share_path": "package",
}


def names_of_launch_file(file: LaunchFile) -> Iterator[Entry]:
    """Those of one in XML or YAML, as its tags have them."""
    if file.root is not None:
        yield from file.root.gather(_of_action)


def _of_action(action: Action) -> Iterator[Entry]:
    name = action.value("name")
    for attribute in action.attributes:
        yield from _of_attribute(action, attribute)
    yield from (Entry("joint", each) for each in JOINT.findall(action.body.text))
    if action.kind in _ARGUMENTS and name is not None:
        yield Entry("argument", name.text)
    elif action.kind == "param" and name is not None:
        yield Entry("parameter", name.text.rpartition("/")[2], role="set")
    elif action.kind == "include" and (file := action.value("file") or action.value("path")) is not None:
        given = ((child, child.value("name")) for child in action.children if child.kind in _ARGUMENTS)
        for child, each in given if all(part.command in _FIXED for part in file.substitutions) else ():
            if each is not None and child.value("value") is not None:
                yield Entry("passed", each.text, of=file.text.rpartition("/")[2])


def _of_attribute(action: Action, attribute: ActionAttribute) -> Iterator[Entry]:
    name, text = attribute.name, attribute.value.text
    if name in ("type", "exec"):
        package = action.value("pkg")
        yield Entry("program", text, of=package.text if package is not None else "")
    elif name in _OF_ATTRIBUTE:
        yield Entry(_OF_ATTRIBUTE[name], text)
    elif name in ("from", "to") and action.kind in _REMAPS and GRAPH_NAME.fullmatch(text):
        yield from (Entry("remap", text),) if name == "to" else ()
        yield from (Entry("value", text),) if text.startswith("/") else ()
    elif name == "args":
        words = text.split()
        yield from (Entry("flag", word) for word in words if word.startswith("--"))
        if len(words) > 2 and words[0] == "load":
            yield Entry("container", words[2])
    elif name in ("value", "default") and action.kind in (*_ARGUMENTS, "param"):
        given, below = action.value("name"), _BELOW_PACKAGE.fullmatch(text)
        if _FULL_NAME.fullmatch(text):
            yield Entry("value", text)
        elif below is not None and given is not None:
            yield Entry("given", below[2], of=given.text, type=below[1])
    if "$" in text:
        named = (part for part in nested(attribute.value.parts) if NAMES.get(part.command) == "package")
        yield from (Entry("package", first_word(part)[0]) for part in named)
    yield from _in_text(text)


def _in_text(text: str) -> Iterator[Entry]:
    if "." in text:
        yield from (Entry("file", each) for each in FILE.findall(text))
    if "@" in text:
        yield from (Entry("bridged", each) for each in BRIDGED.findall(text))
    if "_" in text:
        yield from (Entry("joint", each) for each in JOINT.findall(text))


def names_of_python_launch_file(program: Program) -> Iterator[Entry]:
    """Those that one in Python has in quotes, wherever that is."""
    previous: Quoted | None = None
    for each in program.quoted:
        yield from _in_text(each.text)
        kind = _OF_KEYWORD.get(each.before.removesuffix("=").strip()) if each.before else _OF_CALL.get(each.called)
        if kind is not None:
            yield Entry(kind, each.text)
        if not each.before and _ARGUMENT.fullmatch(each.text):
            yield from _of_pair(program.text, previous, each)
        previous = each


def _of_pair(text: str, previous: Quoted | None, each: Quoted) -> Iterator[Entry]:
    """`('from', 'to')` may be a remap, `('name', ...)` and `{'name': ...}` what an include is given."""
    behind = text[each.end : each.end + 8].lstrip()[:1]
    is_pair = not each.call and each.bracket >= 0 and text[each.bracket] == "("
    if behind == ":" or (each.nth == 0 and is_pair and behind == ","):
        yield Entry("argument", each.text)
    elif is_pair and each.nth == 1 and behind in (",", ")") and GRAPH_NAME.fullmatch(each.text):
        first = previous if previous is not None and previous.bracket == each.bracket else None
        if first is not None and not first.before and GRAPH_NAME.fullmatch(first.text):
            yield Entry("remap", each.text)
