"""A NoDL document to endpoints and parameters.

Version 2 is YAML or JSON and describes one node, which the name of the file tells; version 1 (nodl_python, until 2026)
is XML and describes executables. What a document has wrong is left out, the rest counts.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import yaml
from lxml import etree

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.yaml import CONSTRUCTION_ERRORS
from preflight_analysis.generation import ros
from preflight_analysis.graph.bare_types import KINDS
from preflight_analysis.interfaces.nodl_groups import GROUPS
from preflight_analysis.tracing.interface import Endpoint, ParamUse, Role

_ROLES_1: Mapping[str, Mapping[str, tuple[Role, ...]]] = {
    "topic": {
        "publisher": ("publisher",),
        "subscription": ("subscriber",),
        "both": ("publisher", "subscriber"),
    },
    "service": {"server": ("service",), "client": ("client",), "both": ("service", "client")},
    "action": {
        "server": ("action_server",),
        "client": ("action_client",),
        "both": ("action_server", "action_client"),
    },
}
_SCALARS = (str, int, float, bool)
_POLICIES = ("reliability", "durability")
_OPEN = ("SYSTEM_DEFAULT", "BEST_AVAILABLE")
"""What is settled where the node runs."""


@dataclass(frozen=True, slots=True)
class Described:
    """What a document says of a node. `executable` is None where the name of the file tells which it is; `includes` are
    references to documents that say more."""

    executable: str | None
    endpoints: tuple[Endpoint, ...] = ()
    params: tuple[ParamUse, ...] = ()
    includes: tuple[str, ...] = ()


def read_nodl(path: str, text: str, generation: int) -> tuple[Described, ...]:
    """What the document at `path` says, nothing if it is none. Types are written as `generation` does. Never raises."""
    if path.endswith(".xml"):
        return tuple(_version_1(path, text, generation))
    try:
        loader = yaml.SafeLoader(text)
        root = loader.get_single_node()
        data = loader.construct_document(root) if root is not None else None
    except CONSTRUCTION_ERRORS:
        return ()
    if not isinstance(root, yaml.MappingNode) or not isinstance(data, dict) or data.get("nodl_version") != 2:
        return ()
    lines = _lines(root)
    endpoints = [
        Endpoint(role, name, _type(each.get("type"), role, generation), None, _qos(each.get("qos")), path, line)
        for role, group in GROUPS.items()
        for at, each in enumerate(_list(data.get(group)))
        if isinstance(each, dict) and isinstance(name := each.get("name"), str) and (line := lines.get((group, at), 1))
    ]
    declared = data.get("parameters")
    params = [
        _param(name, about, path, lines.get(("parameters", name), 1))
        for name, about in (declared.items() if isinstance(declared, dict) else ())
        if isinstance(name, str) and isinstance(about, dict)
    ]
    includes = [ref for each in _list(data.get("include")) if isinstance(each, dict) and (ref := each.get("ref"))]
    return (Described(None, tuple(endpoints), tuple(params), tuple(map(str, includes))),)


def _param(name: str, about: Mapping[str, Any], path: str, line: int) -> ParamUse:
    """One without a default is one that the node cannot do without."""
    has_default, default = "default_value" in about, about.get("default_value")
    plain = all(isinstance(each, _SCALARS) for each in (default if isinstance(default, list) else [default]))
    return ParamUse(f"~{name}", "get", default if plain else None, has_default, not has_default, path, line)


def _list(value: Any) -> list[Any]:
    return value if isinstance(value, list) else []


def _lines(root: yaml.MappingNode) -> dict[tuple[str, Any], int]:
    """Where the entries of each group are written, by their position or name; counted from 1."""
    found: dict[tuple[str, Any], int] = {}
    for key, value in root.value:
        if isinstance(value, yaml.SequenceNode):
            found.update({(key.value, at): each.start_mark.line + 1 for at, each in enumerate(value.value)})
        elif isinstance(value, yaml.MappingNode):
            found.update({(key.value, name.value): name.start_mark.line + 1 for name, _ in value.value})
    return found


def _type(type_: Any, role: Role, generation: int) -> str | None:
    """The middle of `std_msgs/msg/String` may be left out in NoDL; ROS 1 does not have it, ROS 2 always."""
    if not isinstance(type_, str):
        return None
    parts = type_.split("/")
    package, name = parts[0], parts[-1]
    if len(parts) == 1 or not package or not name:
        return None
    return f"{package}/{KINDS[role]}/{name}" if ros(generation).kinds_in_types else f"{package}/{name}"


def _qos(said: Any) -> dict[str, Any]:
    """The policies as the rest of the graph has them."""
    if not isinstance(said, dict):
        return {}
    qos = {
        policy: value.lower()
        for policy in _POLICIES
        if isinstance(value := said.get(policy), str) and value not in _OPEN
    }
    depth = said.get("depth")
    return {**qos, "depth": depth} if isinstance(depth, int) and said.get("history") == "KEEP_LAST" else qos


def _version_1(path: str, text: str, generation: int) -> Iterator[Described]:
    parser = etree.XMLParser(resolve_entities=False, no_network=True, load_dtd=False, recover=True)
    try:
        root = etree.fromstring(text.encode("utf-8", "replace"), parser)
    except (etree.XMLSyntaxError, ValueError):
        return
    if root is None or root.tag != "interface" or root.get("version") != "1":
        return
    for node in root.iter("node"):
        endpoints = []
        params = []
        for child in node:
            name, line = child.get("name"), child.sourceline
            if not name or not isinstance(child.tag, str) or not isinstance(line, int):
                continue
            if child.tag == "parameter":
                params.append(ParamUse(f"~{name}", "get", source_file=path, source_line=line))
            for role in _ROLES_1.get(child.tag, {}).get(str(child.get("role")), ()):
                type_ = _type(child.get("type"), role, generation)
                endpoints.append(Endpoint(role, str(name), type_, None, {}, path, line))
        yield Described(str(node.get("executable") or ""), tuple(endpoints), tuple(params))
