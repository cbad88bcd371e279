"""Which launch configurations a ROS 2 launch file has to do with, whatever its conditions."""

from __future__ import annotations

import ast
import re
import sys
from collections.abc import Iterator
from fnmatch import fnmatchcase

from preflight_analysis.dataclass import dataclass
from preflight_analysis.incremental.derived import derived
from preflight_analysis.launch.model import Action, LaunchFile, Literal, Substitution
from preflight_analysis.launch.python_source import last_name, python_source
from preflight_analysis.launch.substitutions_ros2 import nested

IMPLICIT = frozenset({"launch-prefix", "launch-prefix-filter", "emulate_tty", "sigterm_timeout", "sigkill_timeout"})
"""Configurations that launch itself reads, of every process."""

_MODULES = frozenset(
    {
        *sys.stdlib_module_names,
        *("ament_index_python", "launch", "launch_ros", "launch_testing", "launch_xml", "launch_yaml"),
        *("moveit_configs_utils", "nav2_common", "numpy", "xacro", "yaml"),
    }
)
"""Modules that have nothing to do with the configurations of the file which imports them."""
_HOLE = re.compile(r"\{[^{}]*\}|%(?:\(\w+\))?[-#0 +]*\d*[sdri]")
"""What `format` or `%` puts into a text."""
_OF_ALL = re.compile(r"\.launch_configurations\b(?!\s*(?:\[|\.(?:get|pop|setdefault)\b))")
"""All configurations at once, and not one by its name."""


@dataclass(frozen=True, slots=True)
class Names:
    """Which configurations something has to do with. `in_code` are the texts in code, of which any may be the name of
    one, and those with `*` a part of it."""

    known: frozenset[str] = frozenset()
    in_code: frozenset[str] = frozenset()

    def __or__(self, other: Names) -> Names:
        return Names(self.known | other.known, self.in_code | other.in_code)

    def may_have(self, name: str) -> bool:
        """Whether `name` may be one of them."""
        return name in self.known or any(fnmatchcase(name, each) for each in self.in_code)


@dataclass(frozen=True, slots=True)
class Configurations:
    """`declared` by `<arg>`, `used` by `$(var)` and by launch itself; `computed`: a name is not written as it is."""

    declared: frozenset[str]
    used: frozenset[str]
    computed: bool


@derived
def configurations_of(launch_file: LaunchFile) -> Configurations:
    """All names of one file."""
    declared: set[str] = set()
    used: set[str] = set()
    computed = False
    for action in launch_file.root.walk() if launch_file.root is not None else ():
        name = action.value("name")
        if action.kind == "arg" and name is not None:
            declared.add(name.text)
        for substitution in substitutions_of(action):
            if substitution.command == "var":
                text = literal(substitution.words[0]) if substitution.words else None
                if text is None:
                    computed = True
                else:
                    used.add(text)
    return Configurations(frozenset(declared), frozenset(used), computed)


def substitutions_of(action: Action) -> Iterator[Substitution]:
    """All substitutions in the values of one action, inner ones too."""
    for attribute in action.attributes:
        yield from nested(attribute.value.parts)


def literal(parts: tuple[Literal | Substitution, ...]) -> str | None:
    """The text of pieces without any substitution."""
    return None if any(isinstance(p, Substitution) for p in parts) else "".join(p.text for p in parts)


@derived
def names_in_code(launch_file: LaunchFile) -> frozenset[str] | None:
    """The texts in a Python launch file, see `Names`; None where its code may do with configurations what it likes:
    it asks for all of them, hands them to modules of others, or includes what this launch did not."""
    source = python_source(launch_file.document)
    if source.module is None or _OF_ALL.search(source.text):
        return None
    texts: set[str] = set()
    written = 0
    for node in ast.walk(source.module):
        if isinstance(node, ast.Import) and not all(alias.name.partition(".")[0] in _MODULES for alias in node.names):
            return None
        if isinstance(node, ast.ImportFrom) and (node.level or (node.module or "").partition(".")[0] not in _MODULES):
            return None
        if isinstance(node, ast.Call) and last_name(node.func) == "IncludeLaunchDescription":
            written += 1
        if isinstance(node, ast.JoinedStr):
            texts.add("".join(str(each.value) if isinstance(each, ast.Constant) else "*" for each in node.values))
        elif isinstance(node, ast.Constant) and isinstance(node.value, str):
            texts.add(_HOLE.sub("*", node.value))
            # Put together with others: 'left_' + name.
            texts.update((f"{node.value}*",) if node.value.endswith("_") else ())
            texts.update((f"*{node.value}",) if node.value.startswith("_") else ())
    root = launch_file.root
    included = sum(action.kind == "include" for action in root.walk()) if root is not None else 0
    return None if written > included or not all(text.strip("*") for text in texts if text) else frozenset(texts)
