"""The records of a run, one by one.

Every field is checked: the node could have written the records itself. What does not fit is dropped and counted.
"""

from __future__ import annotations

import math
import os
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import field, replace
from typing import Any, TypeGuard, cast

from preflight_analysis.dataclass import dataclass
from preflight_analysis.tracing.agents.fake_publisher import ANY_TYPE
from preflight_analysis.tracing.interface import SEEN, Endpoint, Frame, MadeNode, ParamUse, Range, Role, Unsure

MAX_ENDPOINTS = 2_000
MAX_PARAMS = 5_000
MAX_FRAMES = 500
MAX_NODES = 100
MAX_FILES = 10_000
MAX_ANSWERS = 20
MAX_DRAWN = 64
MAX_STAND_INS = 200
MAX_DEPTH = 20
"""Of a default value."""
_ROLES = ("publisher", "subscriber", "service", "client", "action_server", "action_client")
_ACCESS = ("get", "has", "set", "delete", "search", "list")
NAME = re.compile(r"[^\x00-\x1f\x7f-\x9f\ud800-\udfff]{1,300}\Z")
"""No control characters, of a terminal's either, and none that UTF-8 cannot say."""
_FULL_NAME = re.compile(r"/[\w/]{1,300}\Z", re.ASCII)
_FILE = re.compile(r"/[^\x00-\x1f\x7f-\x9f\ud800-\udfff]{0,4095}\Z")
_TYPE = re.compile(r"(\*|[A-Za-z]\w*/((msg|srv|action)/)?[A-Za-z]\w*)\Z")
_MODULE = re.compile(r"[^\W\d]\w{0,100}\Z")
_MD5 = re.compile(r"(\*|[0-9a-f]{32})\Z")
_PARAM_TYPE = re.compile(r"(bool|integer|double|string|byte)( array)?\Z")
_MOST = 1e308
"""Of the ends of a range: what JSON can say and others can compare."""
_POLICIES = {
    "reliability": ("reliable", "best_effort"),
    "durability": ("volatile", "transient_local"),
    "liveliness": ("automatic", "manual_by_topic"),
}
CONTROL = re.compile(r"[\x00-\x08\x0b-\x1f\x7f-\x9f]")
_UNSAYABLE = re.compile(r"[\x00-\x08\x0b-\x1f\x7f-\x9f\ud800-\udfff]")
"""What neither a terminal nor UTF-8 should be given."""
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
_MAYBE = ("poll", "services", "calls", "transforms", "parameter", "clock")


@dataclass(slots=True)
class Gathered:
    """What the records of a run have said so far."""

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
    probed: bool = False
    """Whether somebody was there for its topics."""
    looked: bool = False
    """Whether it asked which nodes, topics or services there are."""
    declared: dict[tuple[str, str | None], str] = field(default_factory=dict)
    """Parameters of ROS 2 by name and node, with their keys in `params`."""
    stand_ins: set[str] = field(default_factory=set)
    """Modules that were missing."""
    lacked: set[str] = field(default_factory=set)
    """Modules that were missing and that the program itself did without."""
    transitions: set[str] = field(default_factory=set)
    """Those that a lifecycle node made by itself."""
    searched: dict[str, None] = field(default_factory=dict)
    """Where they could turn up."""
    drawn: list[str] = field(default_factory=list)
    """What its own code drew at random, as text."""
    loading: bool = False
    """Whether it was asked to."""
    loaded: str | None = None
    """What it answered: "" where it did, else why not."""
    unknown: bool = False
    """Whether it used a value that a stand-in has in the place of one that is not known."""
    end: Mapping[str, Any] | None = None
    dropped: int = 0


