"""XML-RPC calls and answers (http://xmlrpc.com/spec.md), as far as a ROS master needs them.

The standard library's module does the same, but its import takes longer than a roscpp node's whole start.
"""

from __future__ import annotations

import binascii
from typing import Any
from xml.parsers import expat

_MAX_DEPTH = 200
_INTEGERS = frozenset(("int", "i1", "i2", "i4", "i8", "biginteger"))


class Binary:
    """A value of type base64."""

    def __init__(self, data: bytes) -> None:
        self.data = data


class Moment:
    """A value of type dateTime.iso8601, as it was written."""

    def __init__(self, text: str) -> None:
        self.text = text


class _Reader:
    """Makes values of the elements as they come: each open `value`, `array` or `struct` has a list on the stack."""

    def __init__(self) -> None:
        self.method = ""
        self.values: list[Any] = []
        self._open: list[list[Any]] = [self.values]
        self._plain: list[bool] = []
        """Of each open `value`: whether it has no element inside, and so is a string."""
        self._text: list[str] = []

    def start(self, tag: str, _attributes: Any) -> None:
        if tag == "value":
            self._plain.append(True)
        elif self._plain:
            self._plain[-1] = False
        if tag in ("array", "struct"):
            if len(self._open) > _MAX_DEPTH:
                raise ValueError("nested too deeply")
            self._open.append([])
        self._text = []

    def data(self, text: str) -> None:
        self._text.append(text)

    def end(self, tag: str) -> None:
        text, self._text = "".join(self._text), []
        here = self._open[-1]
        if tag == "value":
            if self._plain.pop():
                here.append(text)
            if self._plain:
                self._plain[-1] = False
        elif tag in ("string", "name"):
            here.append(text)
        elif tag in _INTEGERS:
            here.append(int(text))
        elif tag == "boolean":
            if text not in ("0", "1"):
                raise ValueError("no boolean")
            here.append(text == "1")
        elif tag in ("double", "float"):
            here.append(float(text))
        elif tag == "nil":
            here.append(None)
        elif tag == "base64":
            here.append(Binary(binascii.a2b_base64(text)))
        elif tag == "dateTime.iso8601":
            here.append(Moment(text.strip()))
        elif tag == "array":
            self._open[-2].append(self._open.pop())
        elif tag == "struct":
            members = self._open.pop()
            self._open[-1].append(dict(zip(members[::2], members[1::2])))
        elif tag == "methodName":
            self.method = text.strip()


def read_call(body: bytes) -> tuple[str, tuple[Any, ...]]:
    """The method and the arguments of a call. Raises `ValueError` if it is none."""
    reader = _Reader()
    parser = expat.ParserCreate()
    parser.buffer_text = True
    parser.StartElementHandler = reader.start
    parser.EndElementHandler = reader.end
    parser.CharacterDataHandler = reader.data
    try:
        parser.Parse(body, True)
    except (expat.ExpatError, IndexError, TypeError) as error:
        raise ValueError(str(error)) from error
    return reader.method, tuple(reader.values)


def read_answer(body: bytes) -> Any:
    """The value of an answer. Raises `ValueError` if it is none, or one that tells of a failure."""
    values = read_call(body)[1]
    if len(values) != 1:
        raise ValueError("not an answer")
    return values[0]


def call(method: str, *arguments: Any) -> str:
    """The body of a call. Raises as `answer` does."""
    said = "".join(f"<param>\n{_value(value)}</param>\n" for value in arguments)
    called = f"<methodName>{method}</methodName>\n<params>\n{said}</params>"
    return f"<?xml version='1.0'?>\n<methodCall>\n{called}\n</methodCall>\n"


def answer(value: Any) -> str:
    """The body of an answer. Raises `TypeError` for what XML-RPC cannot say, `OverflowError` for too large a number."""
    said = f"<params>\n<param>\n{_value(value)}</param>\n</params>"
    return f"<?xml version='1.0'?>\n<methodResponse>\n{said}\n</methodResponse>\n"


def fault(code: int, message: str) -> str:
    """The body of an answer that tells of a failure."""
    what = _value({"faultCode": code, "faultString": message})
    return f"<?xml version='1.0'?>\n<methodResponse>\n<fault>\n{what}</fault>\n</methodResponse>\n"


def _value(value: Any) -> str:
    return "<value><nil/></value>" if value is None else f"<value>{_typed(value)}</value>\n"


def _typed(value: Any) -> str:
    if isinstance(value, bool):
        return f"<boolean>{int(value)}</boolean>"
    if isinstance(value, int):
        if not -(2**31) <= value < 2**31:
            raise OverflowError("int exceeds XML-RPC limits")
        return f"<int>{value}</int>"
    if isinstance(value, float):
        return f"<double>{value!r}</double>"
    if isinstance(value, str):
        return f"<string>{_escaped(value)}</string>"
    if isinstance(value, (list, tuple)):
        return "<array><data>\n" + "".join(map(_value, value)) + "</data></array>"
    if isinstance(value, dict):
        members = ((f"<name>{_escaped(name)}</name>\n", _value(below)) for name, below in value.items())
        return "<struct>\n" + "".join(f"<member>\n{name}{below}</member>\n" for name, below in members) + "</struct>"
    if isinstance(value, Binary):
        lines = (value.data[at : at + 57] for at in range(0, len(value.data), 57))  # RFC 2045: 76 characters each
        return "<base64>\n" + "".join(binascii.b2a_base64(line).decode() for line in lines) + "</base64>"
    if isinstance(value, Moment):
        return f"<dateTime.iso8601>{_escaped(value.text)}</dateTime.iso8601>"
    raise TypeError(f"cannot marshal {type(value)}")


def _escaped(text: str) -> str:
    return text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
