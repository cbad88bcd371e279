"""The records of a run to an Interface and what it depended on.

Every field is checked: the node could have written the records itself. What does not fit is dropped and counted.
"""

from __future__ import annotations

import math
import re
import signal
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any, TypeGuard, cast

from preflight_analysis.evaluation import names
from preflight_analysis.tracing import sandbox
from preflight_analysis.tracing.agents.feeder import ANY_TYPE
from preflight_analysis.tracing.interface import (
    REASON_COLUMNS,
    Endpoint,
    Frame,
    Interface,
    MadeNode,
    Outcome,
    ParamUse,
    Range,
    Role,
    telling_line,
)
from preflight_analysis.tracing.recipe import Recipe, missing_interpreter
from preflight_analysis.tracing.refusals import refused_param
from preflight_analysis.tracing.request import TraceRequest
from preflight_analysis.tracing.run import DISK_BYTES, RLIMITS, WALL_SECONDS, RawRun

MAX_ENDPOINTS = 2_000
MAX_PARAMS = 5_000
MAX_FRAMES = 500
MAX_NODES = 100
MAX_FILES = 10_000
MAX_ANSWERS = 20
MAX_DEPTH = 20
"""Of a default value."""
TAIL_LINES = 20
TAIL_COLUMNS = 500

_ROLES = ("publisher", "subscriber", "service", "client", "action_server", "action_client")
_ACCESS = ("get", "has", "set", "delete", "search", "list")
_NAME = re.compile(r"[^\x00-\x1f\x7f-\x9f\ud800-\udfff]{1,300}\Z")
"""No control characters, of a terminal's either, and none that UTF-8 cannot say."""
_FULL_NAME = re.compile(r"/[\w/]{1,300}\Z", re.ASCII)
_FILE = re.compile(r"/[^\x00-\x1f\x7f-\x9f\ud800-\udfff]{0,4095}\Z")
_TYPE = re.compile(r"(\*|[A-Za-z]\w*/((msg|srv|action)/)?[A-Za-z]\w*)\Z")
_MD5 = re.compile(r"(\*|[0-9a-f]{32})\Z")
_PARAM_TYPE = re.compile(r"(bool|integer|double|string|byte)( array)?\Z")
_MOST = 1e308
"""Of the ends of a range: what JSON can say and others can compare."""
_POLICIES = {
    "reliability": ("reliable", "best_effort"),
    "durability": ("volatile", "transient_local"),
    "liveliness": ("automatic", "manual_by_topic"),
}
_ESCAPES = re.compile(r"\x1b(\[[0-?]*[ -/]*[@-~]|\][^\x07\x1b]*(\x07|\x1b\\)|[@-Z\\-_])")
_CONTROL = re.compile(r"[\x00-\x08\x0b-\x1f\x7f-\x9f]")
_UNSAYABLE = re.compile(r"[\x00-\x08\x0b-\x1f\x7f-\x9f\ud800-\udfff]")
"""What neither a terminal nor UTF-8 should be given."""
_LIBRARY_PARAMS = re.compile(r"/(use_sim_time|tcp_keepalive|rosout_disable_topics_generation|enable_statistics"
                             r"|statistics_window_\w+)\Z")  # fmt: skip
