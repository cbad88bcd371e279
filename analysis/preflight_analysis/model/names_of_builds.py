"""The names in files that say how a package is built: see `name_index`."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise

from preflight_analysis.documents.quoted import Program
from preflight_analysis.environment.cmake_syntax import Command, Word, commands
from preflight_analysis.model.entry import Entry, Mention, mention

_ENTRY_POINT = re.compile(r"\s*([\w.-]+)\s*=\s*[\w.]+\s*:\s*[\w.]+\s*(?:\[[^\]]*\]\s*)?")
_EXECUTABLES = ("add_executable", "ament_auto_add_executable", "cs_add_executable")
_COMPONENTS = ("rclcpp_components_register_node", "rclcpp_components_register_nodes")
_PACKAGES = ("find_package", "ament_target_dependencies", "ament_export_dependencies", "catkin_package")
_ALL_BUT_FIRST = ("ament_target_dependencies",)
_FIRST = ("find_package",)
_LISTED = "COMPONENTS"
_NAME = re.compile(r"[A-Za-z][\w-]*")
_KEYWORD = re.compile(r"[A-Z][A-Z_]+")


def names_of_cmake(text: str) -> Iterator[Mention]:
    """The executables and components that a `CMakeLists.txt` makes, and the packages that it names."""
    for command in _all(commands(text)):
        words = [word for word in command.words if "$" not in word.text]
        if command.name in _EXECUTABLES and command.words[:1] == tuple(words[:1]):
            yield from (_at(word, Entry("program", word.text, "declares")) for word in words[:1])
        elif command.name in _COMPONENTS:
            yield from _of_components(command.name, words)
        elif command.name in _PACKAGES:
            yield from (_at(word, Entry("package", word.text, "uses")) for word in _packages(command.name, words))


def _all(found: Iterable[Command]) -> Iterator[Command]:
    for command in found:
        yield command
        yield from _all(command.inner)


def _of_components(name: str, words: Sequence[Word]) -> Iterator[Mention]:
    """https://github.com/ros2/rclcpp/tree/rolling/rclcpp_components: `PLUGIN`, and the executable that runs it."""
    if name == _COMPONENTS[1]:
        yield from (_at(word, Entry("component", word.text, "declares")) for word in words[1:])
        return
    for keyword, word in pairwise(words):
        if keyword.text in ("PLUGIN", "EXECUTABLE"):
            yield _at(word, Entry("component" if keyword.text == "PLUGIN" else "program", word.text, "declares"))


def _packages(name: str, words: Sequence[Word]) -> Iterator[Word]:
    if name in _FIRST:
        listed = next((at for at, word in enumerate(words) if word.text == _LISTED), len(words))
        # In ROS 1 `find_package(catkin REQUIRED COMPONENTS ...)` finds packages; of other ones they are parts.
        words = [*words[:1], *(words[listed + 1 :] if words and words[0].text == "catkin" else ())]
    elif name in _ALL_BUT_FIRST:
        words = words[1:]
    return (word for word in words if _NAME.fullmatch(word.text) and not _KEYWORD.fullmatch(word.text))


def names_of_setup(program: Program) -> Iterator[Mention]:
    """The executables that a `setup.py` makes."""
    for each in program.quoted:
        if (found := _ENTRY_POINT.fullmatch(each.text)) is not None:
            start = each.place.start
            yield mention(start + found.start(1), start + found.end(1), Entry("program", found[1], "declares"))


def names_of_settings(text: str) -> Iterator[Mention]:
    """The executables that a `setup.cfg` makes."""
    at, section = 0, ""
    for line in text.splitlines(keepends=True):
        found = _ENTRY_POINT.fullmatch(line.rstrip())
        if line.startswith("["):
            section = line.strip()
        elif section == "[options.entry_points]" and found is not None and line[:1].isspace():
            yield mention(at + found.start(1), at + found.end(1), Entry("program", found[1], "declares"))
        at += len(line)


def _at(word: Word, entry: Entry) -> Mention:
    return mention(word.at, word.at + len(word.text), entry)
