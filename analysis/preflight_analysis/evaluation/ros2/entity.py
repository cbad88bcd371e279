"""What a launch file of ROS 2 is made of, as declared by the modules of `actions/`: actions, and parts of them."""

from __future__ import annotations

from dataclasses import replace

from preflight_analysis.dataclass import dataclass
from preflight_analysis.launch.schema import Attribute, Tag, Taken

PARAM_TYPES = ("str", "bool", "float", "int", "list_of_str", "list_of_bool", "list_of_float", "list_of_int", "yaml")
"""`launch.frontend.type_utils.get_data_type_from_identifier`."""

CONDITIONS = (
    Attribute("if", "Execute this only if it is true (or 1).", "condition", ("true", "false")),
    Attribute("unless", "Execute this only if it is false (or 0).", "condition", ("true", "false")),
)
CONFIGURATION_NAME = Attribute("name", "The name of the launch configuration.", "argument", required=True)
NAMESPACE = Attribute(
    "namespace", "The namespace, relative to the pushed one unless it starts with a slash.", "namespace"
)
VARIABLE = Attribute("name", "The name of the variable.", "variable", required=True)


@dataclass(frozen=True, slots=True, kw_only=True)
class Entity:
    """A kind of thing in launch files: `launch.frontend.Entity`."""

    kind: str
    tag: Tag | None
    """What XML and YAML files may say of it, without the actions inside; None: only Python launch files have it."""
    holds_actions: bool = False
    """Whether it may have actions inside, which count as if they stood in the file itself."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Part(Entity):
    """What belongs to the action around it, which reads it."""

    of: tuple[str, ...]
    """The kinds that read it."""


def action_tag(
    doc: str,
    *attributes: Attribute,
    children: tuple[str, ...] = (),
    named_by: tuple[str, ...] = (),
    detail: tuple[str, ...] = (),
    starts: bool = False,
) -> Tag:
    """A tag with conditions. launch stops at what it does not read."""
    return part_tag(doc, *attributes, *CONDITIONS, children=children, named_by=named_by, detail=detail, starts=starts)


def part_tag(
    doc: str,
    *attributes: Attribute,
    children: tuple[str, ...] = (),
    named_by: tuple[str, ...] = (),
    detail: tuple[str, ...] = (),
    starts: bool = False,
) -> Tag:
    """A tag without conditions of its own."""
    return Tag(doc, {a.name: a for a in attributes}, children, named_by=named_by, detail=detail, starts=starts)


def flag(name: str, doc: str, default: str = "false", taken: Taken = "") -> Attribute:
    """An attribute that is true or false."""
    return Attribute(name, doc, "flag", ("true", "false"), default, taken=taken)


def required(attribute: Attribute) -> Attribute:
    """The same, where launch stops without it."""
    return replace(attribute, required=True)