_ANSWERS = {
    "service": "it waits for the service {}, and was told that it is there",
    "services": "it asks for the service {} again and again, and was told that it is there",
    "call": "it calls the service {}, and was given an empty answer",
    "calls": "it calls the service {} again and again, and was given an empty answer",
    "message": "it waits for a message on {}, and was given an empty one",
    "poll": "it waits for messages on {}, and was given empty ones",
    "parameter": "it waits for the parameter {}, and was given a value",
    "action": "it waits for the action server {}, and was told that it is there",
    "result": "it waits for the result of the action {}, and was given an empty one",
    "transform": "it waits for the transform {}, and was given the identity",
    "transforms": "it asks for the transform {} again and again, and was given the identity",
    "clock": "it waits for simulated time on {}, and was given the time of day",
    "transition": "it was asked to {}, as a manager of lifecycle nodes would, and did not",
}
_WAITS = {
    "service": "the service {}",
    "message": "a message on {}",
    "services": "the service {}",
    "call": "the answer of the service {}",
    "calls": "the answer of the service {}",
    "action": "the action server {}",
    "result": "the result of the action {}",
    "transform": "the transform {}",
    "transforms": "the transform {}",
    "parameter": "the parameter {}",
    "poll": "messages on {}",
    "clock": "simulated time on {}",
}
"""What a node waits for at its end, by the kind that the library told."""
_MAYBE = ("poll", "services", "calls", "transforms", "parameter", "clock")
_BY_ENV = re.compile(r"\S*env: ['‘](.+?)(\\r)?['’]: No such file or directory")
_WINDOWS = "; the file has the line ends of Windows"
_NOT_LOADED = 127
"""What the loader ends a program with whose libraries are not found."""
_HELD_UP = 1.0
"""Seconds that a node waited for a processor: with them its time may have been enough."""
_LIBRARY_SERVICES = ("get_loggers", "set_logger_level")


@dataclass(frozen=True, slots=True)
class ParamDependency:
    """A look at the parameter server. `name` is as the node gave it if `given`, else the full name."""

    access: str
    name: str
    given: bool


@dataclass(frozen=True, slots=True)
class Dependencies:
    """What the run depended on. `asked` has `name`, `namespace`, `remaps` if the node looked at them itself."""

    files: tuple[str, ...] = ()
    params: tuple[ParamDependency, ...] = ()
    asked: frozenset[str] = frozenset()


@dataclass(frozen=True, slots=True)
class Observation:
    """A checked run. `lasting` tells whether it would come out the same again, so that it may be cached; `wrote` are
    the files that it opened for writing."""

    interface: Interface
    dependencies: Dependencies
    lasting: bool
    wrote: tuple[str, ...] = ()


@dataclass(slots=True)
class _Gathered:
    endpoints: dict[str, tuple[Endpoint, str | None]] = field(default_factory=dict)
    params: dict[str, tuple[ParamUse, str | None]] = field(default_factory=dict)
    """By their `repr`, so that each counts once; with the resolved name that the library told."""
    seen_endpoints: list[tuple[str, str, str | None, bool]] = field(default_factory=list)
    seen_params: list[tuple[str, str]] = field(default_factory=list)
    lookups: list[str] = field(default_factory=list)
    waits: list[tuple[str, str, str | None, int | None]] = field(default_factory=list)
    files: dict[str, None] = field(default_factory=dict)
    asked: set[str] = field(default_factory=set)
    frames: dict[Frame, None] = field(default_factory=dict)
    nodes: dict[MadeNode, None] = field(default_factory=dict)
    wrote: dict[str, None] = field(default_factory=dict)
    failures: list[str] = field(default_factory=list)
    answers: dict[str, None] = field(default_factory=dict)
    fed: dict[str, None] = field(default_factory=dict)
    """Answers to what only looked like a wait."""
    waited: bool = False
    """Whether it did: there was something new after it."""
    woven: bool = False
    visited: bool = False
    """Whether somebody was there for its topics."""
    looked: bool = False
    """Whether it asked which nodes, topics or services there are."""
    declared: dict[tuple[str, str | None], str] = field(default_factory=dict)
    """Parameters of ROS 2 by name and node, with their keys in `params`."""
    end: Mapping[str, Any] | None = None
    dropped: int = 0


