"""Nodelets that are loaded into a manager: `nodelet load pkg/Type manager`.

The loader's process only asks the manager to load; that process makes the nodelet's topics, under the loader's name and
namespace, with its remaps and parameters. `nodelet standalone pkg/Type` makes the same ones in one process, so that
is what is run, and what the loader asks of the manager is added.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass, replace

from preflight_analysis.tracing.interface import Endpoint, Interface
from preflight_analysis.tracing.request import TraceRequest


def plugin(request: TraceRequest) -> str | None:
    """The nodelet that a loader loads or a process of its own runs; None of any other executable."""
    if request.package != "nodelet" or os.path.basename(request.executable) != "nodelet" or len(request.args) < 2:
        return None
    return request.args[1] if request.args[0] in ("load", "standalone") else None


def standalone(request: TraceRequest) -> TraceRequest:
    """The request that shows what the nodelet does; any other request as it is."""
    if _manager(request) is None:
        return request
    return replace(request, args=("standalone", request.args[1], *request.args[3:]))


def with_manager(interface: Interface, request: TraceRequest) -> Interface:
    """The interface of what `standalone(request)` runs as that of `request`: it calls its manager, and
    keeps a bond with it."""
    manager = _manager(request)
    if manager is None or not interface.known:
        return interface
    between = [Endpoint("client", f"{manager}/load_nodelet", "nodelet/NodeletLoad")]
    if "--no-bond" not in request.args:
        # By which each learns that the other has ended.
        between += [Endpoint(role, f"{manager}/bond", "bond/Status") for role in ("publisher", "subscriber")]
    return replace(interface, endpoints=(*interface.endpoints, *between))


@dataclass(frozen=True, slots=True)
class Nodelet:
    """What the program of package nodelet is to run: `plugin` is `package/Type`; None for no manager."""

    plugin: str
    manager: str | None


def nodelet_of(package: str, executable: str, args: Sequence[str]) -> Nodelet | None:
    """The nodelet that a node loads or is, None if it is no such node."""
    if package != "nodelet" or os.path.basename(executable) != "nodelet" or len(args) < 2:
        return None
    if args[0] == "standalone":
        return Nodelet(args[1], None)
    return Nodelet(args[1], args[2]) if args[0] == "load" and len(args) > 2 else None


def _manager(request: TraceRequest) -> str | None:
    found = nodelet_of(request.package, request.executable, request.args)
    return found.manager if found is not None else None
