"""What calls of rclcpp declare and read of a node's parameters."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from preflight_analysis.evaluation import names
from preflight_analysis.source.collector import Collector
from preflight_analysis.source.cpp_operators import converted
from preflight_analysis.source.cpp_values import (
    Argument,
    Call,
    Constant,
    CppType,
    Instance,
    Place,
    Unmade,
    value_at,
)
from preflight_analysis.source.known_params import KnownParams
from preflight_analysis.source.parameter_library import Libraries
from preflight_analysis.source.python_values import UNKNOWN, is_plain
from preflight_analysis.source.rclcpp_objects import (
    RANGES,
    UNSET,
    NodeObject,
    Parameter,
    first_node,
    given_parameter,
    is_descriptor,
    parameter_of,
    qualified,
    struct_of,
)
from preflight_analysis.tracing.interface import ParamUse, Range

_TYPE_NAMES = {
    "double": "double",
    "float": "double",
    "int": "integer",
    "int64_t": "integer",
    "std::int64_t": "integer",
    "bool": "bool",
    "std::string": "string",
}
_LIBRARY_TYPES = {
    f"{name}{more}": f"{type_}{' array' if more else ''}"
    for name, type_ in (("bool", "bool"), ("int", "integer"), ("double", "double"), ("string", "string"))
    for more in ("", "_array")
}
"""Of generate_parameter_library, whose types may have a size."""


class Parameters:
    """The parameters of one node: what it declares, with what the launch sets."""

    includes: Sequence[str] = ()
    """What the files of the program include."""

    def __init__(self, node: str, params: KnownParams, libraries: Libraries) -> None:
        self._node = node
        self._params = params
        self._libraries = libraries
        self._structs: dict[str, Instance] = {}
        self._in_dead_code = False
        self._not_reached: list[ParamUse] = []
        self._declared: dict[str, Any] = {"~use_sim_time": False}
        self.collected = Collector()

    def dead_code(self, begins: bool) -> bool:
        """A parameter of another mode of the node is no misspelt one: that it has such a name is noted."""
        self._in_dead_code = begins
        return True

    def finish(self) -> None:
        """Add the parameters that are declared only where the node does not come with what the launch file sets."""
        declared = {use.name for use in self.collected.params}
        for use in self._not_reached:
            if use.name not in declared:
                self.collected.use(use)

    def _listener(self, name: str, given: Sequence[Any]) -> bool:
        """The parameters of a class that generate_parameter_library makes. False if its file is not there."""
        library = self._libraries(name.rpartition("::")[0], self.includes)
        if library is None:
            return False
        node = first_node(given)
        prefix = next((value.rstrip(".") + "." for value in given if isinstance(value, str) and value), "")
        struct = self._structs[name] = struct_of()
        for param in library.params:
            place = Place(param.file, param.line)
            default = Parameter(_of_type(param.default, param.type)) if param.has_default else None
            type_ = _LIBRARY_TYPES.get(re.sub(r"_fixed_\d+\Z", "", param.type))
            about = ParamUse("", "get", type=type_, read_only=param.read_only, range=param.range)
            value = self._declare(node, prefix + param.name, default, place, about=about, read=True)
            *groups, leaf = param.name.split(".")
            inner = struct
            for group in groups:
                inner = inner.names.setdefault(group, struct_of())
            inner.names[leaf] = UNKNOWN if value is UNSET else value
        if not library.complete:
            self._any_parameter(Place(library.params[0].file if library.params else "", 1))
        return True

    def _declare_call(self, node: NodeObject, types: Sequence[CppType], args: Sequence[Argument], place: Place) -> Any:
        name = value_at(args, 0)
        if not isinstance(name, str) or not name:
            self._any_parameter(place)
            return UNKNOWN
        type_ = types[0] if types else None
        has_default = len(args) > 1 and not isinstance(args[1].value, Constant) and not is_descriptor(args[1].value)
        default = given_parameter(args[1], type_) if has_default else None
        about = _described(args, type_)
        if type_ is not None and not has_default and (len(args) < 2 or is_descriptor(args[1].value)):
            # rclcpp throws where there is no value of that type.
            about = replace(about, mandatory=not self.collected.branches.caught)
        found = self._declare(node, name, default, place, about=about)
        of_value = len(args) > 1 and isinstance(args[1].value, (Parameter, Constant))
        if of_value and type_ is None:
            return parameter_of(found)
        return UNKNOWN if found is UNSET else converted(found, type_)

    def _declare_all(self, node: NodeObject, call: Call) -> None:
        space, given = value_at(call.args, 0), value_at(call.args, 1)
        pairs = list(given.items()) if isinstance(given, dict) else given
        if not isinstance(space, str) or not isinstance(pairs, list):
            self._any_parameter(call.place)
            return
        for pair in pairs:
            if not isinstance(pair, (list, tuple)) or not pair or not isinstance(pair[0], str):
                self._any_parameter(call.place)
                continue
            name = f"{space}.{pair[0]}" if space else pair[0]
            value = pair[1] if len(pair) > 1 else UNKNOWN
            value = value[0] if isinstance(value, list) and len(value) == 2 and isinstance(value[1], Unmade) else value
            default = given_parameter(Argument(value), call.types[0] if call.types else None)
            self._declare(node, name, Parameter(default.value), call.place)

    def _declare(
        self,
        node: NodeObject,
        name: str,
        default: Parameter | None,
        place: Place,
        *,
        about: ParamUse | None = None,
        read: bool = False,
    ) -> Any:
        """Note a declaration; the value that the parameter has then. `about` has what its descriptor says. `read`: it
        is read as its type at once, which throws where a node that declares what it is given lets any type in."""
        full = node.param(name)
        if full is UNKNOWN:
            self._any_parameter(place)  # it may be the node that the launch file starts
            return UNKNOWN
        known = default.value if default is not None and default.typed and is_plain(default.value) else None
        use = replace(
            about or ParamUse("", "get"),
            name=full,
            default=known,
            has_default=default is not None,
            source_file=place.file,
            source_line=place.line,
        )
        if node.from_overrides and not read:
            use = replace(use, dynamic=True)
        if self._in_dead_code:
            self._not_reached.append(use)
            return UNKNOWN
        self.collected.use(use)
        self._declared[full] = default.value if default is not None else UNSET
        return self._value(full)

    def _read(self, node: NodeObject, call: Call) -> Any:
        """`get_parameter("x")`, which gives it, or `get_parameter("x", variable)`, which tells whether it is there."""
        param, into = value_at(call.args, 0), call.args[1] if len(call.args) > 1 else None
        or_else = call.name == "get_parameter_or"
        full = node.param(param) if isinstance(param, str) and param else UNKNOWN
        found: Any = UNKNOWN
        if isinstance(full, str):
            found = self._value(full)
            if full not in self._declared:
                self.collected.use(ParamUse(full, "get", None, False, False, call.place.file, call.place.line))
        if or_else and (found is UNKNOWN or found is UNSET):
            found = value_at(call.args, len(call.args) - 1)
        if into is None or (or_else and len(call.args) == 2):
            return found if or_else else parameter_of(found)
        if found is UNSET:
            return False
        if isinstance(into.value, float):
            found = converted(found, CppType("double"))
        of_parameter = isinstance(into.value, Parameter) or (
            isinstance(into.value, Unmade) and qualified(into.value.type) == "rclcpp::Parameter"
        )
        call.store(into, parameter_of(found) if of_parameter else found)
        return True if full in self._declared else UNKNOWN

    def _value(self, full: str) -> Any:
        """What the launch sets, else what was declared."""
        found = self._params.look(names.resolve(full, self._node))
        default = self._declared.get(full, UNKNOWN)
        if found is UNKNOWN:
            return default
        return converted(found, CppType("double")) if isinstance(default, float) else found

    def _any_parameter(self, place: Place) -> None:
        """The node takes parameters of any name, or of names that the text does not tell."""
        self.collected.use(ParamUse("/", "list", source_file=place.file, source_line=place.line))


def _described(args: Sequence[Argument], type_: CppType | None) -> ParamUse:
    """What a declaration says of the parameter beyond its default: a type without one, and a descriptor."""
    use = ParamUse("", "get")
    given = value_at(args, 1)
    if isinstance(given, Constant) and given.name.startswith("PARAMETER_") and given.name != "PARAMETER_NOT_SET":
        use = replace(use, type=given.name.removeprefix("PARAMETER_").lower().replace("_", " "))
    elif type_ is not None and (len(args) < 2 or is_descriptor(given)):
        use = replace(use, type=_TYPE_NAMES.get(type_.name))
    about: Mapping[str, Any] = next((arg.value.names for arg in args if is_descriptor(arg.value)), {})
    # Only the range of the parameter's own type counts, which is not known here: that of both is none.
    ranges = [each for name in RANGES.values() if isinstance(about.get(name), list) for each in about[name]]
    found = None
    if len(ranges) == 1 and isinstance(ranges[0], Instance):
        bounds = [ranges[0].names.get(field, 0) for field in ("from_value", "to_value", "step")]
        found = Range(*bounds) if all(isinstance(bound, (int, float)) for bound in bounds) else None
    dynamic = about.get("dynamic_typing", False) is not False
    return replace(use, dynamic=dynamic, read_only=about.get("read_only") is True, range=found)


def _of_type(value: Any, type_: str) -> Any:
    """A default of a YAML file as the parameter has it, which is of the type `type_` (`double_array_fixed_3`)."""
    kind = CppType(type_.partition("_")[0])
    return [converted(each, kind) for each in value] if isinstance(value, list) else converted(value, kind)
