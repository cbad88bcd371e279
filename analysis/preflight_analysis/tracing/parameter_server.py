"""The parameters of a launch as the parameter server has them."""

from __future__ import annotations

import base64
from collections.abc import Mapping
from functools import cached_property
from typing import Any

from preflight_analysis.tracing.agents.params import ParamTree


class SharedParams(dict[str, Any]):
    """The parameters of a launch by full name, one object for the requests of all its nodes: what is made of them is
    made once. Never changed."""

    @cached_property
    def tree(self) -> ParamTree:
        """What a node that asks the server is answered from; not to be changed either."""
        tree = ParamTree()
        for name, value in encode_params(self):
            tree.set(name, value)
        return tree


def encode_params(params: Mapping[str, Any]) -> list[list[Any]]:
    """As `[name, value]` pairs in JSON; what the parameter server cannot hold (None, unknown values) is left out."""
    pairs = []
    for name, value in params.items():
        try:
            pairs.append([name, _encode(value)])
        except TypeError:
            continue
    return pairs


def _encode(value: Any) -> Any:
    if isinstance(value, (bool, str, float)):
        return value
    if isinstance(value, int):
        if not -(2**31) <= value < 2**31:
            raise TypeError("XML-RPC integers have 32 bits")
        return value
    if isinstance(value, bytes):
        return {"$binary": base64.b64encode(value).decode()}
    if isinstance(value, Mapping):
        return {str(key): _encode(below) for key, below in value.items()}
    if isinstance(value, (list, tuple)):
        return [_encode(item) for item in value]
    raise TypeError(type(value).__name__)
