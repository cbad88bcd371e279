"""What the walk through a C++ program knows of a value, and what it asks about those of libraries."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import field
from typing import Any, Protocol

from tree_sitter import Node

from preflight_analysis.dataclass import dataclass
from preflight_analysis.source.branches import Branches
from preflight_analysis.source.cpp_text import ClassText, FileText, FunctionText, Path
from preflight_analysis.source.python_values import UNKNOWN

_MAX_CLASSES = 32


@dataclass(frozen=True, slots=True)
class CppType:
    """A type by its qualified name, with the arguments of the template that it is; qualifiers, `*` and `&` left out.

    `actionlib::SimpleActionServer<p::GoAction>::Ptr` has the name without the arguments.
    """

    name: str
    args: tuple[CppType, ...] = ()
    file: FileText | None = field(default=None, compare=False)
    """Where it stands: what that includes tells of a name without its namespace."""


@dataclass(eq=False, slots=True)
class Class:
    """A class of the program with the types that its template is given and its bases as far as they are known."""

    text: ClassText
    types: Mapping[str, CppType]
    bases: tuple[Class, ...] = ()

    def order(self) -> list[Class]:
        """The class and its known bases."""
        found: list[Class] = []
        pending: list[Class] = [self]
        while pending and len(found) < _MAX_CLASSES:
            cls = pending.pop(0)
            if cls not in found:
                found.append(cls)
                pending[:0] = cls.bases
        return found


@dataclass(eq=False, slots=True)
class Instance:
    """An object of a class of the program, or a pointer to one."""

    cls: Class
    names: dict[str, Any] = field(default_factory=dict)
    bases: list[Any] = field(default_factory=list)
    """Objects of libraries that it is derived from."""


@dataclass(frozen=True, slots=True)
class Unmade:
    """A pointer that points to nothing yet, or an object of a library of which nothing is known but its type."""

    type: CppType


@dataclass(eq=False, slots=True)
class Message:
    """A message, or a stamped transform of tf, with the fields that are set. Only what names frames is of interest."""

    type: CppType
    names: dict[str, Any] = field(default_factory=dict)

    def inner(self, name: str) -> Any:
        """A field: the header is a message itself, whatever it was set to; others are known once they are set."""
        value = self.names.get(name, UNKNOWN)
        if name != "header" or isinstance(value, Message):
            return value
        found = self.names[name] = Message(CppType("std_msgs::Header"))
        return found

    def copy(self) -> Message:
        """Another message that says the same."""
        return Message(self.type, {k: v.copy() if isinstance(v, Message) else v for k, v in self.names.items()})


@dataclass(eq=False, slots=True)
class Scope:
    """The names of one call of a function."""

    names: dict[str, Any]
    where: Path
    """The names of namespaces and classes around it."""
    file: FileText
    types: dict[str, CppType] = field(default_factory=dict)
    this: Instance | None = None
    parent: Scope | None = None


@dataclass(frozen=True, slots=True)
class Reference:
    """A name in a dictionary: what a parameter by reference stands for."""

    names: dict[str, Any]
    name: str


@dataclass(eq=False, slots=True)
class Function:
    """A function, a method that may be bound, or a lambda, as a value.

    `parameters` are the types of those that are still to be given, None for one that is not known.
    """

    text: FunctionText | None
    instance: Instance | None
    parameters: tuple[CppType | None, ...]
    body: Node | None = None
    """The lambda."""
    scope: Scope | None = None
    is_method: bool = False


class Fluent:
    """A value of a library whose methods give it as they changed it: the variable that holds it changes too."""

    __slots__ = ()


@dataclass(frozen=True, slots=True)
class Constant:
    """One of the values of a library's enumeration, by its own name."""

    name: str


@dataclass(frozen=True, slots=True)
class Placeholder:
    """The `_1` of a `bind`."""

    number: int


@dataclass(eq=False, slots=True)
class Stream:
    """A `std::ostringstream`; None among `parts` for what is not known."""

    parts: list[Any]


@dataclass(frozen=True, slots=True)
class Argument:
    """What is given for a parameter, and the variable that it is, if it is one."""

    value: Any
    reference: Reference | None = None


@dataclass(frozen=True, slots=True)
class Place:
    """Where a call stands, line from 1."""

    file: str
    line: int


Store = Callable[[Argument, Any], None]
"""Changes the variable that was given as an argument."""


@dataclass(frozen=True, slots=True)
class Call:
    """A call: `types` are its template arguments, `store` changes a variable that was given as an argument."""

    name: str
    types: Sequence[CppType]
    args: Sequence[Argument]
    place: Place
    store: Store


class Calls(Protocol):
    """What is known of libraries. Each answer is a value, UNKNOWN if it cannot be told."""

    @property
    def words(self) -> frozenset[str]:
        """Names of which one stands wherever there is something to tell: callbacks without one are left out."""

    def begin(self, branches: Branches) -> None:
        """The program begins; `branches` tells what may well not be done."""

    def takes(self, owner: Any, call: Call) -> bool:
        """Whether a call is told here although the program has the function: what it does is known. `owner` is None
        for a free function."""

    def notice(self, owner: Instance, call: Call) -> None:
        """A call of a method of the program, which is gone through next."""

    def dead_code(self, begins: bool) -> bool:
        """Whether what is not reached is gone through too; it then begins or ends here, and is not made."""

    def cut_short(self) -> None:
        """Not all of the program is gone through that may lead to a call."""

    def named(self, name: str) -> Any:
        """What a qualified name stands for that is not of the program."""

    def called_later(self, instance: Instance) -> Sequence[str]:
        """The methods of an object of the program that a base class of a library calls once it is there."""

    def make(self, type_: CppType, args: Sequence[Argument], place: Place) -> Any:
        """An object of a class that is not of the program."""

    def function(self, call: Call) -> Any:
        """A call of a function that is not of the program, by its qualified name as written."""

    def method(self, owner: Any, call: Call) -> Any:
        """A call of a method that is not of the program; of an `Instance` it is one of a library's base class."""


def values(args: Sequence[Argument]) -> list[Any]:
    """What the arguments are."""
    return [arg.value for arg in args]


def value_at(args: Sequence[Argument], index: int) -> Any:
    """The argument at `index`; UNKNOWN if there is none."""
    return args[index].value if 0 <= index < len(args) else UNKNOWN
