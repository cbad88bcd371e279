"""The request by which a container loads a component: `composition_interfaces/srv/LoadNode` in CDR, as the middleware
takes it for whichever language the container is linked for.

After `launch_ros.actions.LoadComposableNodes`; the types of values are those of `rcl_interfaces/msg/ParameterType`.
"""

from __future__ import annotations

import struct
from collections.abc import Mapping
from typing import Any

from preflight_analysis.tracing.request import TraceRequest

_LITTLE_ENDIAN = b"\0\1\0\0"
_SCALARS = {bool: 1, int: 2, float: 3, str: 4}
_LISTS = {bool: 6, int: 7, float: 8, str: 9}
_LAST = 9


class _Writer:
    """CDR version 1: each number is aligned to its size."""

    def __init__(self) -> None:
        self.data = bytearray()

    def number(self, form: str, value: float) -> None:
        size = struct.calcsize(form)
        self.data += b"\0" * (-len(self.data) % size)
        self.data += struct.pack(f"<{form}", value)

    def text(self, value: str) -> None:
        # A text ends at the first zero in C, and has no surrogates anywhere.
        encoded = value.partition("\0")[0].encode(errors="replace") + b"\0"
        self.number("I", len(encoded))
        self.data += encoded

    def item(self, value: Any) -> None:
        if isinstance(value, str):
            self.text(value)
        else:
            self.number({bool: "?", int: "q", float: "d"}[type(value)], value)


def load_request(request: TraceRequest) -> bytes:
    """What asks the container of the request to load its component. Remaps of topics and services are left out,
    as they are applied to what the run tells."""
    assert request.component is not None
    space, _, base = request.node.rpartition("/")
    writer = _Writer()
    for text in (request.package, request.component.plugin, base if request.named else "", space):
        writer.text(text)
    writer.number("B", 0)
    rules = [f"{source}:={target}" for source, target in request.renames]
    writer.number("I", len(rules))
    for rule in rules:
        writer.text(rule)
    _write_params(writer, request.given_to(None))
    _write_params(writer, dict(request.component.extra_arguments))
    return _LITTLE_ENDIAN + bytes(writer.data)


def _write_params(writer: _Writer, params: Mapping[str, Any]) -> None:
    typed = [(name, value, kind) for name, value in params.items() if (kind := _type_of(value)) is not None]
    writer.number("I", len(typed))
    for name, value, kind in typed:
        writer.text(name)
        _write_value(writer, value, kind)


def _write_value(writer: _Writer, value: Any, kind: int) -> None:
    writer.number("B", kind)
    empty: Mapping[int, Any] = {1: False, 2: 0, 3: 0.0, 4: ""}
    for each in range(1, _LAST + 1):
        if each in _SCALARS.values():
            writer.item(value if each == kind else empty[each])
        else:
            items = value if each == kind else ()
            writer.number("I", len(items))
            for item in items:
                writer.item(item)


def _type_of(value: Any) -> int | None:
    """The type of a parameter; None for a value that has none, which launch does not get to send either."""
    items = value if isinstance(value, (list, tuple)) else [value]
    types = {type(item) for item in items}
    if len(types) != 1 or any(isinstance(item, int) and not -(2**63) <= item < 2**63 for item in items):
        return None
    return (_SCALARS if items is not value else _LISTS).get(types.pop())