def observe(raw: RawRun, recipe: Recipe, request: TraceRequest) -> Observation:
    """Read a run. Never raises, whatever the records are."""
    found = _Gathered(dropped=raw.dropped)
    for record in raw.records:
        own, told = record.get("own"), record.get("node")
        if isinstance(own, dict):
            taken = _own(own, found)
        elif isinstance(told, dict):
            taken = _told(told, found)
        else:
            taken = False
        found.dropped += not taken
    tail = stderr_tail(raw.stderr)
    outcome = _outcome(raw, found, tail, request)
    if found.waited:
        found.answers |= found.fed
    elif found.fed and not found.answers and outcome.status in ("exited", "crashed"):
        # It slept in a loop, and ended of what we gave it without anything else to see.
        outcome = Outcome("spinning", seconds=outcome.seconds)
    outcome = replace(outcome, answers=tuple(found.answers))
    if outcome.status == "not-run":
        return Observation(Interface("none", outcome), Dependencies(), lasting=False)
    if request.generation == 2 and recipe.preload is not None and not found.woven and (why := _not_seen(outcome)):
        # Nothing was seen of it, which does not say that there is nothing: it is as if it had not been run.
        outcome = Outcome("not-run", stderr_tail=tail, reason=why)
        return Observation(Interface("none", outcome), Dependencies(tuple(found.files)), lasting=not raw.killed)
    remaps = names.resolve_remaps(request.remaps, request.node) if recipe.remapped else {}
    if request.generation == 1 and not recipe.python:
        _correct_names(found, request.node, remaps)
    gone = _withdrawn(found)
    endpoints = tuple(
        e
        for e in _endpoints(found, request.node, remaps)
        if not gone or (e.role, names.resolve(e.name, request.node, remaps)) not in gone
    )
    params, param_dependencies = _params(found)
    endpoints, params, nodes = _owned(endpoints, params, tuple(found.nodes))
    if request.generation == 2 and recipe.preload is not None:
        params = _without_given(params, nodes, request)
    if request.generation == 2:
        params = _with_refused(params, nodes, outcome)
    asked = set(found.asked)
    if any(node.full for node in nodes):
        asked.add("name")  # which the other nodes' names may be made of, and which of them is the launch file's
    told = sum(not endpoint.builtin for endpoint, _ in found.endpoints.values())
    unexplained = sum(not endpoint.builtin for endpoint in endpoints) > told or any(
        not d.given and d.access != "search" and not _LIBRARY_PARAMS.match(d.name) for d in param_dependencies
    )
    watched = found.woven and (recipe.python or recipe.preload is not None)
    if request.generation == 2 and recipe.preload is not None:
        # Which it takes without declaring them is not seen.
        param_dependencies.append(ParamDependency("list", "/", given=False))
    if request.generation == 2 and (recipe.preload is not None or outcome.status in ("crashed", "exited")):
        # What is wrong with its parameters may stop it before it declares one.
        param_dependencies += [ParamDependency("get", name, given=False) for name in request.params]
    if not watched or unexplained or _is_named(endpoints, params, request.node):
        asked |= {"name", "remaps"} if recipe.remapped else {"name"}
    interface = Interface(
        "trace",
        outcome,
        endpoints,
        params,
        notes=_notes(found),
        frames=tuple(sorted(found.frames)),
        nodes=nodes,
        looks=found.looked,
    )
    dependencies = Dependencies(tuple(found.files), tuple(param_dependencies), frozenset(asked))
    lasting = not raw.killed and not raw.cancelled and not _was_held_up(outcome, found.end)
    return Observation(interface, dependencies, lasting, tuple(found.wrote))


def _was_held_up(outcome: Outcome, end: Mapping[str, Any] | None) -> bool:
    """Whether a node whose time was up may have come further on a machine with less to do."""
    return outcome.status == "timed-out" and _seconds(end, "queued") > _HELD_UP


def _seconds(end: Mapping[str, Any] | None, name: str) -> float:
    value = end.get(name) if end is not None else None
    return float(value) if isinstance(value, (int, float)) and 0 <= value < 3600 else 0.0


def stderr_tail(data: bytes) -> tuple[str, ...]:
    """The last lines, without terminal escapes, other control characters and our own frames in tracebacks."""
    lines: list[str] = []
    ours = False
    for raw_line in data.decode(errors="replace").split("\n"):
        line = _CONTROL.sub("", _ESCAPES.sub("", raw_line.rpartition("\r")[2] or raw_line)).rstrip()
        if line.startswith("  File "):
            ours = f'"{sandbox.LIBRARY}' in line
        elif not line.startswith("    "):
            ours = False
        if line and not ours:
            lines.append(line[:TAIL_COLUMNS])
    return tuple(lines[-TAIL_LINES:])


def _text(value: object, pattern: re.Pattern[str]) -> str | None:
    return value if isinstance(value, str) and pattern.match(value) else None


