"""The records of a run to an Interface and what it depended on."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import Any, cast

from preflight_analysis.dataclass import dataclass
from preflight_analysis.evaluation import names
from preflight_analysis.tracing import nodelets, stand_ins
from preflight_analysis.tracing.dependencies import Dependencies, ParamDependency
from preflight_analysis.tracing.interface import SEEN, Endpoint, Interface, MadeNode, Outcome, ParamUse, Role
from preflight_analysis.tracing.loaded import outcome_of_component
from preflight_analysis.tracing.outcome import NOT_LOADED, outcome_of, seconds_of, stderr_tail
from preflight_analysis.tracing.recipe import Recipe
from preflight_analysis.tracing.records import Gathered, take_node_record, take_supervisor_record
from preflight_analysis.tracing.refusals import refused_param
from preflight_analysis.tracing.request import TraceRequest
from preflight_analysis.tracing.run import RawRun

_LIBRARY_PARAMS = re.compile(r"/(use_sim_time|tcp_keepalive|rosout_disable_topics_generation|enable_statistics"
                             r"|statistics_window_\w+)\Z")  # fmt: skip
_HELD_UP = 1.0
"""Seconds that a node waited for a processor: with them its time may have been enough."""
_LIBRARY_SERVICES = ("get_loggers", "set_logger_level")


@dataclass(frozen=True, slots=True)
class Observation:
    """A checked run. `lasting` tells whether it would come out the same again, so that it may be cached; `wrote` are
    the files that it opened for writing."""

    interface: Interface
    dependencies: Dependencies
    lasting: bool
    wrote: tuple[str, ...] = ()
    drawn: tuple[str, ...] = ()
    """What its own code drew at random."""


def observe(raw: RawRun, recipe: Recipe, request: TraceRequest) -> Observation:
    """Read a run. Never raises, whatever the records are."""
    found = Gathered(dropped=raw.dropped)
    for record in raw.records:
        own, node_record = record.get("own"), record.get("node")
        if isinstance(own, dict):
            taken = take_supervisor_record(own, found)
        elif isinstance(node_record, dict):
            taken = take_node_record(node_record, found)
        else:
            taken = False
        found.dropped += not taken
    tail = stderr_tail(raw.stderr)
    outcome = outcome_of(raw, found, tail, request)
    if found.waited:
        found.answers |= found.fed
    elif found.fed and not found.answers and outcome.status in ("exited", "crashed"):
        # It slept in a loop, and ended of what we gave it without anything else to see.
        outcome = Outcome("spinning", seconds=outcome.seconds)
    if request.component is not None:
        outcome = outcome_of_component(found, outcome)
    outcome = replace(outcome, answers=tuple(found.answers))
    if outcome.status == "not-run":
        return Observation(Interface("none", outcome), Dependencies(), lasting=False)
    if not request.ros.has_master and recipe.preload is not None and not found.woven and (why := _not_seen(outcome)):
        # Nothing was seen of it, which does not say that there is nothing: it is as if it had not been run.
        # What it lacked to be loaded may be installed at any time.
        lasting = not raw.killed and outcome.exit_code != NOT_LOADED
        outcome = Outcome("not-run", stderr_tail=tail, reason=why)
        return Observation(Interface("none", outcome), Dependencies(tuple(found.files)), lasting)
    remaps = names.resolve_remaps(request.remaps, request.node) if recipe.remapped else {}
    if request.ros.has_handles and not recipe.python:
        _correct_names(found, request.node, remaps)
    process = request.node
    if recipe.preload is not None and nodelets.loaded_alone(request):
        process = nodelets.in_process(request.node)
    gone = _withdrawn(found)
    endpoints = tuple(
        e
        for e in _endpoints(found, request.node, remaps, process)
        if not gone or (e.role, names.resolve(e.name, request.node, remaps)) not in gone
    )
    params, param_dependencies = _params(found)
    endpoints, params, nodes = _owned(endpoints, params, tuple(found.nodes))
    if request.ros.own_parameters and recipe.preload is not None:
        params = _without_given(params, nodes, request)
    if request.ros.own_parameters:
        params = _with_refused(params, nodes, outcome)
    asked = set(found.asked)
    if any(node.full for node in nodes):
        asked.add("name")  # which the other nodes' names may be made of, and which of them is the launch file's
    reported = sum(not endpoint.builtin for endpoint, _ in found.endpoints.values())
    unexplained = sum(not endpoint.builtin for endpoint in endpoints) > reported or any(
        not d.given and d.access != "search" and not _LIBRARY_PARAMS.match(d.name) for d in param_dependencies
    )
    watched = found.woven and (recipe.python or recipe.preload is not None)
    if request.ros.own_parameters and recipe.preload is not None:
        # Which it takes without declaring them is not seen.
        param_dependencies.append(ParamDependency("list", "/", given=False))
    if request.ros.own_parameters and (recipe.preload is not None or outcome.status in ("crashed", "exited")):
        # What is wrong with its parameters may stop it before it declares one.
        param_dependencies += [ParamDependency("get", name, given=False) for name in request.params]
    if not watched or unexplained or _is_named(endpoints, params, request.node):
        asked |= {"name", "remaps"} if recipe.remapped else {"name"}
    interface = Interface(
        "trace",
        stand_ins.explained(outcome, found, request.executable),
        tuple(replace(e, evidence=e.evidence.but("stand-in")) for e in endpoints) if found.stand_ins else endpoints,
        params,
        notes=_notes(found),
        frames=tuple(sorted(found.frames)),
        nodes=nodes,
        transitions=tuple(sorted(found.transitions)),
        looks=found.looked or stand_ins.hides_all(found),
        stand_ins=tuple(sorted(found.stand_ins)),
    )
    dependencies = Dependencies(tuple(found.files), tuple(param_dependencies), frozenset(asked), tuple(found.searched))
    lasting = not raw.killed and not raw.cancelled and not _was_held_up(outcome, found.end)
    return Observation(interface, dependencies, lasting, tuple(found.wrote), tuple(found.drawn))


def _was_held_up(outcome: Outcome, end: Mapping[str, Any] | None) -> bool:
    """Whether a node whose time was up may have come further on a machine with less to do."""
    return outcome.status == "timed-out" and seconds_of(end, "queued") > _HELD_UP


def _correct_names(found: Gathered, node: str, remaps: Mapping[str, str]) -> None:
    """A handle of roscpp may have a namespace and remaps of its own: where the graph would not come to the name that
    the library did, the name is the library's."""
    for key, (endpoint, full) in found.endpoints.items():
        if full is not None and names.resolve(endpoint.name, node, remaps) != full:
            found.endpoints[key] = replace(endpoint, name=full), full


