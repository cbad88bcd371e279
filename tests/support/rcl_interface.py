"""What `rcl_preload.cpp` uses of rcl, rmw, rcutils and rosidl: as it declares it, and as the headers of a distribution
of ROS 2 do. `tests/tracing/rcl_interface.json` has the latter; `tests/tools/rcl_interface.py` records it."""

from __future__ import annotations

import functools
import json
import re
import subprocess
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from preflight_analysis.tracing import preload_compile

RECORD = Path(__file__).parents[1] / "tracing" / "rcl_interface.json"
DISTRIBUTIONS = ("humble", "jazzy", "kilted", "lyrical", "rolling")
STRUCTS = (
    "message_type_support_callbacks_t",
    "rcl_action_client_t",
    "rcl_action_server_t",
    "rcl_client_options_t",
    "rcl_client_t",
    "rcl_lifecycle_state_machine_t",
    "rcl_lifecycle_state_t",
    "rcl_node_options_t",
    "rcl_node_t",
    "rcl_publisher_t",
    "rcl_service_options_t",
    "rcl_service_t",
    "rcl_subscription_t",
    "rcl_wait_set_t",
    "rcutils_allocator_t",
    "rcutils_uint8_array_t",
    "rmw_qos_profile_t",
    "rmw_request_id_t",
    "rmw_time_t",
    "rosidl_message_type_support_t",
    "rosidl_runtime_c__String",
    "rosidl_service_type_support_t",
    "rosidl_typesupport_introspection_c__MessageMember",
    "rosidl_typesupport_introspection_c__MessageMembers",
    "rosidl_typesupport_introspection_c__ServiceMembers",
)
"""Whose inside `layout.hpp`, or what a caller allocates, relies on."""
_COMMENT = re.compile(r"/\*.*?\*/|//[^\n]*", re.DOTALL)
_DIRECTIVE = re.compile(r"^[ \t]*#(?:[^\n]*\\\n)*[^\n]*$", re.MULTILINE)
_MARK = re.compile(r"\b(?:RCL|RMW|RCUTILS|ROSIDL)\w*(?:_PUBLIC(?:_TYPE)?|_WARN_UNUSED|_DEPRECATED\w*)\b(?:\([^()]*\))?")
_FUNCTION = re.compile(r"([A-Za-z_][\w\s*]*?)\b((?:rcl|rmw|rcutils)_\w+)\s*\(([^(){};]*)\)\s*;")
_STRUCT = re.compile(r"\bstruct\s+(\w+)?\s*\{(.*?)\}\s*(\w+)?\s*;", re.DOTALL)
_POINTER_TO_FUNCTION = re.compile(r"\(\s*\*\s*(\w+)\s*\)\s*\(")
_LAST_NAME = re.compile(r"(.*?)\s*\b(\w+)\s*((?:\[\w+\])?)\Z", re.DOTALL)
_HOOK = re.compile(r'extern "C" __attribute__\(\(visibility\("default"\)\)\) int (rcl_\w+)\(([^{;]*)\)\s*\{')
_USE = re.compile(r'real(_or_die)?<((?:[^<>"]|<[^<>]*>)+?)>\(known, "((?:rcl|rmw|rcutils)_\w+)"\)')

_PURPOSES = (
    ("_action_", "actions"),
    ("_lifecycle_", "lifecycle"),
    ("_node_init", "nodes"),
    ("_node_fini", "nodes"),
    ("_get_node_names", "graph queries"),
    ("_names_and_types", "graph queries"),
    ("_info_by_", "graph queries"),
    ("_count_", "graph queries"),
    ("_is_available", "waits"),
    ("_wait", "waits"),
    ("_publish", "topics"),
    ("_subscription", "topics"),
    ("_service", "services"),
    ("_client", "services"),
    ("_request", "services"),
    ("", "start and exit"),
)
"""What a function is hooked for, by a part of its name."""

_MAKE = re.compile(r"using Make =\s*(.*?);", re.DOTALL)

Types = tuple[str, ...]
Fields = tuple[tuple[str, str], ...]


@dataclass
class Interface:
    """`functions` by name: what is returned and taken; `structs` by name: types and names of fields."""

    functions: dict[str, Types] = field(default_factory=dict)
    structs: dict[str, Fields] = field(default_factory=dict)