def _is_number(value: object) -> TypeGuard[int]:
    """Whether it is an integer that others can be told: JSON's and Python's have any size."""
    return isinstance(value, int) and not isinstance(value, bool) and -(2**31) <= value < 2**31


def _place(record: Mapping[str, Any]) -> tuple[str | None, int | None]:
    file, line = record.get("file"), record.get("line")
    if _text(file, _FILE) and _is_number(line) and line > 0:
        return file, line
    return None, None


def paths(value: object) -> Iterable[str]:
    """The absolute paths of a list that came out of the sandbox."""
    return (
        (p for p in value if isinstance(p, str) and p.startswith("/") and len(p) < 4096 and "\0" not in p)
        if (isinstance(value, list))
        else ()
    )


def _told(record: Mapping[str, Any], found: _Gathered) -> bool:
    """What the woven library says."""
    match record.get("ev"):
        case "endpoint":
            return _told_endpoint(record, found)
        case "param":
            return _told_param(record, found)
        case "frame":
            parent, child = _text(record.get("parent"), _NAME), _text(record.get("child"), _NAME)
            if parent is None or child is None or len(found.frames) >= MAX_FRAMES:
                return False
            found.frames[Frame(parent, child, record.get("static") is True)] = None
        case "node":
            name, given = _text(record.get("name"), _NAME), _text(record.get("given"), _NAME)
            space = _text(record.get("space"), _NAME) or ""
            if name is None or given is None or len(found.nodes) >= MAX_NODES:
                return False
            full = _text(record.get("full"), _FULL_NAME) or ""
            found.nodes[MadeNode(name, given, space, record.get("renamed") is True, full=full)] = None
        case "asked" if record.get("what") == "graph":
            found.looked = True
        case "asked" if record.get("what") in ("name", "namespace", "remaps"):
            found.asked.add(str(record["what"]))
        case "files":
            _add_files(paths(record.get("paths")), found)
        case "wrote":
            if len(found.wrote) < 100:
                found.wrote.update((p, None) for p in paths([record.get("path")]) if _FILE.match(p))
        case "state" if record.get("state") == "wait":
            kind, name = record.get("kind"), _text(record.get("name"), _NAME)
            if kind in ("service", "message") and name is not None:
                found.waits.append((str(kind), name, *_place(record)))
        case "answered":
            kind, name = record.get("kind"), _text(record.get("name"), _NAME)
            if kind not in _ANSWERS or name is None or len(found.answers) >= MAX_ANSWERS:
                return False
            (found.fed if kind in _MAYBE else found.answers)[_ANSWERS[kind].format(name)] = None
        case "woven":
            found.woven = True
        case "weave-failed":
            if len(found.failures) < 3:
                found.failures.append(_CONTROL.sub("", str(record.get("message")))[:300])
        case _:
            return False
    return True


def _told_endpoint(record: Mapping[str, Any], found: _Gathered) -> bool:
    role, name = record.get("role"), _text(record.get("name"), _NAME)
    if role not in _ROLES or name is None or len(found.endpoints) >= MAX_ENDPOINTS:
        return False
    qos = _qos(record.get("qos")) if role in ("publisher", "subscriber") else {}
    file, line = _place(record)
    passed_on = record.get("type") == ANY_TYPE
    endpoint = Endpoint(
        cast(Role, role),
        name,
        "*" if passed_on else _text(record.get("type"), _TYPE),
        "*" if passed_on else _text(record.get("md5"), _MD5),
        qos,
        file,
        line,
        builtin=record.get("builtin") is True,
        speculative=record.get("speculative") is True,
        on_demand=found.visited,
        node=_text(record.get("node"), _FULL_NAME),
    )
    # One that it made before as well is sure.
    key = repr(replace(endpoint, speculative=False, on_demand=False))
    found.waited = found.waited or (bool(found.fed) and key not in found.endpoints)
    found.endpoints.setdefault(key, (endpoint, _text(record.get("resolved"), _NAME)))
    return True