def take_node_record(record: Mapping[str, Any], found: Gathered) -> bool:
    """What the woven library says. Where a container was started for a component, what it makes itself is left out."""
    if record.get("of_container") is True and record.get("ev") in ("endpoint", "param", "node"):
        return True
    match record.get("ev"):
        case "endpoint":
            return _take_endpoint(record, found)
        case "param":
            return _take_param(record, found)
        case "frame":
            parent, child = checked_text(record.get("parent"), NAME), checked_text(record.get("child"), NAME)
            if parent is None or child is None or len(found.frames) >= MAX_FRAMES:
                return False
            found.frames[Frame(parent, child, record.get("static") is True)] = None
        case "node":
            name, given = checked_text(record.get("name"), NAME), checked_text(record.get("given"), NAME)
            space = checked_text(record.get("space"), NAME) or ""
            if name is None or given is None or len(found.nodes) >= MAX_NODES:
                return False
            full = checked_text(record.get("full"), _FULL_NAME) or ""
            renamed, own = record.get("renamed") is True, record.get("own_arguments_only") is True
            found.nodes[MadeNode(name, given, space, renamed, full=full, own_arguments_only=own)] = None
        case "transition" if record.get("name") in ("configure", "activate"):
            found.transitions.add(str(record["name"]))
        case "loaded":
            why = record.get("error")
            if not isinstance(why, str) or found.loaded is not None:
                return False
            said = " ".join(_UNSAYABLE.sub("", why[:4000]).split())
            found.loaded = "" if record.get("success") is True else said or "it does not say why"
        case "asked" if record.get("what") == "graph":
            found.looked = True
        case "asked" if record.get("what") == "stand-in":
            found.unknown = True
        case "stood-in":
            name = checked_text(record.get("name"), _MODULE)
            if name is None or len(found.stand_ins) >= MAX_STAND_INS:
                return False
            found.stand_ins.add(name)
            found.searched.update((path, None) for path in list(paths(record.get("paths")))[:MAX_STAND_INS])
        case "lacked":
            name = checked_text(record.get("name"), _MODULE)
            if name is None or len(found.lacked) >= MAX_STAND_INS:
                return False
            found.lacked.add(name)
        case "asked" if record.get("what") in ("name", "namespace", "remaps"):
            found.asked.add(str(record["what"]))
        case "drew":
            value = record.get("value")
            if not isinstance(value, str) or len(found.drawn) >= MAX_DRAWN:
                return False
            found.drawn.append(_UNSAYABLE.sub("", value[:100]))
        case "files":
            _add_files(paths(record.get("paths")), found)
        case "wrote":
            if len(found.wrote) < 100:
                found.wrote.update((p, None) for p in paths([record.get("path")]) if _FILE.match(p))
        case "state" if record.get("state") == "wait":
            kind, name = record.get("kind"), checked_text(record.get("name"), NAME)
            found.loading = found.loading or kind == "load"
            if kind in ("service", "message") and name is not None:
                found.waits.append((str(kind), name, *place_of(record)))
        case "answered":
            kind, name = record.get("kind"), checked_text(record.get("name"), NAME)
            if kind not in _ANSWERS or name is None or len(found.answers) >= MAX_ANSWERS:
                return False
            (found.fed if kind in _MAYBE else found.answers)[_ANSWERS[kind].format(name)] = None
        case "woven":
            found.woven = True
        case "weave-failed":
            if len(found.failures) < 3:
                found.failures.append(CONTROL.sub("", str(record.get("message")))[:300])
        case _:
            return False
    return True


def take_supervisor_record(record: Mapping[str, Any], found: Gathered) -> bool:
    """What the supervisor and its master say."""
    match record.get("ev"):
        case "m-endpoint":
            role, name = record.get("role"), checked_text(record.get("name"), NAME)
            if role not in _ROLES or name is None or len(found.seen_endpoints) >= MAX_ENDPOINTS:
                return False
            kind = "*" if record.get("type") == ANY_TYPE else checked_text(record.get("type"), _TYPE)
            found.seen_endpoints.append((str(role), name, kind, found.probed))
        case "m-param":
            access, name = record.get("access"), checked_text(record.get("name"), NAME)
            if access not in _ACCESS or name is None or len(found.seen_params) >= MAX_PARAMS:
                return False
            found.seen_params.append((str(access), name))
        case "m-lookup":
            name = checked_text(record.get("name"), NAME)
            if name is None or len(found.lookups) >= MAX_ENDPOINTS:
                return False
            found.lookups.append(name)
        case "started":
            pass
        case "probed":
            found.probed = True
        case "maps":
            _add_files(paths(record.get("paths")), found)
        case "end":
            found.end = record
            if isinstance(record.get("dropped"), int):
                found.dropped += min(max(record["dropped"], 0), 10**9)
        case _:
            return False
    return True


