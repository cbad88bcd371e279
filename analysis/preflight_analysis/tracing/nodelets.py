"""Nodelets that are loaded into a manager: `nodelet load pkg/Type manager`.

The loader's process only asks the manager to load; that process makes the nodelet's topics, under the loader's name and
namespace, with its remaps and parameters. What a nodelet asks of its process instead of its own handles (`~` in
`ros::NodeHandle("~")` and `ros::param`, `ros::this_node::getName`) is the manager's. `nodelet standalone pkg/Type`
makes the same in one process, so that is what is run: its process has a name of its own, the nodelet is loaded under
the loader's, and what then has the name of the process is the manager's. What the loader asks of the manager is added.
"""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Sequence
from dataclasses import replace
from itertools import chain

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.disk import Disk
from preflight_analysis.environment.catkin_python import workspace_packages
from preflight_analysis.environment.executables import ExecutableIndex
from preflight_analysis.environment.model import Environment
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.incremental.database import Database
from preflight_analysis.incremental.query import query
from preflight_analysis.slips import edits
from preflight_analysis.tracing.interface import Endpoint, Interface
from preflight_analysis.tracing.request import TraceRequest, split_args


def plugin(request: TraceRequest) -> str | None:
    """The nodelet that a loader loads or a process of its own runs; None of any other executable."""
    if request.package != "nodelet" or os.path.basename(request.executable) != "nodelet" or len(request.args) < 2:
        return None
    return request.args[1] if request.args[0] in ("load", "standalone") else None


MANAGER = "preflight_manager"
_SPACE = "preflight_manager_of"
"""Name and namespace of the process in which a nodelet is run that is to be loaded into a manager, below the nodelet's
namespace: the run is the same whichever manager it is."""


def alone(request: TraceRequest) -> TraceRequest:
    """The request that shows what the nodelet does; any other request as it is."""
    if _manager(request) is None:
        return request
    rest = request.args[3:]
    if any(":=" in word for word in rest):
        # Private parameters and remaps, which the loader's process takes under its own name.
        return replace(request, args=("standalone", request.args[1], *rest))
    return replace(request, args=("load", request.args[1], MANAGER, *rest))


def loaded_alone(request: TraceRequest) -> bool:
    """Whether it is what `alone` makes of a nodelet that is to be loaded into a manager."""
    return _manager(request) == MANAGER


def in_process(node: str) -> str:
    """The full name of the process that stands for the manager of a nodelet of this full name."""
    return names.resolve(f"{_SPACE}/{MANAGER}", node)


def with_manager(interface: Interface, request: TraceRequest) -> Interface:
    """The interface of what `alone(request)` runs as that of `request`: what it made in the name of its process is its
    manager's, which it calls, and keeps a bond with."""
    manager = _manager(request)
    if manager is None:
        return interface
    process = in_process(request.node) + "/"
    space, real_space = names.parent(process), names.parent(names.resolve(manager, request.node))

    def of_manager(name: str) -> str:
        if name.startswith(process):
            return f"{manager}/{name[len(process) :]}"
        return real_space + name[len(space) :] if name.startswith(space) else name

    def said(text: str) -> str:
        return text.replace(process, f"{manager}/").replace(space, real_space)

    outcome = interface.outcome
    reason = said(outcome.reason) if outcome.reason is not None else None
    interface = replace(
        interface,
        outcome=replace(outcome, reason=reason, answers=tuple(map(said, outcome.answers))),
        endpoints=tuple(replace(end, name=of_manager(end.name)) for end in interface.endpoints),
        params=tuple(replace(use, name=of_manager(use.name)) for use in interface.params),
    )
    # That much the launch file tells, whatever became of the run.
    source = interface.source if interface.known else "source"
    between = [Endpoint("client", f"{manager}/load_nodelet", "nodelet/NodeletLoad")]
    if "--no-bond" not in request.args:
        # By which each learns that the other has ended.
        between += [Endpoint(role, f"{manager}/bond", "bond/Status") for role in ("publisher", "subscriber")]
    return replace(interface, source=source, endpoints=(*interface.endpoints, *between))


