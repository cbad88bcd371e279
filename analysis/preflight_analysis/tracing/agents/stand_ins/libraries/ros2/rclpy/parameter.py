"""Parameters and their types (https://docs.ros.org/en/jazzy/Concepts/Basic/About-Parameters.html)."""

from __future__ import annotations

import array
import enum
from typing import Any

PARAMETER_SEPARATOR_STRING = "."


class Type(enum.Enum):
    """Types of parameters."""

    NOT_SET = 0
    BOOL = 1
    INTEGER = 2
    DOUBLE = 3
    STRING = 4
    BYTE_ARRAY = 5
    BOOL_ARRAY = 6
    INTEGER_ARRAY = 7
    DOUBLE_ARRAY = 8
    STRING_ARRAY = 9

    @classmethod
    def from_parameter_value(cls, parameter_value: Any) -> Any:
        """The type of a value. Raises `TypeError` for what no parameter can have."""
        if parameter_value is None:
            return cls.NOT_SET
        for kind, name in ((bool, "BOOL"), (int, "INTEGER"), (float, "DOUBLE"), (str, "STRING")):
            if isinstance(parameter_value, kind):
                return cls[name]
        if isinstance(parameter_value, array.array) and parameter_value.typecode in "bBhHiIlLqQ":
            return cls.INTEGER_ARRAY
        if isinstance(parameter_value, array.array) and parameter_value.typecode in "fd":
            return cls.DOUBLE_ARRAY
        if isinstance(parameter_value, (list, tuple)):
            for item, name in (
                (bytes, "BYTE_ARRAY"),
                (bool, "BOOL_ARRAY"),
                (int, "INTEGER_ARRAY"),
                (float, "DOUBLE_ARRAY"),
                (str, "STRING_ARRAY"),
            ):
                if all(isinstance(each, item) for each in parameter_value):
                    return cls[name]
            raise TypeError("The given value is not a list of one of the allowed types")
        if hasattr(parameter_value, "_preflight_name"):
            return cls.STRING  # a value that is not known
        raise TypeError("The given value is not one of the allowed types")


_Type = Type


class Parameter:
    """A name with a value."""

    Type = _Type

    def __init__(self, name: str, type_: Any = None, value: Any = None) -> None:
        self.name = self._name = name
        self.type_ = self._type_ = _Type.from_parameter_value(value) if type_ is None else type_
        self.value = self._value = value
        if (
            type_ is not None
            and value is not None
            and _Type.from_parameter_value(value) != type_
            and not (isinstance(value, (list, tuple)) and not value)
        ):
            raise ValueError(f"Type '{type_}' and value '{value}' do not agree")

    @classmethod
    def from_parameter_msg(cls, param_msg: Any) -> Any:
        return cls(param_msg.name, value=getattr(param_msg, "value", None))

    def get_parameter_value(self) -> Any:
        """The value as a message."""
        import importlib  # noqa: PLC0415

        field = {"NOT_SET": None}.get(self.type_.name, self.type_.name.lower() + "_value")
        message = importlib.import_module("rcl_interfaces.msg").ParameterValue(type=self.type_.value)
        if field is not None:
            setattr(message, field, self.value)
        return message

    def to_parameter_msg(self) -> Any:
        import importlib  # noqa: PLC0415

        return importlib.import_module("rcl_interfaces.msg").Parameter(name=self.name, value=self.get_parameter_value())


def parameter_value_to_python(parameter_value: Any) -> Any:
    """A message's value."""
    kind = _Type(parameter_value.type)
    return None if kind is _Type.NOT_SET else getattr(parameter_value, kind.name.lower() + "_value")


def get_parameter_value(string_value: str) -> Any:
    """The value that a text of the command line has, as a message."""
    import importlib  # noqa: PLC0415

    value = importlib.import_module("yaml").safe_load(string_value)
    kind = _Type.from_parameter_value(value)
    return Parameter("value", kind, value).get_parameter_value()


def parameter_dict_from_yaml_file(
    parameter_file: str, use_wildcard: bool = False, target_nodes: Any = None, namespace: str = ""
) -> Any:
    """The parameters of the nodes of a file, as messages by name."""
    import importlib  # noqa: PLC0415

    with open(parameter_file, encoding="utf-8") as file:
        sections = importlib.import_module("yaml").safe_load(file) or {}
    wanted, found = {each.strip("/") for each in target_nodes or ()}, {}
    for node, section in sections.items():
        if not wanted or node.strip("/") in wanted or (use_wildcard and node == "/**"):
            for name, value in section.get("ros__parameters", {}).items():
                kind = _Type.from_parameter_value(value)
                found[namespace + name] = Parameter(name, kind, value).to_parameter_msg()
    return found