def checked_text(value: object, pattern: re.Pattern[str]) -> str | None:
    """The value if it is a text of that form."""
    return value if isinstance(value, str) and pattern.match(value) else None


def is_number(value: object) -> TypeGuard[int]:
    """Whether it is an integer that others can be told: JSON's and Python's have any size."""
    return isinstance(value, int) and not isinstance(value, bool) and -(2**31) <= value < 2**31


def place_of(record: Mapping[str, Any]) -> tuple[str | None, int | None]:
    """The file and line that a record names, if it names both."""
    file, line = record.get("file"), record.get("line")
    if checked_text(file, _FILE) and is_number(line) and line > 0:
        return file, line
    return None, None


def paths(value: object) -> Iterable[str]:
    """The absolute paths of a list that came out of the sandbox, without what no file can be called."""
    return (path for path in value if _is_path(path)) if isinstance(value, list) else ()


def _is_path(value: object) -> bool:
    if not isinstance(value, str) or not value.startswith("/") or len(value) >= 4096 or "\0" in value:
        return False
    try:
        os.fsencode(value)
    except UnicodeEncodeError:
        return False
    return True


def _take_endpoint(record: Mapping[str, Any], found: Gathered) -> bool:
    role, name = record.get("role"), checked_text(record.get("name"), NAME)
    if role not in _ROLES or name is None or len(found.endpoints) >= MAX_ENDPOINTS:
        return False
    qos = _qos(record.get("qos")) if role in ("publisher", "subscriber") else {}
    file, line = place_of(record)
    passed_on = record.get("type") == ANY_TYPE
    endpoint = Endpoint(
        cast(Role, role),
        name,
        "*" if passed_on else checked_text(record.get("type"), _TYPE),
        "*" if passed_on else checked_text(record.get("md5"), _MD5),
        qos,
        file,
        line,
        builtin=record.get("builtin") is True,
        evidence=SEEN.but(*_doubts(record, found)),
        node=checked_text(record.get("node"), _FULL_NAME),
    )
    # One that it made before as well is sure.
    key = repr(replace(endpoint, evidence=SEEN))
    found.waited = found.waited or (bool(found.fed) and key not in found.endpoints)
    found.endpoints.setdefault(key, (endpoint, checked_text(record.get("resolved"), NAME)))
    return True


def _doubts(record: Mapping[str, Any], found: Gathered) -> Iterator[Unsure]:
    if record.get("speculative") is True:
        yield "made-up answer"
    if found.probed:
        yield "on demand"


def _qos(given: object) -> dict[str, Any]:
    """The policies of a topic's end: those of ROS 1, or those of ROS 2."""
    if not isinstance(given, dict):
        return {}
    qos: dict[str, Any] = {}
    if isinstance(given.get("latch"), bool):
        qos["latch"] = given["latch"]
    if "queue_size" in given and (given["queue_size"] is None or is_number(given["queue_size"])):
        qos["queue_size"] = given["queue_size"]
    for policy, words in _POLICIES.items():
        if given.get(policy) in words:
            qos[policy] = given[policy]
    if is_number(given.get("depth")):
        qos["depth"] = given["depth"]
    for policy in ("deadline", "lease_duration"):
        seconds = given.get(policy)
        if isinstance(seconds, float) and math.isfinite(seconds) and seconds > 0:
            qos[policy] = seconds
    return qos


def _take_param(record: Mapping[str, Any], found: Gathered) -> bool:
    access, name = record.get("access"), checked_text(record.get("name"), NAME)
    if access not in _ACCESS or name is None or len(found.params) >= MAX_PARAMS:
        return False
    file, line = place_of(record)
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
        type=checked_text(record.get("type"), _PARAM_TYPE),
        dynamic=record.get("dynamic") is True,
        read_only=record.get("read_only") is True,
        range=_range(record.get("range")),
        node=checked_text(record.get("node"), _FULL_NAME),
    )
    found.waited = found.waited or (bool(found.fed) and repr(use) not in found.params)
    resolved = checked_text(record.get("resolved"), NAME)
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


def _add_files(paths: Iterable[str], found: Gathered) -> None:
    for path in paths:
        if len(found.files) < MAX_FILES:
            found.files[path] = None


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
