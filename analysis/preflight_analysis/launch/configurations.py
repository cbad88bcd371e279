"""Which launch configurations a ROS 2 launch file has to do with, whatever its conditions."""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.dataclass import dataclass
from preflight_analysis.incremental.derived import derived
from preflight_analysis.launch.model import Action, LaunchFile, Literal, Substitution
from preflight_analysis.launch.substitutions_ros2 import nested

IMPLICIT = frozenset({"launch-prefix", "launch-prefix-filter", "emulate_tty", "sigterm_timeout", "sigkill_timeout"})
"""Configurations that launch itself reads, of every process."""


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
