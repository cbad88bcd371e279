"""Classes of messages, services and actions that were not generated, or are not installed.

They are made of definitions. Without one a class has any field; its type is known by its name in any case. Names and
attributes are those of genpy's (http://wiki.ros.org/msg) and rosidl's generators
(https://design.ros2.org/articles/generated_interfaces_python.html).
"""

from __future__ import annotations

import array
import importlib
import re
import sys
import types
from typing import Any, Optional

from ..anything import Anything, importer, used, wanted_names
from .definitions import Definition, Definitions, Field, default_value, parse, parts

_NUMBERS = re.compile(r"(u?int(8|16|32|64)|byte|char)\Z")
_CODES = {"float32": "f", "float64": "d", "int8": "b", "uint8": "B", "int16": "h", "uint16": "H", "int32": "i",
          "uint32": "I", "int64": "q", "uint64": "Q"}  # fmt: skip
_ROS1_ACTION = ("Action", "ActionGoal", "ActionResult", "ActionFeedback", "Goal", "Result", "Feedback")
_ACTION_FIELDS = {
    "Action": "{0}ActionGoal action_goal\n{0}ActionResult action_result\n{0}ActionFeedback action_feedback",
    "ActionGoal": "std_msgs/Header header\nactionlib_msgs/GoalID goal_id\n{0}Goal goal",
    "ActionResult": "std_msgs/Header header\nactionlib_msgs/GoalStatus status\n{0}Result result",
    "ActionFeedback": "std_msgs/Header header\nactionlib_msgs/GoalStatus status\n{0}Feedback feedback",
}
"""http://wiki.ros.org/actionlib/DetailedDescription"""
_CONSTANT = re.compile(r"[A-Z][A-Z0-9_]+\Z")


class InterfaceModule(types.ModuleType):
    """`package.msg`, `package.srv` or `package.action`."""

    def __init__(self, name: str, maker: Maker) -> None:
        super().__init__(name)
        self.__path__: list[str] = []
        self._preflight_maker = maker

    def __getattr__(self, name: str) -> Any:
        package, _, kind = self.__name__.partition(".")
        if name == "__all__":
            return self._preflight_maker.names(package, kind) or wanted_names()
        if name.startswith("_"):
            raise AttributeError(f"module '{self.__name__}' has no attribute '{name}'")
        return self._preflight_maker.get(package, kind, name)


class Maker:
    """Makes the classes of one generation of ROS, each once."""

    def __init__(self, generation: int, definitions: Definitions) -> None:
        self._generation = generation
        self._definitions = definitions
        self._made: dict[tuple[str, str, str], Any] = {}

    def names(self, package: str, kind: str) -> list[str]:
        """All that `import *` gives."""
        found = self._definitions.names(package, kind)
        if self._generation == 1 and kind == "msg":
            actions = self._definitions.names(package, "action")
            found = found + [name + suffix for name in actions for suffix in _ROS1_ACTION]
        if self._generation == 1 and kind == "srv":
            found = [name + suffix for name in found for suffix in ("", "Request", "Response")]
        return found

    def get(self, package: str, kind: str, name: str) -> Any:
        """The class of that name. Raises `AttributeError` where the package is there and has none."""
        key = (package, kind, name)
        if key not in self._made:
            self._made[key] = self._make(package, kind, name)
        found = self._made[key]
        for each in (found, *(getattr(found, part, None) for part in ("Request", "Response", "Goal", "Result"))):
            if getattr(each, "_preflight_any", False):
                _add_constants(each)
        return found

    def _make(self, package: str, kind: str, name: str) -> Any:
        text = self._definitions.text(package, kind, name)
        if self._generation == 1:
            return self._ros1(package, kind, name, text)
        if kind == "msg":
            return self._class(package, kind, name, text)
        subparts = ("Request", "Response") if kind == "srv" else ("Goal", "Result", "Feedback")
        texts = parts(text) if text is not None else []
        made = type(name, (), {"__module__": f"{package}.{kind}", "_preflight_text": text})
        for at, part in enumerate(subparts):
            setattr(made, part, self._class(package, kind, f"{name}_{part}", texts[at] if at < len(texts) else None))
        return made

    def _ros1(self, package: str, kind: str, name: str, text: Optional[str]) -> Any:
        if kind == "srv":
            for suffix, at in (("Request", 0), ("Response", 1)):
                whole = self._definitions.text(package, "srv", name[: -len(suffix)]) if name.endswith(suffix) else None
                if text is None and (whole is not None or (name.endswith(suffix) and name != suffix)):
                    found = parts(whole) if whole is not None else []
                    return self._class(package, kind, name, found[at] if at < len(found) else whole and "")
            self._must_be_possible(package, kind, name, text)
            service = type(name, (), {"__module__": f"{package}.srv", "_type": f"{package}/{name}", "_md5sum": ""})
            service._request_class = self.get(package, kind, name + "Request")  # type: ignore[attr-defined]
            service._response_class = self.get(package, kind, name + "Response")  # type: ignore[attr-defined]
            return service
        if kind == "msg" and text is None:
            text = self._of_action(package, name)
            self._must_be_possible(package, kind, name, text)
        return self._class(package, kind, name, text)

    def _of_action(self, package: str, name: str) -> Optional[str]:
        """The definition of a message that is made of an action's."""
        for suffix in _ROS1_ACTION:
            base = name[: -len(suffix)]
            if (
                not name.endswith(suffix)
                or not base
                or (suffix in ("Goal", "Result", "Feedback") and base.endswith("Action"))
            ):
                continue
            whole = self._definitions.text(package, "action", base)
            if suffix in _ACTION_FIELDS:
                return _ACTION_FIELDS[suffix].format(base)
            if whole is not None:
                return (*parts(whole), "", "")[("Goal", "Result", "Feedback").index(suffix)]
        return None

    def _must_be_possible(self, package: str, kind: str, name: str, text: Optional[str]) -> None:
        if text is None and self._definitions.has_package(package) and self._definitions.names(package, kind):
            raise AttributeError(f"module '{package}.{kind}' has no attribute '{name}'")

    def _class(self, package: str, kind: str, name: str, text: Optional[str]) -> Any:
        definition = parse(text) if text is not None else None
        base = importlib.import_module("genpy").Message if self._generation == 1 else object
        attributes: dict[str, Any] = dict(vars(_AnyFields if definition is None else _Fields))
        for unwanted in ("__dict__", "__weakref__", "__doc__", "__slots__"):
            attributes.pop(unwanted, None)
        attributes.update(
            __module__=f"{package}.{kind}",
            _preflight_any=definition is None,
            _preflight_definition=definition,
            _preflight_maker=self,
            _preflight_package=package,
            _type=f"{package}/{name}",
            _md5sum="",
            _full_text=text or "",
            _has_header=False,
            _slot_types=[],
        )
        made: Any = type(name, (base,), attributes)
        if definition is not None:
            for constant, value in definition.constants.items():
                setattr(made, constant, value)
            made._slot_types = [_type_text(field) for field in definition.fields]
        # As an attribute it only tells what the fields are: instances have a dictionary.
        made.__slots__ = [field.name for field in definition.fields] if definition is not None else []
        return made

    def value(self, package: str, field: Field) -> Any:
        """What a field has at first."""
        if field.array is not None:
            if field.type in _CODES and self._generation == 2:
                return array.array(_CODES[field.type], [0] * max(0, field.array))
            if field.type in ("uint8", "char") and self._generation == 1:
                return b"\0" * max(0, field.array)
            return [self._one(package, field) for _ in range(max(0, field.array))]
        given = default_value(field) if self._generation == 2 else None
        return self._one(package, field) if given is None else given

    def _one(self, package: str, field: Field) -> Any:
        kind = field.type
        if kind == "bool":
            return False
        if _NUMBERS.match(kind):
            return b"\0" if kind == "byte" and self._generation == 2 else 0
        if kind.startswith("float"):
            return 0.0
        if kind in ("string", "wstring"):
            return ""
        if kind in ("time", "duration"):
            return getattr(importlib.import_module("genpy"), kind.capitalize())()
        if kind == "Header":
            kind = "std_msgs/Header"
        of, _, name = kind.replace("/msg/", "/").rpartition("/")
        return getattr(importlib.import_module(f"{of or package}.msg"), name)()


