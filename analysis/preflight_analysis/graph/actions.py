"""Actions: each end is five topics below one name, whatever the client library that made them.

See http://wiki.ros.org/actionlib/DetailedDescription: clients publish `goal` and `cancel`, servers `status`, `feedback`
and `result`. The type of an action is that of its definition, `pkg/FetchAction`; its topics have types of their own,
`pkg/FetchActionGoal` and so on.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterable
from dataclasses import dataclass, replace

from preflight_analysis.tracing.interface import Endpoint, Role

_FROM_CLIENT = ("goal", "cancel")
TOPICS = ("goal", "cancel", "status", "feedback", "result")
_COMMON = {"cancel": "actionlib_msgs/GoalID", "status": "actionlib_msgs/GoalStatusArray"}
_OWN = {"goal": "Goal", "feedback": "Feedback", "result": "Result"}


@dataclass(frozen=True, slots=True)
class ActionEnd:
    """A client or server of an action and its topics, in the order of `TOPICS`."""

    endpoint: Endpoint
    topics: tuple[Endpoint, ...]


def actions_of(endpoints: Iterable[Endpoint]) -> tuple[ActionEnd, ...]:
    """The actions among the endpoints of a node: those that all five topics show, and those that are declared."""
    endpoints = tuple(endpoints)
    by_name: dict[tuple[str, str], Endpoint] = {}
    for endpoint in endpoints:
        by_name.setdefault((endpoint.role, endpoint.name), endpoint)
    found: dict[tuple[str, str], ActionEnd] = {}
    for endpoint in by_name.values():
        name, slash, last = endpoint.name.rpartition("/")
        if last == "goal" and slash and name and endpoint.role in ("publisher", "subscriber"):
            role: Role = "action_client" if endpoint.role == "publisher" else "action_server"
            seen = [by_name.get((_side(role, topic), f"{name}/{topic}")) for topic in TOPICS]
            end = _recognised(role, name, [topic for topic in seen if topic is not None])
            if end is not None:
                found[role, name] = end
    for endpoint in endpoints:
        if endpoint.role in ("action_client", "action_server"):
            found.setdefault((endpoint.role, endpoint.name), _declared(endpoint))
    return tuple(found.values())


def _side(role: Role, topic: str) -> Role:
    return "publisher" if (topic in _FROM_CLIENT) == (role == "action_client") else "subscriber"


def _recognised(role: Role, name: str, topics: list[Endpoint]) -> ActionEnd | None:
    if len(topics) != len(TOPICS):
        return None
    type_ = (topics[0].type or "").removesuffix("Goal")
    if not type_.endswith("Action") or [topic.type for topic in topics] != [_type(type_, topic) for topic in TOPICS]:
        return None
    goal, speculative = topics[0], any(topic.speculative for topic in topics)
    endpoint = Endpoint(
        role,
        name,
        type_,
        _md5(topics),
        source_file=goal.source_file,
        source_line=goal.source_line,
        speculative=speculative,
        inferred=any(topic.inferred for topic in topics),
        similar=any(topic.similar for topic in topics),
    )
    return ActionEnd(endpoint, tuple(topics))


def _declared(endpoint: Endpoint) -> ActionEnd:
    type_ = endpoint.type if endpoint.type != "*" else None
    if type_ is not None and not type_.endswith("Action") and "/action/" not in type_:
        type_ += "Action"  # `pkg/Fetch`, the name of the file, is meant for the same; ROS 2 has `pkg/action/Fetch`
        endpoint = replace(endpoint, type=type_)
    topics = tuple(
        Endpoint(
            _side(endpoint.role, topic),
            f"{endpoint.name}/{topic}",
            _COMMON.get(topic) if type_ is None else _type(type_, topic),
            speculative=endpoint.speculative,
            inferred=endpoint.inferred,
            similar=endpoint.similar,
        )
        for topic in TOPICS
    )
    return ActionEnd(endpoint, topics)


def _type(action: str, topic: str) -> str:
    return _COMMON.get(topic) or action + _OWN[topic]


def _md5(topics: list[Endpoint]) -> str | None:
    """The MD5 sum of the action's own message, made of those of its three parts as genmsg does."""
    sums = {name: topic.md5 for name, topic in zip(TOPICS, topics, strict=True)}
    parts = [sums["goal"], sums["result"], sums["feedback"]]
    if not all(part and part != "*" for part in parts):
        return None
    text = "\n".join(f"{s} action_{n}" for s, n in zip(parts, ("goal", "result", "feedback"), strict=True))
    return hashlib.md5(text.encode(), usedforsecurity=False).hexdigest()
