"""What a node of roscpp does with parameters."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from preflight_analysis.evaluation import names
from preflight_analysis.source.collector import Collector, is_name
from preflight_analysis.source.cpp_operators import initialized
from preflight_analysis.source.cpp_values import Call, Place, value_at
from preflight_analysis.source.known_params import KnownParams
from preflight_analysis.source.python_values import UNKNOWN, is_plain
from preflight_analysis.source.roscpp_objects import Handle
from preflight_analysis.tracing.interface import ParamUse


class Parameters:
    """The parameters of one node: what it asks for, with what the launch sets."""

    def __init__(self, node: str, remaps: Mapping[str, str], params: KnownParams) -> None:
        self._node = node
        self._remaps = remaps
        self._params = params
        self.collected = Collector()

    def _param_call(self, access: str, handle: Handle, has_default: bool, call: Call) -> Any:
        full = handle.name(value_at(call.args, 0))
        if access == "search":
            return self._search(handle, call)
        if access != "get":
            return self._param(access, full, UNKNOWN, False, call.place)
        into = call.args[1] if len(call.args) > (2 if has_default else 1) else None
        default = value_at(call.args, len(call.args) - 1) if has_default and len(call.args) > 1 else UNKNOWN
        default = initialized(default, call.types[0] if call.types else None)
        found = self._param("get", full, default, has_default, call.place)
        if into is None:
            return found
        if has_default or found is not UNKNOWN:
            call.store(into, found)
        # Another node may set it; what the variable had is then what it starts with.
        return True if found is not UNKNOWN and not has_default else UNKNOWN

    def _search(self, handle: Handle, call: Call) -> Any:
        """The parameter of that name in the handle's namespace or the nearest one around it."""
        name, into = value_at(call.args, 0), call.args[-1] if len(call.args) > 1 else None
        self._param("search", handle.name(name), UNKNOWN, False, call.place)
        space = self._resolved(handle.space)
        found: Any = UNKNOWN
        while is_name(name) and isinstance(space, str) and found is UNKNOWN:
            full = names.canonicalize(f"{space}/{name}")
            found = full if self._params.look(full) is not UNKNOWN else UNKNOWN
            if space == "/":
                break
            space = names.parent(space).rstrip("/") or "/"
        if into is not None:
            call.store(into, found)
        return UNKNOWN if found is UNKNOWN else True

    def _param(self, access: str, name: Any, default: Any, has_default: bool, place: Place) -> Any:
        """Note a use; the value that it gives. Nothing is mandatory: what is not there leaves the node's own value."""
        if not is_name(name):
            self.collected.miss()
            return default
        known = default if is_plain(default) else None
        self.collected.use(ParamUse(name, access, known, has_default, False, place.file, place.line))
        if access not in ("get", "has"):
            return UNKNOWN
        found = self._params.look(names.resolve(name, self._node, self._remaps))
        if access == "has":
            return UNKNOWN if found is UNKNOWN else True
        return default if found is UNKNOWN else found

    def _resolved(self, name: Any) -> Any:
        """The full name that the node gets for one that it gives."""
        known = isinstance(name, str) and names.is_legal(name)
        return names.canonicalize(names.resolve(name, self._node, self._remaps)) if known else UNKNOWN