def _type_text(field: Field) -> str:
    if field.array is None:
        return field.type
    return f"{field.type}[{field.array if field.array >= 0 else ''}]"


class _Fields:
    """What a class has whose fields are known."""

    __slots__: Any = ()
    _preflight_definition: Definition
    _preflight_maker: Maker
    _preflight_package: str

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        fields = self._preflight_definition.fields
        given = dict(zip((field.name for field in fields), args))
        given.update(kwargs)
        for field in fields:
            made = given.pop(field.name, None)
            if made is None:
                made = self._preflight_maker.value(self._preflight_package, field)
            setattr(self, field.name, made)
        if given:
            raise AttributeError(f"{type(self).__name__} has no field {next(iter(given))!r}")

    def __eq__(self, other: object) -> bool:
        return type(other) is type(self) and vars(other) == vars(self)

    __hash__ = object.__hash__

    def serialize(self, buff: Any) -> None:
        """Nobody hears it."""

    def deserialize(self, data: Any) -> Any:
        return self

    @classmethod
    def get_fields_and_field_types(cls) -> dict[str, str]:
        kinds = {"bool": "boolean", "float64": "double", "float32": "float"}
        return {
            field.name: kinds.get(field.type, field.type) + ("" if field.array is None else "[]")
            for field in cls._preflight_definition.fields
        }


class _AnyFields:
    """What a class has whose fields are not known."""

    __slots__: Any = ()

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        for name, value in kwargs.items():
            setattr(self, name, value)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        used()
        made = Anything(f"{type(self).__name__}.{name}")
        setattr(self, name, made)
        return made

    def serialize(self, buff: Any) -> None:
        """Nobody hears it."""

    def deserialize(self, data: Any) -> Any:
        return self

    @classmethod
    def get_fields_and_field_types(cls) -> dict[str, str]:
        return {}


def _add_constants(made: Any) -> None:
    """What the importing program uses of the class, or of any other, that is called like a constant."""
    frame = importer()
    codes = [frame.f_code] if frame is not None else []
    while codes:
        code = codes.pop()
        codes += [each for each in code.co_consts if isinstance(each, types.CodeType)]
        for name in code.co_names:
            if _CONSTANT.match(name) and name not in vars(made):
                setattr(made, name, Anything(f"{made.__name__}.{name}"))


def is_stand_in(described: Any) -> bool:
    """Whether a class of messages, services or actions was made here."""
    return isinstance(sys.modules.get(str(getattr(described, "__module__", ""))), InterfaceModule)