def _qos(given: object) -> dict[str, Any]:
    """The policies of a topic's end: those of ROS 1, or those of ROS 2."""
    if not isinstance(given, dict):
        return {}
    qos: dict[str, Any] = {}
    if isinstance(given.get("latch"), bool):
        qos["latch"] = given["latch"]
    if "queue_size" in given and (given["queue_size"] is None or _is_number(given["queue_size"])):
        qos["queue_size"] = given["queue_size"]
    for policy, words in _POLICIES.items():
        if given.get(policy) in words:
            qos[policy] = given[policy]
    if _is_number(given.get("depth")):
        qos["depth"] = given["depth"]
    for policy in ("deadline", "lease_duration"):
        seconds = given.get(policy)
        if isinstance(seconds, float) and math.isfinite(seconds) and seconds > 0:
            qos[policy] = seconds
    return qos


def _told_param(record: Mapping[str, Any], found: _Gathered) -> bool:
    access, name = record.get("access"), _text(record.get("name"), _NAME)
    if access not in _ACCESS or name is None or len(found.params) >= MAX_PARAMS:
        return False
    file, line = _place(record)
    has_default = record.get("has_default") is True
    use = ParamUse(
        name,
        str(access),
        _plain(record.get("default")) if has_default else None,
        has_default,
        mandatory=access == "get" and not has_default and record.get("optional") is not True,
        source_file=file,
        source_line=line,
        builtin=record.get("builtin") is True,
        type=_text(record.get("type"), _PARAM_TYPE),
        dynamic=record.get("dynamic") is True,
        read_only=record.get("read_only") is True,
        range=_range(record.get("range")),
        node=_text(record.get("node"), _FULL_NAME),
    )
    found.waited = found.waited or (bool(found.fed) and repr(use) not in found.params)
    resolved = _text(record.get("resolved"), _NAME)
    key = found.declared.setdefault((use.name, use.node), repr(use)) if access == "get" else repr(use)
    if record.get("described") is True and key in found.params:
        # The default is what was told as it was declared: it may be another value by now.
        known = found.params[key][0]
        use = replace(use, default=known.default, has_default=known.has_default, type=known.type or use.type)
        found.params[key] = use, resolved
    else:
        found.params.setdefault(repr(use), (use, resolved))
    return True


def _range(given: object) -> Range | None:
    if not isinstance(given, list) or len(given) != 3:
        return None
    if not all(isinstance(end, (int, float)) and abs(end) < _MOST and not isinstance(end, bool) for end in given):
        return None
    return Range(*given)


def _own(record: Mapping[str, Any], found: _Gathered) -> bool:
    """What the supervisor and its master say."""
    match record.get("ev"):
        case "m-endpoint":
            role, name = record.get("role"), _text(record.get("name"), _NAME)
            if role not in _ROLES or name is None or len(found.seen_endpoints) >= MAX_ENDPOINTS:
                return False
            kind = "*" if record.get("type") == ANY_TYPE else _text(record.get("type"), _TYPE)
            found.seen_endpoints.append((str(role), name, kind, found.visited))
        case "m-param":
            access, name = record.get("access"), _text(record.get("name"), _NAME)
            if access not in _ACCESS or name is None or len(found.seen_params) >= MAX_PARAMS:
                return False
            found.seen_params.append((str(access), name))
        case "m-lookup":
            name = _text(record.get("name"), _NAME)
            if name is None or len(found.lookups) >= MAX_ENDPOINTS:
                return False
            found.lookups.append(name)
        case "started":
            pass
        case "visited":
            found.visited = True
        case "maps":
            _add_files(paths(record.get("paths")), found)
        case "end":
            found.end = record
            if isinstance(record.get("dropped"), int):
                found.dropped += min(max(record["dropped"], 0), 10**9)
        case _:
            return False
    return True


def _add_files(paths: Iterable[str], found: _Gathered) -> None:
    for path in paths:
        if len(found.files) < MAX_FILES:
            found.files[path] = None


def _correct_names(found: _Gathered, node: str, remaps: Mapping[str, str]) -> None:
    """A handle of roscpp may have a namespace and remaps of its own: where the graph would not come to the name that
    the library did, the name is the library's."""
    for key, (endpoint, full) in found.endpoints.items():
        if full is not None and names.resolve(endpoint.name, node, remaps) != full:
            found.endpoints[key] = replace(endpoint, name=full), full


