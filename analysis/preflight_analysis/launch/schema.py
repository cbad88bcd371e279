"""What a launch language is as data: tags, their attributes, and what the values of those are.

`schema_ros1.py` is made of this, and so are the actions of ROS 2 (`evaluation/ros2/actions/`); validation, completion
and hover read them.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

from preflight_analysis.dataclass import dataclass

Kind = Literal[
    "text",
    "prose",
    "condition",
    "flag",
    "choice",
    "integer",
    "number",
    "package",
    "executable",
    "component",
    "launch-file",
    "yaml-file",
    "file",
    "argument",
    "parameter",
    "variable",
    "machine",
    "namespace",
    "node",
    "remap-from",
    "remap-to",
]
"""What an attribute's value is. `prose`: a sentence for people; `condition`: true, false, 1 or 0; `flag`: true or
false; `choice`: one of `choices`; `executable`, `component`: a program of the package in `pkg`, or a class of it
for a container; `argument`, `parameter`, `variable` (of the environment), `machine`, `node`: its name; `remap-from`,
`remap-to`: the name of a topic, service or action."""


Taken = Literal["", "verbatim", "performed", "text", "command-line", "seconds"]
"""How the launcher of ROS 2 takes a value, where that is not usual for its kind. `verbatim`: a text without
substitutions; `performed`: no text, and yet with substitutions; `text`: no text, and yet taken as one;
`command-line`: a text that is split into words; `seconds`: a number that is not negative."""


@dataclass(frozen=True, slots=True)
class Attribute:
    """An attribute of a tag. `required`: without it the launcher stops."""

    name: str
    doc: str
    kind: Kind = "text"
    choices: tuple[str, ...] = ()
    default: str | None = None
    required: bool = False
    taken: Taken = ""


@dataclass(frozen=True, slots=True)
class Tag:
    """What a tag may have, in the order in which it should be offered. `attributes` includes the conditions;
    `children` are the tags that the launcher reads there; `text` tells whether it reads the text between the tags."""

    doc: str
    attributes: Mapping[str, Attribute]
    children: tuple[str, ...] = ()
    text: bool = False
    refused: tuple[str, ...] = ()
    """Attributes and children on which roslaunch stops, where others that it does not know get a warning."""
    named_by: tuple[str, ...] = ()
    """The attributes that name one tag in an outline; the first that is there counts."""
    detail: tuple[str, ...] = ()
    """Those that say what is worth a glance beside the name; the first that is there counts."""
    starts: bool = False
    """Whether it starts nodes or processes, itself or by what it holds: worth a word where its condition is false."""

    @property
    def required(self) -> tuple[str, ...]:
        """The attributes without which the launcher stops."""
        return tuple(a.name for a in self.attributes.values() if a.required)


def one_of(choices: tuple[str, ...]) -> str:
    """The choices in words: `load, dump or delete`."""
    *others, last = choices
    return f"{', '.join(others)} or {last}" if others else last