def of_headers(folder: Path) -> Interface:
    """All that the headers below a folder declare."""
    found = Interface()
    for path in sorted(folder.rglob("*.h")):
        if "test" in path.relative_to(folder).parts:
            continue
        text = _COMMENT.sub("", path.read_text(errors="replace"))
        text = _MARK.sub("", _DIRECTIVE.sub("", text))
        for returned, name, taken in _FUNCTION.findall(text):
            given = [_LAST_NAME.sub(r"\1", each.strip()) for each in taken.split(",") if each.strip() != "void"]
            found.functions.setdefault(name, tuple(map(_spaced, [returned, *given])))
        for tag, body, alias in _STRUCT.findall(text):
            for name in {alias, tag} - {""}:
                found.structs.setdefault(name, _fields(body))
    for name, fields in list(found.structs.items()):
        if name.endswith("_s"):
            found.structs.setdefault(f"{name[:-2]}_t", fields)
    return found


def _fields(body: str) -> Fields:
    made = []
    for each in filter(None, map(str.strip, body.split(";"))):
        pointer = _POINTER_TO_FUNCTION.search(each)
        last = _LAST_NAME.match(each)
        if pointer is not None:
            made.append(("void (*)()", pointer[1]))
        elif last is not None:
            made.append((_spaced(last[1] + last[3]), last[2]))
    return tuple(made)


def _spaced(text: str) -> str:
    return " ".join(text.split())


@dataclass
class Used:
    """What the library declares: `hooks` by name with what they take, `calls` with what is returned and taken."""

    hooks: dict[str, Types] = field(default_factory=dict)
    calls: dict[str, set[Types]] = field(default_factory=dict)

    @property
    def names(self) -> set[str]:
        """All functions of rcl and the rest that it knows."""
        return {*self.hooks, *self.calls}


@functools.cache
def used() -> Used:
    """As the preprocessor has it."""
    compiler = preload_compile.compiler()
    assert compiler is not None
    source = preload_compile.RCL.source
    done = subprocess.run([compiler, "-E", "-P", "-std=c++17", source], capture_output=True, text=True, check=True)
    text = re.sub(r'"\s*"', "", done.stdout)
    found = Used()
    for name, taken in _HOOK.findall(text):
        found.hooks[name] = tuple(_spaced(_LAST_NAME.sub(r"\1", each.strip())) for each in taken.split(","))
    for use in _USE.finditer(text):
        _, declared, name = use.groups()
        if declared == "Make":
            declared = _MAKE.findall(text, 0, use.start())[-1]
        returned, _, taken = declared.partition("(")
        types = (returned, *filter(None, (each.strip() for each in taken.removesuffix(")").split(","))))
        found.calls.setdefault(name, set()).add(tuple(map(_spaced, types)))
    return found


def recorded() -> Mapping[str, Interface]:
    """What is known of each distribution."""
    known = json.loads(RECORD.read_text())
    made = {distribution: Interface() for distribution in DISTRIBUTIONS}
    for name, versions in known["functions"].items():
        for types, distributions in versions:
            for distribution in distributions.split():
                made[distribution].functions[name] = tuple(types)
    for name, versions in known["structs"].items():
        for fields, distributions in versions:
            for distribution in distributions.split():
                made[distribution].structs[name] = tuple((kind, each) for kind, each in fields)
    return made


def versions(known: Mapping[str, Mapping[str, object]], names: Iterable[str]) -> dict[str, list[list[object]]]:
    """Of each name what it is, and in which distributions: `known` has by distribution what each is."""
    made: dict[str, list[list[object]]] = {}
    for name in sorted(names):
        by_shape: dict[object, list[str]] = {}
        for distribution, shapes in known.items():
            if name in shapes:
                by_shape.setdefault(shapes[name], []).append(distribution)
        made[name] = [[shape, " ".join(distributions)] for shape, distributions in by_shape.items()]
    return made


def table() -> str:
    """The hooked functions by what they are for, with the distributions that have them, in Markdown."""
    known = recorded()
    rows: dict[tuple[str, tuple[bool, ...]], list[str]] = {}
    for name in used().hooks:
        there = tuple(name in known[each].functions for each in DISTRIBUTIONS)
        what = next(what for part, what in _PURPOSES if part in name)
        rows.setdefault((what, there), []).append(f"`{name}`")
    packages = json.loads(RECORD.read_text())["sources"]
    lines = [
        "| | hooked functions | " + " | ".join(each.capitalize() for each in DISTRIBUTIONS) + " |",
        "| --- | --- |" + " --- |" * len(DISTRIBUTIONS),
        "| | of rcl | " + " | ".join(packages[each]["rcl"] for each in DISTRIBUTIONS) + " |",
    ]
    order = [what for _, what in _PURPOSES]
    for (what, there), names in sorted(rows.items(), key=lambda row: (order.index(row[0][0]), not all(row[0][1]))):
        cells = " | ".join("yes" if each else "no" for each in there)
        lines.append(f"| {what} | {', '.join(names)} | {cells} |")
    return "\n".join(lines)