def _endpoints(found: Gathered, node: str, remaps: Mapping[str, str], process: str) -> tuple[Endpoint, ...]:
    """The union of both views: what the library told, and what only the master or a wait shows. `process` is the name
    that roscpp has for the node."""
    waited_for = {names.resolve(name, node, remaps) for kind, name, _, _ in found.waits if kind == "service"}
    endpoints = [
        # Waiting for a service is calling it, whatever the answer.
        replace(endpoint, evidence=endpoint.evidence.without("made-up answer"))
        if endpoint.role == "client" and full in waited_for
        else endpoint
        for endpoint, full in found.endpoints.values()
    ]
    known: set[tuple[str, str]] = {
        (e.role, full or names.resolve(e.name, node, remaps)) for e, full in found.endpoints.values()
    }
    for role, name, kind, on_demand in found.seen_endpoints:
        if (role, name) in known:
            continue
        known.add((role, name))
        private = name.removeprefix(process + "/")
        if role == "service" and name.startswith(process + "/") and private in _LIBRARY_SERVICES:
            endpoints.append(Endpoint("service", "~" + private, _logger_type(private), builtin=True))
        else:
            builtin = (role, name) in (("publisher", "/rosout"), ("subscriber", "/clock"))
            evidence = SEEN.but("on demand") if on_demand else SEEN
            endpoints.append(Endpoint(cast(Role, role), name, kind, builtin=builtin, evidence=evidence))
    for kind, name, file, line in found.waits:
        full = names.resolve(name, node, remaps)
        if kind == "service" and ("client", full) not in known:
            known.add(("client", full))
            endpoints.append(Endpoint("client", name, None, source_file=file, source_line=line))
    for full in found.lookups:
        # A node that looks whether its own service is there already (tf2_ros.Buffer) does not call it.
        if not known & {("client", full), ("service", full)}:
            known.add(("client", full))
            endpoints.append(Endpoint("client", full, None))
    return tuple(endpoints)


def _withdrawn(found: Gathered) -> set[tuple[str, str]]:
    """Role and full name of what a node that goes on has offered for a while only. What it listened to for a while, it
    needed."""
    listed = found.end.get("withdrawn") if found.end is not None else None
    pairs = (pair for pair in listed if isinstance(pair, list) and len(pair) == 2) if isinstance(listed, list) else ()
    return {(str(role), str(name)) for role, name in pairs if role in ("publisher", "service")}