def _endpoints(found: _Gathered, node: str, remaps: Mapping[str, str]) -> tuple[Endpoint, ...]:
    """The union of both views: what the library told, and what only the master or a wait shows."""
    waited_for = {names.resolve(name, node, remaps) for kind, name, _, _ in found.waits if kind == "service"}
    endpoints = [
        # Waiting for a service is calling it, whatever the answer.
        replace(endpoint, speculative=False) if endpoint.role == "client" and full in waited_for else endpoint
        for endpoint, full in found.endpoints.values()
    ]
    known: set[tuple[str, str]] = {
        (e.role, full or names.resolve(e.name, node, remaps)) for e, full in found.endpoints.values()
    }
    for role, name, kind, on_demand in found.seen_endpoints:
        if (role, name) in known:
            continue
        known.add((role, name))
        private = name.removeprefix(node + "/")
        if role == "service" and name.startswith(node + "/") and private in _LIBRARY_SERVICES:
            endpoints.append(Endpoint("service", "~" + private, _logger_type(private), builtin=True))
        else:
            builtin = (role, name) in (("publisher", "/rosout"), ("subscriber", "/clock"))
            endpoints.append(Endpoint(cast(Role, role), name, kind, builtin=builtin, on_demand=on_demand))
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
    told = tuple(replace(p, default=None, has_default=False) if p.name[1:] in given(p.node) else p for p in params)
    owners = {use.node for use in params}
    full = dict.fromkeys(node.full or None for node in nodes if not node.hidden) or {None: None}
    return told + tuple(ParamUse("/", "list", node=name) for name in full if name not in owners)


def _not_seen(outcome: Outcome) -> str | None:
    """Why nothing was seen of a program that never called rcl, unless that is a fault of its own."""
    if outcome.exit_code == _NOT_LOADED:
        return f"it cannot be loaded here: {outcome.reason}"
    return None if outcome.status == "crashed" else "it does not use rcl, or not within the time that it was given"


def _withdrawn(found: _Gathered) -> set[tuple[str, str]]:
    """Role and full name of what a node that goes on has offered for a while only. What it listened to for a while, it
    needed."""
    listed = found.end.get("withdrawn") if found.end is not None else None
    pairs = (pair for pair in listed if isinstance(pair, list) and len(pair) == 2) if isinstance(listed, list) else ()
    return {(str(role), str(name)) for role, name in pairs if role in ("publisher", "service")}


def _logger_type(service: str) -> str:
    return {"get_loggers": "roscpp/GetLoggers", "set_logger_level": "roscpp/SetLoggerLevel"}[service]


def _params(found: _Gathered) -> tuple[tuple[ParamUse, ...], list[ParamDependency]]:
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


def _outcome(raw: RawRun, found: _Gathered, tail: tuple[str, ...], request: TraceRequest) -> Outcome:
    if raw.cancelled:
        return Outcome("not-run", reason="the run was cancelled")
    end = found.end
    if end is None:
        if raw.killed:
            return Outcome("timed-out", None, None, tail, "the sandbox did not end in time and was killed")
        if not found.endpoints and not found.seen_endpoints and not found.woven:
            said = f": {tail[-1]}" if tail else ""
            return Outcome("not-run", None, None, tail, f"the sandbox could not start the node{said}")
        return Outcome("crashed", None, None, tail, "the node ended the whole sandbox")
    spent = _seconds(end, "seconds")
    code = end.get("code")
    match end.get("status"):
        case "spinning":
            return Outcome("spinning", seconds=spent)
        case "timed-out":
            return Outcome("timed-out", None, None, tail, _waiting(end, found, request), spent)
        case "crowded":
            reason = f"it started more than {sandbox.PROCESSES} processes and was stopped"
            return Outcome("crashed", None, None, tail, reason, spent)
        case "heavy":
            reason = f"it took more than {sandbox.most_memory() / (1 << 30):.1f} GiB of memory and was stopped"
            return Outcome("crashed", None, None, tail, reason, spent)
        case "full":
            reason = f"it wrote more than {DISK_BYTES >> 20} MiB and was stopped"
            return Outcome("crashed", None, None, tail, reason, spent)
        case "exec-failed":
            return Outcome("crashed", 127, None, tail, f"the executable cannot be started: {_why(end, request)}", spent)
        case "ended" if _is_number(code) and 0 < -code < 65:
            return Outcome("crashed", None, _signal(-code), tail, _signal_reason(-code, tail), spent)
        case "ended" if _is_number(code) and code == 0:
            return Outcome("exited", 0, None, tail, "the node ended by itself, with exit code 0", spent)
        case "ended" if _is_number(code):
            return Outcome("crashed", code, None, tail, _crash_reason(code, tail), spent)
    return Outcome("crashed", None, None, tail, "the node garbled the report of its run", spent)


