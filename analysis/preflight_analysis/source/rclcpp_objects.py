"""The objects of rclcpp that the interpreter of C++ has: nodes, their options, and parameters."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from preflight_analysis.dataclass import dataclass
from preflight_analysis.evaluation import names
from preflight_analysis.source.cpp_operators import converted, initialized
from preflight_analysis.source.cpp_text import ClassText, FileText
from preflight_analysis.source.cpp_values import Argument, Class, CppType, Fluent, Instance, Unmade, value_at
from preflight_analysis.source.python_values import UNKNOWN
from preflight_analysis.source.rclcpp_api import NODES

POINTERS = re.compile(r"::(?:(?:Const)?(?:Shared|Weak|Unique)Ptr)\Z")
_OVERRIDES = "automatically_declare_parameters_from_overrides"
_ALL = ("allow_undeclared_parameters", _OVERRIDES)
RANGES = {"integer": "integer_range", "double": "floating_point_range"}


@dataclass(frozen=True, slots=True)
class NodeObject:
    """An object of a node class. `full` is None for the node that the launch file starts, else the full name of a
    further one of its process, UNKNOWN if that is not known."""

    full: Any = None
    below: str = ""
    """The namespace of a sub-node."""
    has_lifecycle: bool = False
    from_overrides: bool = False
    """Whether it declares what the launch sets before its own code does: with any type."""

    def name(self, name: Any) -> Any:
        """The name as the node of the launch file would give it."""
        if not isinstance(name, str) or not name or self.full is UNKNOWN:
            return UNKNOWN
        if name.startswith("/"):
            return name
        if name.startswith("~"):
            return name if self.full is None else names.canonicalize(f"{self.full}/{name[1:]}")
        below = f"{self.below}/{name}" if self.below else name
        return below if self.full is None else names.canonicalize(f"{names.parent(self.full)}/{below}")

    def param(self, name: str) -> Any:
        """The name of a parameter, likewise."""
        return UNKNOWN if self.full is UNKNOWN else f"~{name}" if self.full is None else f"{self.full}/{name}"


@dataclass(frozen=True, slots=True)
class Options(Fluent):
    """`rclcpp::NodeOptions`: whether the node takes any parameter, and the arguments that it gets of its own."""

    takes_all: bool = False
    from_overrides: bool = False
    arguments: tuple[Any, ...] = ()
    of_process: bool = True
    """Whether the node takes the arguments of its process, too."""


@dataclass(frozen=True, slots=True)
class Parameter:
    """`rclcpp::Parameter` or its value. `typed`: the value has the type that the parameter has."""

    value: Any
    typed: bool = True
    is_set: bool = True


UNSET: Any = object()
"""The default of a parameter that is declared without one."""


def qualified(type_: CppType) -> str:
    """The name of a type with the namespace that is used where it stands, for those of nodes."""
    name = POINTERS.sub("", type_.name.removeprefix("::"))
    if "::" not in name and type_.file is not None:
        for space in type_.file.namespaces:
            if (full := "::".join((*space, name))) in NODES:
                return full
    return name


def node_of(value: Any) -> NodeObject | None:
    """The node that a value is or points to, None if it is none."""
    if isinstance(value, NodeObject):
        return value
    if isinstance(value, Instance):
        return next((base for base in value.bases if isinstance(base, NodeObject)), None)
    if isinstance(value, Unmade):
        name = qualified(value.type)
        if name in NODES or name.startswith("rclcpp::node_interfaces::Node"):
            return NodeObject()
    return None


def first_node(given: Sequence[Any]) -> NodeObject:
    """The node among the arguments; the one that is started where none can be told."""
    return next((node for value in given if (node := node_of(value)) is not None), NodeObject())


def is_options(value: Any) -> bool:
    """Whether a value is options of a node, known or not."""
    return isinstance(value, Options) or (isinstance(value, Unmade) and value.type.name == "rclcpp::NodeOptions")


def changed_options(options: Options, name: str, args: Sequence[Argument]) -> Any:
    """Options of a node after a call of one of their methods."""
    first = value_at(args, 0)
    if not args:
        return UNKNOWN
    if name in _ALL:
        wanted = first is not False
        from_overrides = wanted if name == _OVERRIDES else options.from_overrides
        return replace(options, takes_all=options.takes_all or wanted, from_overrides=from_overrides)
    if name == "arguments":
        given = tuple(first) if isinstance(first, list) else (UNKNOWN,)
        return replace(options, arguments=given)
    if name == "use_global_arguments":
        return replace(options, of_process=first is True)
    return options


def parameter_of(found: Any) -> Parameter:
    """The parameter that has a value, or none."""
    return Parameter(UNKNOWN, is_set=False) if found is UNSET else Parameter(found)


def given_parameter(argument: Argument, type_: CppType | None) -> Parameter:
    """The value of a parameter as an argument gives it.

    Of a whole number in a variable the type is not known: what is written `double x = 1;` elsewhere is one too.
    """
    value = argument.value
    if isinstance(value, Parameter):
        return Parameter(converted(value.value, type_), value.typed)
    if type_ is None:
        whole = isinstance(value, int) and not isinstance(value, bool)
        return Parameter(value, not (whole and argument.reference is not None))
    if isinstance(value, list) and type_.args:
        return Parameter([converted(each, type_.args[0]) for each in value])
    return Parameter(initialized(value, type_))


def is_descriptor(value: Any) -> bool:
    """Whether a value is the message that describes a parameter."""
    return isinstance(value, Instance) and value.cls.text.name == "ParameterDescriptor"


def struct_of(name: str = "Params") -> Instance:
    """A struct whose fields are known and nothing else of it."""
    return Instance(Class(ClassText(name, (), (), (), (), FileText(""), 0), {}))


def parameter_message(name: str) -> Instance | None:
    """A message that describes a parameter."""
    space, _, name = name.rpartition("::")
    if space != "rcl_interfaces::msg" or name not in ("ParameterDescriptor", "IntegerRange", "FloatingPointRange"):
        return None
    made = struct_of(name)
    if name == "ParameterDescriptor":
        made.names.update((field, []) for field in RANGES.values())
    return made
