"""What a node of roscpp does with parameters."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from preflight_analysis.evaluation import names
from preflight_analysis.source.collector import Collector, is_name
from preflight_analysis.source.cpp_operators import initialized
from preflight_analysis.source.cpp_values import Argument, CppType, Place, Store, value_at
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

    def _param_call(
        self,
        access: str,
        handle: Handle,
        has_default: bool,
        types: Sequence[CppType],
        args: Sequence[Argument],
        place: Place,
        store: Store,
    ) -> Any:
        name = handle.name(value_at(args, 0))
        if access == "search":
            return self._search(handle, args, place, store)
        if access != "get":
            return self._param(access, name, UNKNOWN, False, place)
        into = args[1] if len(args) > (2 if has_default else 1) else None
        default = value_at(args, len(args) - 1) if has_default and len(args) > 1 else UNKNOWN
        default = initialized(default, types[0] if types else None)
        found = self._param("get", name, default, has_default, place)
        if into is None:
            return found
        if has_default or found is not UNKNOWN:
            store(into, found)
        # Another node may set it; what the variable had is then what it starts with.
        return True if found is not UNKNOWN and not has_default else UNKNOWN

    def _search(self, handle: Handle, args: Sequence[Argument], place: Place, store: Store) -> Any:
        """The parameter of that name in the handle's namespace or the nearest one around it."""
        name, into = value_at(args, 0), args[-1] if len(args) > 1 else None
        self._param("search", handle.name(name), UNKNOWN, False, place)
        space = self._resolved(handle.space)
        found: Any = UNKNOWN
        while is_name(name) and isinstance(space, str) and found is UNKNOWN:
            full = names.canonicalize(f"{space}/{name}")
            found = full if self._params.look(full) is not UNKNOWN else UNKNOWN
            if space == "/":
                break
            space = names.parent(space).rstrip("/") or "/"
        if into is not None:
            store(into, found)
        return UNKNOWN if found is UNKNOWN else True

    def _param(self, access: str, name: Any, default: Any, has_default: bool, place: Place) -> Any:
        """Note a use; the value that it gives. Nothing is mandatory: what is not there leaves the node's own value."""
        if not is_name(name):
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