def _logger_type(service: str) -> str:
    return {"get_loggers": "roscpp/GetLoggers", "set_logger_level": "roscpp/SetLoggerLevel"}[service]


def _is_named(endpoints: Iterable[Endpoint], params: Iterable[ParamUse], node: str) -> bool:
    """Whether a name looks as if it was put together with the node's own name or namespace, which a roscpp node can
    look up without being seen."""
    space = names.parent(node)
    starts = ("//", f"{node}/", *([space] if space != "/" else []))
    given = [e.name for e in endpoints if not e.builtin] + [p.name for p in params if not p.builtin]
    return any(name.startswith(starts) for name in given)


def _owned(
    endpoints: tuple[Endpoint, ...], params: tuple[ParamUse, ...], nodes: tuple[MadeNode, ...]
) -> tuple[tuple[Endpoint, ...], tuple[ParamUse, ...], tuple[MadeNode, ...]]:
    """With the node that made each where the process has several, and without names where it has one."""
    several = {node.full for node in nodes if node.full and not node.hidden}
    if len(several) < 2:
        several = set()
    return (
        tuple(end if end.node in several else replace(end, node=None) for end in endpoints),
        tuple(use if use.node in several else replace(use, node=None) for use in params),
        tuple(dict.fromkeys(node if several else replace(node, full="") for node in nodes)),
    )


def _params(found: Gathered) -> tuple[tuple[ParamUse, ...], list[ParamDependency]]:
    uses = [use for use, _ in found.params.values()]
    known = {(use.access, full) for use, full in found.params.values()}
    searched = any(use.access == "search" for use in uses)
    dependencies = {ParamDependency(use.access, use.name, given=True): None for use in uses}
    for access, name in found.seen_params:
        if (access, name) in known or (access == "search" and searched):
            continue
        known.add((access, name))
        builtin = _LIBRARY_PARAMS.match(name) is not None
        uses.append(ParamUse(name, access, builtin=builtin))
        dependencies[ParamDependency(access, name, given=False)] = None
    return tuple(uses), [d for d in dependencies if d.access in ("get", "has", "search", "list")]


def _with_refused(params: tuple[ParamUse, ...], nodes: tuple[MadeNode, ...], outcome: Outcome) -> tuple[ParamUse, ...]:
    """With the parameter that the node ended for, which is one of the last that was made."""
    refused = refused_param(outcome)
    if refused is None:
        return params
    made = [node.full for node in nodes if not node.hidden]
    refused = replace(refused, node=(made[-1] or None) if made else None)
    known = next((p for p in params if (p.name, p.node, p.access) == (refused.name, refused.node, "get")), None)
    if known is None:
        return (*params, refused)
    whole = replace(known, type=known.type or refused.type, mandatory=refused.mandatory, refused=refused.refused)
    return tuple(whole if param is known else param for param in params)


def _without_given(
    params: tuple[ParamUse, ...], nodes: tuple[MadeNode, ...], request: TraceRequest
) -> tuple[ParamUse, ...]:
    """Parameters that a client library told as it declared them: a value that the launch file gives hides the default.
    Of a node of which none was told rcl knows nothing of them, and it may take any."""
    given = request.given_to
    reported = tuple(replace(p, default=None, has_default=False) if p.name[1:] in given(p.node) else p for p in params)
    owners = {use.node for use in params}
    full = dict.fromkeys(node.full or None for node in nodes if not node.hidden) or {None: None}
    return reported + tuple(ParamUse("/", "list", node=name) for name in full if name not in owners)


def _not_seen(outcome: Outcome) -> str | None:
    """Why nothing was seen of a program that never called rcl, unless that is a fault of its own."""
    if outcome.exit_code == NOT_LOADED:
        return f"it cannot be loaded here: {outcome.reason}"
    return None if outcome.status == "crashed" else "it does not use rcl, or not within the time that it was given"


def _notes(found: Gathered) -> tuple[str, ...]:
    notes = list(found.answers)
    wrote = [p for p in found.wrote if not p.startswith(("/tmp/ros_home", "/tmp/ros_log", "/run/", "/dev/"))]  # noqa: S108
    if wrote:
        more = f" and {len(wrote) - 3} more" if len(wrote) > 3 else ""
        notes.append(
            "it opened files for writing, which the sandbox kept from the disk: " + ", ".join(wrote[:3]) + more
        )
    if found.dropped:
        notes.append(f"{found.dropped} records of the run were malformed or too many, and were left out")
    notes += [f"part of the node's calls could not be watched: {failure}" for failure in found.failures]
    return tuple(notes)
