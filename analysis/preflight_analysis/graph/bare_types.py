"""Types that annotations write without their package: `String` for `std_msgs/String`."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from functools import cache
from itertools import chain

from preflight_analysis.documents.disk import Disk
from preflight_analysis.environment.model import Environment
from preflight_analysis.generation import ros
from preflight_analysis.incremental.kept import Kept
from preflight_analysis.tracing.agents.stand_ins.definitions import Definitions
from preflight_analysis.tracing.interface import Endpoint, Interface, Role

KINDS: Mapping[Role, str] = {
    "publisher": "msg",
    "subscriber": "msg",
    "service": "srv",
    "client": "srv",
    "action_server": "action",
    "action_client": "action",
}
"""What defines the type of each endpoint."""
ANY = "*"


def is_bare(type_: str | None) -> bool:
    """Whether it is the name of a type without that of its package."""
    return type_ is not None and type_ != ANY and "/" not in type_


def full_types(disk: Disk, environment: Environment, generation: int, kind: str, name: str) -> tuple[str, ...]:
    """The types of that name in all known packages, sorted."""
    packages = set(_common(generation, kind).get(name, ()))
    file = os.path.join(kind, f"{name}.{kind}")
    packages.update(p.name for p in environment.packages.values() if disk.is_file(os.path.join(p.share, file)))
    middle = f"/{kind}/" if ros(generation).kinds_in_types else "/"
    return tuple(sorted(f"{package}{middle}{name}" for package in packages))


@cache
def _common(generation: int, kind: str) -> Mapping[str, tuple[str, ...]]:
    found: dict[str, tuple[str, ...]] = {}
    for full in Definitions(generation, {}).all(kind):
        package, _, name = full.split("/", 2)
        found[name] = (*found.get(name, ()), package)
    return found


def with_packages(
    interfaces: Sequence[Interface], disk: Disk, environment: Environment, generation: int, kept: Kept
) -> tuple[Interface, ...]:
    """The interfaces with the full names of types that are written without a package: that which one known package has;
    none where several have it, or none."""
    bare = dict.fromkeys(chain.from_iterable(kept.each(_bare_types, interfaces)))
    if not bare:
        return tuple(interfaces)
    found = ((each, full_types(disk, environment, generation, *each)) for each in bare)
    full = tuple((each, types[0] if len(types) == 1 else None) for each, types in found)
    return kept.each(_resolved, interfaces, full)


def _bare_types(interface: Interface) -> tuple[tuple[str, str], ...]:
    """Kind and name of those of an interface."""
    return tuple((KINDS[each.role], str(each.type)) for each in interface.endpoints if is_bare(each.type))


def _resolved(interface: Interface, full: Iterable[tuple[tuple[str, str], str | None]]) -> Interface:
    """The interface with the types in `full` for those without a package, or with any type."""
    if not any(is_bare(each.type) for each in interface.endpoints):
        return interface
    known = dict(full)

    def whole(endpoint: Endpoint) -> Endpoint:
        if not is_bare(endpoint.type):
            return endpoint
        return replace(endpoint, type=known.get((KINDS[endpoint.role], str(endpoint.type))))

    return replace(interface, endpoints=tuple(map(whole, interface.endpoints)))
