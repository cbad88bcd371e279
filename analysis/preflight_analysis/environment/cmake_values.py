"""What the words of a command come to: variables, lists, files, conditions."""

from __future__ import annotations

import fnmatch
import os
import re
from collections.abc import Callable, Iterator, Mapping, Sequence

from preflight_analysis.documents.disk import Disk
from preflight_analysis.environment.build import MADE
from preflight_analysis.environment.cmake_syntax import MAX_DEPTH, Word
from preflight_analysis.environment.walk import walk

_MAX_TEXT = 100_000
_MAX_FILES = 2_000
SOURCES = (".cpp", ".cc", ".cxx", ".c++", ".C", ".c", ".cu")
"""Endings of source files."""
_VARIABLE = re.compile(r"\$\{([^${}]*)\}")
_PLATFORM = {"UNIX": True} | dict.fromkeys(("WIN32", "APPLE", "MSVC", "ANDROID", "CYGWIN", "MINGW"), False)
"""Conditions whose value is known: what robots run on is Linux."""
_ROS_VERSION = frozenset({"$ENV{ROS_VERSION}", "${ROS_VERSION}", "ROS_VERSION"})
"""By convention what `ROS_VERSION` is in the environment."""
_NO_SOURCES = frozenset(
    "WIN32 MACOSX_BUNDLE EXCLUDE_FROM_ALL STATIC SHARED MODULE OBJECT PUBLIC PRIVATE INTERFACE".split()  # noqa: SIM905
)


def known_condition(condition: Sequence[Word], generation: int | None = None) -> bool | None:
    """Whether a condition holds; None where that depends on more than the platform and the `generation` of ROS that is
    built for. Without one it is an `else`."""
    words = [word.text for word in condition]
    negated = words[:1] == ["NOT"]
    match words[negated:]:
        case [platform] if platform in _PLATFORM:
            return _PLATFORM[platform] is not negated
        case [version, "EQUAL" | "STREQUAL", number] if version in _ROS_VERSION and generation is not None:
            return (number == str(generation)) is not negated
    return None


def is_only_known_to_cmake(variables: Mapping[str, str]) -> Callable[[Word], bool]:
    """Whether a word has a variable that is not known here, or is in a folder of what is made."""
    return lambda word: any(MADE in variables.get(name, MADE) for name in _VARIABLE.findall(word.text))


def words_of(words: Sequence[Word], variables: Mapping[str, str]) -> list[str]:
    """The words with their variables replaced, lists as their items; quoted ones stay one word each."""
    found: list[str] = []
    for word in words:
        text = expanded(word.text, variables)
        found += [text] if word.quoted else [part for part in text.split(";") if part]
    return found


def expanded(text: str, variables: Mapping[str, str]) -> str:
    """A text with its variables replaced; one that nothing sets is empty."""
    for _ in range(MAX_DEPTH):
        if "${" not in text:
            break
        new = _VARIABLE.sub(lambda found: variables.get(found[1], ""), text)
        if new == text:
            break
        text = new[:_MAX_TEXT]
    return text


def parsed_arguments(prefix: str, options: str, ones: str, many: str, given: Sequence[str]) -> dict[str, str]:
    """What `cmake_parse_arguments` sets: each keyword's words, under its name with the prefix."""
    keywords = dict.fromkeys(options.split(";"), 0) | dict.fromkeys(ones.split(";"), 1)
    keywords |= dict.fromkeys(many.split(";"), len(given))
    found: dict[str, list[str]] = {word: [] for word in keywords if word}
    current, left = "", 0
    for word in given:
        if word in found:
            current, left = word, keywords[word]
            found[word] = found[word] if left else ["TRUE"]
        elif left:
            found[current].append(word)
            left -= 1
    return {f"{prefix}_{word}": joined(words) for word, words in found.items()}


def joined(values: Sequence[str] | Iterator[str]) -> str:
    """A list as CMake has it in a variable."""
    return ";".join(value for value in values if value)[:_MAX_TEXT]


def source_files(disk: Disk, words: Sequence[str], folder: str) -> list[str]:
    """The source files among the words, of which those relative to `folder` are made absolute."""
    found: list[str] = []
    for word in words:
        path = os.path.normpath(os.path.join(folder, word))
        if word in _NO_SOURCES or "$<" in word:
            continue
        if word.endswith(SOURCES):
            found.append(path)
        elif not os.path.splitext(word)[1]:  # CMake tries the endings that it knows
            found += [path + ending for ending in SOURCES if disk.is_file(path + ending)][:1]
    return found


def globbed(disk: Disk, patterns: Sequence[str], folder: str, deep: bool) -> list[str]:
    """The files that match `file(GLOB ...)`, in the folders below too if `deep`."""
    found: list[str] = []
    wanted = [p for p in patterns if p not in ("CONFIGURE_DEPENDS", "FOLLOW_SYMLINKS", "RELATIVE", "LIST_DIRECTORIES")]
    for pattern in wanted:
        top, name = os.path.split(os.path.normpath(os.path.join(folder, pattern)))
        if not name or any(mark in top for mark in "*?["):
            continue
        seen = 0
        for place, folders, files in walk(top):
            disk.names(place)  # it is made again as something in it comes or goes
            found += sorted(os.path.join(place, file) for file in files if fnmatch.fnmatchcase(file, name))
            seen += len(files)
            if not deep or seen > _MAX_FILES:
                folders.clear()
            if seen > _MAX_FILES:
                break
    return found[:_MAX_FILES]
