"""The services that every node has for its parameters (https://docs.ros.org/en/jazzy/Concepts/Basic/About-Parameters.html)."""

from __future__ import annotations

import importlib
from typing import Any

_SERVICES = ("DescribeParameters", "GetParameters", "GetParameterTypes", "ListParameters", "SetParameters",
             "SetParametersAtomically")  # fmt: skip


class ParameterService:
    """Makes them."""

    def __init__(self, node: Any) -> None:
        types = importlib.import_module("rcl_interfaces.srv")
        for name in _SERVICES:
            words = "".join(f"_{each.lower()}" if each.isupper() else each for each in name)[1:]
            node.create_service(getattr(types, name), f"{node.name_}/{words}", lambda request, response: response)