_SLIP = 3
"""Edits between the name of a nodelet and the one that was meant, at most."""
_NO_LIBRARY = re.compile(r"Could not find library corresponding to plugin .* library '([^']*)' actually exists")
_NO_CLASS = re.compile(r"the class (\S+) with base class type nodelet::Nodelet does not exist\. Declared types are(.*)")
_PACKAGE_NOT_THERE = "package '{}' of nodelet '{}' is not among those of this environment"
_DESCRIPTION = re.compile(r"""<nodelet\s+plugin\s*=\s*["']([^"']+)["']""")
_CLASS = re.compile(r"""\b(?:name|type)\s*=\s*["']([^"']+)["']""")


def why_undeclared(request: TraceRequest, environment: Environment, disk: Disk) -> str | None:
    """Why a nodelet need not be run: its package is not there, and no other one declares a class of nearly that name. A
    run would say the same, by `why_not_there`."""
    name = plugin(request)
    if name is None or "nodelet" not in environment.packages:
        return None
    package = name.partition("/")[0]
    declared = _declared(disk.db, environment) if package not in environment.packages else None
    if declared is None or any(map(_is_slip_of(name), declared)):
        return None
    return _PACKAGE_NOT_THERE.format(package, name)


@query
def _declared(db: Database, environment: Environment) -> frozenset[str] | None:
    """All names in the descriptions of nodelets that packages export; None where one cannot be read."""
    disk, found = Disk(db), set[str]()
    for package in (*environment.packages.values(), *chain.from_iterable(environment.shadowed.values())):
        for exported in _DESCRIPTION.findall(disk.content(package.manifest) or ""):
            path = os.path.join(package.share, exported.replace("${prefix}", package.share))
            described = disk.content(os.path.normpath(path))
            if described is None:
                return None
            found.update(each.replace("::", "/") for each in _CLASS.findall(described))
    return frozenset(found)


def may_turn_up(found: Interface) -> bool:
    """Whether a nodelet ended for something that no look at files tells of when it comes: a library or description."""
    said = "\n".join(found.outcome.stderr_tail) if found.outcome.status == "crashed" else ""
    return _NO_LIBRARY.search(said) is not None or _NO_CLASS.search(said) is not None


def why_not_there(found: Interface, request: TraceRequest, environment: Environment) -> str | None:
    """Why it is as if a nodelet had not been run that ended since its library is not built yet, or its package is not
    there; None for any other."""
    name, said = plugin(request), "\n".join(found.outcome.stderr_tail)
    if name is None or found.outcome.status != "crashed":
        return None
    package = name.partition("/")[0]
    if (lacking := _NO_LIBRARY.search(said)) is not None:
        library = os.path.basename(lacking[1]).removeprefix("lib").removesuffix(".so")
        own = any(package == each.name for each in workspace_packages(environment))
        if own and ExecutableIndex(environment).is_library_target(package, library):
            return f"the library '{library}' of nodelet '{name}' is not built yet"
    elif (missing := _NO_CLASS.search(said)) is not None:
        # A class of nearly that name is the one that was meant.
        slip = any(map(_is_slip_of(name), missing[2].split()))
        if not slip and package not in environment.packages:
            return _PACKAGE_NOT_THERE.format(package, name)
    return None


def _is_slip_of(name: str) -> Callable[[str], bool]:
    return lambda other: edits(name, other, _SLIP) <= _SLIP


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


def manager_of(node: LaunchNode) -> str | None:
    """The full name of the manager that a node of a launch has itself loaded into as a nodelet; None of any other."""
    if node.package != "nodelet":
        return None
    found = nodelet_of(node.package, node.executable, split_args(node.args))
    return names.resolve(found.manager, node.name) if found is not None and found.manager is not None else None


def _manager(request: TraceRequest) -> str | None:
    found = nodelet_of(request.package, request.executable, request.args)
    return found.manager if found is not None else None
