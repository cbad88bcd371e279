"""What the plugins of a node make in it: costmaps subscribe to what their layers' parameters name (ROS 2).

https://docs.nav2.org/configuration/: a node has lists of names, `NAME.plugin` has the type of one, and what stands
below its name are its parameters. Costmaps are nodes of their own within that of a server.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

from preflight_analysis.catalogue.packages import distribution_of
from preflight_analysis.documents.span import Location
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.ros2.params import given_within
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.interfaces.catalogued import Catalogued, catalogued, may_be_newer, typed_end
from preflight_analysis.interfaces.part import Launch, Part, Rows
from preflight_analysis.interfaces.plugins import package_of
from preflight_analysis.model.plugin_params import KIND, LISTED
from preflight_analysis.source.known_params import LaunchParams
from preflight_analysis.tracing.interface import Endpoint, Interface, NamedBy, TypedBy

_NAME = "{}"
_OWN = ""
"""Stands for the node of the launch file among those that it has."""
_OF_LOADER = "../"
"""How the data begins the name of a parameter of the node that loads the plugin."""
_MOST = 64
"""Plugins of a node."""


class _Host(NamedTuple):
    """A node that loads plugins. `defaults` are those of its parameters."""

    name: str
    defaults: Mapping[str, Any]


def plugins_asked(launch: Launch, known: Sequence[Interface]) -> Rows | None:
    """The ends that the plugins make of nodes that no run told of."""
    hosts = launch.kept.each(_hosts, known) if launch.tree.ros.own_parameters else ()
    pairs = zip(launch.nodes, hosts, strict=True) if any(hosts) else ()
    found = {at: ends for at, (node, of) in enumerate(pairs) if of and (ends := _of_hosts(launch, node, of))}
    return Rows((launch.shown(found),)) if found else None


def of_plugins(node: LaunchNode, known: Interface, ends: tuple[Endpoint, ...] | None) -> Part | None:
    """What the plugins of a node make in it."""
    return Part(known.source, ends, leads=False) if ends else None


def _of_hosts(launch: Launch, node: LaunchNode, hosts: Sequence[_Host]) -> tuple[Endpoint, ...]:
    return tuple({(end.role, end.name): end for host in hosts for end in _ends(launch, node, host)}.values())


def _ends(launch: Launch, node: LaunchNode, host: _Host) -> Iterator[Endpoint]:
    params = node.params if host.name == _OWN else given_within(node, host.name, launch.documents)
    given = {param.name: param.value for param in params}
    places = {param.name: param.place for param in params}
    values = {**host.defaults, **given}
    listed = {item for name, value in values.items() if not name.endswith(KIND) for item in _items(value)}
    for name, type_ in [*_types(values, listed)][:_MOST]:
        for end in _ends_of(launch, name, type_, values, places):
            yield end if host.name == _OWN else replace(end, name=names.resolve(end.name, host.name))


def _ends_of(
    launch: Launch, name: str, type_: str, values: Mapping[str, Any], places: Mapping[str, Location]
) -> Iterator[Endpoint]:
    """Those of one plugin: `values` are all that the node which loads it is given."""
    environment, package = launch.environment, package_of(type_)
    below = {key[len(name) + 1 :]: value for key, value in values.items() if key.startswith(f"{name}.")}
    here = environment.packages.get(package)
    if here is not None and here.is_within(environment.workspace):
        # Loads the parser, which who has no plugins does without.
        from preflight_analysis.source.cpp_analysis import PLUGIN_NODE  # noqa: PLC0415

        params = LaunchParams({f"{PLUGIN_NODE}/{name}.{key}": value for key, value in below.items()})
        said = launch.sources.plugin(type_, name, params, package)
        for end in said.endpoints if said is not None else ():
            if not end.builtin:
                yield end
        return
    distro = distribution_of(2, environment.distro)
    found = catalogued(package, "plugins", type_, distro, is_used=environment.distro == distro)
    if found is not None:
        more = {f"{_OF_LOADER}{key}": value for key, value in values.items()}
        newer = may_be_newer(environment.distro, distro)
        yield from _as_loaded(name, found, {**below, **more}, places, newer=newer)


def _hosts(interface: Interface) -> tuple[_Host, ...]:
    """The node and those within it that have plugins by default, or may have; none of what a run told."""
    if interface.source not in ("source", "catalogue"):
        return ()
    found: dict[str, dict[str, Any]] = {}
    for use in interface.params:
        host, slash, name = (_OWN, "/", use.name[1:]) if use.name[:1] == "~" else use.name.rpartition("/")
        if slash and name and use.has_default:
            found.setdefault(host, {})[name] = use.default
    return tuple(_Host(host, values) for host, values in found.items() if any(map(_is_kind, values)))


def _is_kind(param: str) -> bool:
    return param.endswith(KIND)


def _types(values: Mapping[str, Any], listed: set[str]) -> Iterator[tuple[str, str]]:
    """The names of the plugins that are loaded, with their types."""
    for param, value in values.items():
        name = param.removesuffix(KIND)
        if name != param and name in listed and isinstance(value, str):
            yield name, value.replace("/", "::")


def _items(value: Any) -> Sequence[str]:
    """What a list of texts has, or a text with spaces in between."""
    items = value.split() if isinstance(value, str) else value if isinstance(value, (list, tuple)) else ()
    return [each for each in items if isinstance(each, str)][:_MOST]


def _as_loaded(
    name: str, found: Catalogued, below: Mapping[str, Any], places: Mapping[str, Location], *, newer: bool
) -> Iterator[Endpoint]:
    """With the name that the plugin is loaded by, once for each item of what it has lists of."""
    named = {id(end): param for param, end in found.by_parameter}
    typed = {id(end): (param, types) for end, param, types in found.typed}
    for end in (*found.endpoints, *(end for _, end in found.by_parameter if not end.name)):
        by, (kind, types) = named.get(id(end), ""), typed.get(id(end), ("", {}))
        listed = next((match for each in (end.name, by, kind) if (match := LISTED.match(each))), None)
        for item in _items(below.get(listed[1])) if listed is not None else (None,):

            def made(text: str, item: str | None = item) -> str:
                return LISTED.sub(lambda _: item or "", text).replace(_NAME, name)

            called = below.get(made(by)) if by else None
            called = called if isinstance(called, str) and called else made(end.name)
            if called and names.is_legal(called):
                param = f"{name}.{made(by)}"
                named_by = NamedBy(param, places[param]) if by and param in places else None
                loaded = replace(end, name=called, named_by=named_by)
                if kind:
                    key = made(kind)
                    above = key.removeprefix(_OF_LOADER)
                    param = above if above != key else f"{name}.{key}"
                    typed_by = TypedBy(param, places.get(param), tuple(types.items()))
                    # A default of the loader itself may be that of another distribution.
                    value = below.get(key) if above == key or param in places else None
                    loaded = typed_end(loaded, typed_by, value, newer=newer and above != key)
                yield loaded
