"""Launch arguments as given on a command line."""

from __future__ import annotations

import re
from collections.abc import Iterable

from preflight_analysis.evaluation import names

_REMAP = re.compile(r"([~/A-Za-z]|_|__)[\w/]*:=.*\Z", re.DOTALL)


def parse_arguments(words: Iterable[str]) -> dict[str, str]:
    """`name:=value` words as a mapping; the last one wins. What roslaunch ignores is left out.

    `_name:=value` is a private parameter assignment, not an argument (http://wiki.ros.org/Remapping%20Arguments).
    """
    found: dict[str, str] = {}
    for word in words:
        if _REMAP.match(word) is None or word.count(":=") != 1:
            continue
        name, value = (part.strip() for part in word.split(":="))
        private = len(name) > 1 and name[0] == "_" and name[1] != "_"
        if name and value and not private:
            found[name] = value
    return found


def remaps_in(words: Iterable[str]) -> tuple[tuple[str, str], ...]:
    """The remaps among the arguments of a node of ROS 1: `scan:=base_scan`. What begins with `_` is none."""
    pairs = (word.partition(":=") for word in words if ":=" in word and not word.startswith(("_", "-")))
    return tuple((name, value) for name, _, value in pairs if names.is_legal(name) and names.is_legal(value))


def parse_ros2_arguments(words: Iterable[str]) -> dict[str, str]:
    """The same for `ros2 launch`, which takes any name, and a value with `:=` in it. At a word that is no argument it
    stops; here that is left out."""
    pairs = (word.partition(":=") for word in words)
    return {name: value for name, separator, value in pairs if name and separator and value}


_PARSE = {1: parse_arguments, 2: parse_ros2_arguments}


def arguments_of(generation: int, words: Iterable[str]) -> dict[str, str]:
    """Those of the launcher of a generation of ROS."""
    return _PARSE[generation](words)