def _why(end: Mapping[str, Any], request: TraceRequest) -> str:
    interpreter = missing_interpreter(request.executable)
    if interpreter is None:
        return _CONTROL.sub("", str(end.get("why")))[:300]
    name = _CONTROL.sub("", interpreter)[:300]
    said = f"there is no '{name}', which its first line names"
    return said + _WINDOWS if interpreter.endswith("\r") else said


def _waiting(end: Mapping[str, Any], found: _Gathered, request: TraceRequest) -> str:
    """Why its time was up: what it waits for, and what made-up answers did not help, as far as it is known."""
    waits = end.get("waits")
    limit = f"within {WALL_SECONDS:g} s"
    text = f"it did not reach its event loop {limit}" + ("" if end.get("initialised") else ", nor register as a node")
    given = [*found.answers, *found.fed]
    if isinstance(waits, list) and waits and isinstance(waits[0], list) and len(waits[0]) == 2:
        kind, name = waits[0]
        if isinstance(kind, str) and kind in _WAITS and _text(name, _NAME):
            text = f"it waits for {_WAITS[kind].format(name)}, and did not reach its event loop {limit}"
    elif _seconds(end, "cpu") > WALL_SECONDS / 2:
        text = f"it is slow: it was still busy {limit.replace('within', 'after')}"
    elif request.params.get("/use_sim_time") is True and not any("simulated time" in answer for answer in given):
        text += "; it may wait for simulated time: /use_sim_time is set, and nobody tells the time here"
    return text + (f"; before that {'; '.join(given)}" if given else "")


def _signal(number: int) -> str:
    try:
        return signal.Signals(number).name
    except ValueError:
        return f"signal {number}"


def _signal_reason(number: int, tail: tuple[str, ...]) -> str:
    if number == signal.SIGXCPU:
        return f"it used more than {RLIMITS['CPU']} s of processor time"
    return f"it was killed by {_signal(number)}" + _told_by(tail)


def _crash_reason(code: int, tail: tuple[str, ...]) -> str:
    unknown = next(filter(None, map(_BY_ENV.match, tail)), None) if code == _NOT_LOADED else None
    if unknown is not None:
        said = f"the executable cannot be started: there is no '{unknown[1]}' on the PATH, which its first line names"
        return said + (_WINDOWS if unknown[2] else "")
    return f"it ended with exit code {code}" + _told_by(tail)


def _told_by(tail: tuple[str, ...]) -> str:
    line = telling_line(tail)
    return f": {line[:REASON_COLUMNS]}" if line else ""


def _notes(found: _Gathered) -> tuple[str, ...]:
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


def _plain(value: Any, depth: int = MAX_DEPTH) -> Any:
    """A default value, of JSON's types and bounded."""
    if isinstance(value, float) and not math.isfinite(value):
        return repr(value)
    if isinstance(value, int) and value.bit_length() > 64:
        return f"a number of {value.bit_length()} bits"
    if isinstance(value, str):
        return _UNSAYABLE.sub("", value[:4000])
    if isinstance(value, list):
        return [_plain(item, depth - 1) for item in value[:1000]] if depth else []
    if isinstance(value, dict):
        return {_plain(k): _plain(v, depth - 1) for k, v in list(value.items())[:1000]} if depth else {}
    return value
