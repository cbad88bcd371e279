"""Actions: each end is several topics and services below one name, whatever the client library that made them.

In ROS 1 (http://wiki.ros.org/actionlib/DetailedDescription) these are five topics: clients publish `goal` and
`cancel`, servers `status`, `feedback` and `result`. The type of an action is that of its definition,
`pkg/FetchAction`; its topics have types of their own, `pkg/FetchActionGoal` and so on.

In ROS 2 (https://design.ros2.org/articles/actions.html) they are three services and two topics of hidden names:
servers offer `_action/send_goal`, `_action/cancel_goal` and `_action/get_result`, and publish `_action/feedback` and
`_action/status`. The type is `pkg/action/Fetch`, that of its first service `pkg/action/Fetch_SendGoal`.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Mapping
from dataclasses import replace

from preflight_analysis.dataclass import dataclass
from preflight_analysis.generation import ros
from preflight_analysis.tracing.interface import Endpoint, Role, together

_FROM_CLIENT = ("goal", "cancel")
TOPICS = ("goal", "cancel", "status", "feedback", "result")
"""Of an action in ROS 1."""
_COMMON = {"cancel": "actionlib_msgs/GoalID", "status": "actionlib_msgs/GoalStatusArray"}
_OWN = {"goal": "Goal", "feedback": "Feedback", "result": "Result"}

SERVICES_ROS2 = ("_action/send_goal", "_action/cancel_goal", "_action/get_result")
TOPICS_ROS2 = ("_action/feedback", "_action/status")
_PARTS_ROS2 = (*SERVICES_ROS2, *TOPICS_ROS2)
_COMMON_ROS2 = {
    "_action/cancel_goal": "action_msgs/srv/CancelGoal",
    "_action/status": "action_msgs/msg/GoalStatusArray",
}
_OWN_ROS2 = {
    "_action/send_goal": "_SendGoal",
    "_action/get_result": "_GetResult",
    "_action/feedback": "_FeedbackMessage",
}
_PARTS_OF_CLIENT: Mapping[str, Role] = {
    **dict.fromkeys(SERVICES_ROS2, "client"),
    **dict.fromkeys(TOPICS_ROS2, "subscriber"),
}
_PARTS_OF_SERVER: Mapping[str, Role] = {
    **dict.fromkeys(SERVICES_ROS2, "service"),
    **dict.fromkeys(TOPICS_ROS2, "publisher"),
}


_WITHOUT_ACTION_REMAPS = frozenset({"foxy", "galactic", "humble", "iron", "jazzy"})


def moves_actions(distro: str | None) -> bool:
    """Whether a remap of an action's own name moves the action. Both client libraries of ROS 1 look the name up, and so
    does rcl_action since Kilted (https://github.com/ros2/rcl/pull/1170); before, only its parts could be remapped."""
    return distro not in _WITHOUT_ACTION_REMAPS


@dataclass(frozen=True, slots=True)
class ActionEndpoint:
    """A client or server of an action, and the ends of topics and services that it is made of. `names` are theirs
    below the name of the action, in the same order; the first one is that of the goals."""

    endpoint: Endpoint
    parts: tuple[Endpoint, ...]
    names: tuple[str, ...]


def actions_of(endpoints: Iterable[Endpoint], generation: int = 1) -> tuple[ActionEndpoint, ...]:
    """The actions among the endpoints of a node: those that all their parts show, and those that are declared.

    A declared one whose type says that it is ROS 2's is, whatever the `generation`.
    """
    endpoints = tuple(endpoints)
    by_name: dict[tuple[str, str], Endpoint] = {}
    for endpoint in endpoints:
        by_name.setdefault((endpoint.role, endpoint.name), endpoint)
    found: dict[tuple[str, str], ActionEndpoint] = {}
    for endpoint in by_name.values():
        name, slash, last = endpoint.name.rpartition("/")
        if last == "goal" and slash and name and endpoint.role in ("publisher", "subscriber"):
            role: Role = "action_client" if endpoint.role == "publisher" else "action_server"
            seen = [by_name.get((_topic_role(role, topic), f"{name}/{topic}")) for topic in TOPICS]
            action = _recognised(role, name, [topic for topic in seen if topic is not None])
            if action is not None:
                found[role, name] = action
    for endpoint in endpoints:
        if endpoint.role in ("action_client", "action_server"):
            of_ros2 = ros(generation).native_actions or "/action/" in (endpoint.type or "")
            found.setdefault(
                (endpoint.role, endpoint.name), _declared_ros2(endpoint) if of_ros2 else _declared(endpoint)
            )
    return tuple(found.values())


def topic_endpoints(role: Role, name: str) -> tuple[tuple[Role, str], ...]:
    """The ends of the five topics of an action's client or server: roles and names."""
    return tuple((_topic_role(role, topic), f"{name}/{topic}") for topic in TOPICS)


def _topic_role(role: Role, topic: str) -> Role:
    return "publisher" if (topic in _FROM_CLIENT) == (role == "action_client") else "subscriber"


def _recognised(role: Role, name: str, topics: list[Endpoint]) -> ActionEndpoint | None:
    if len(topics) != len(TOPICS):
        return None
    type_ = (topics[0].type or "").removesuffix("Goal")
    if not type_.endswith("Action") or [topic.type for topic in topics] != [_type(type_, topic) for topic in TOPICS]:
        return None
    goal = topics[0]
    endpoint = Endpoint(
        role,
        name,
        type_,
        _md5(topics),
        source_file=goal.source_file,
        source_line=goal.source_line,
        evidence=together(topic.evidence for topic in topics),
    )
    return ActionEndpoint(endpoint, tuple(topics), TOPICS)


def _declared(endpoint: Endpoint) -> ActionEndpoint:
    type_ = endpoint.type if endpoint.type != "*" else None
    if type_ is not None and not type_.endswith("Action"):
        type_ += "Action"  # `pkg/Fetch`, the name of the file, is meant for the same
        endpoint = replace(endpoint, type=type_)
    parts = tuple(
        _part(
            endpoint,
            _topic_role(endpoint.role, topic),
            topic,
            _COMMON.get(topic) if type_ is None else _type(type_, topic),
        )
        for topic in TOPICS
    )
    return ActionEndpoint(endpoint, parts, TOPICS)


def _declared_ros2(endpoint: Endpoint) -> ActionEndpoint:
    type_ = endpoint.type if endpoint.type != "*" else None
    if type_ is not None and "/action/" not in type_:
        type_ = "/action/".join(type_.split("/", 1))  # `pkg/Fetch` is meant for the same
        endpoint = replace(endpoint, type=type_)
    roles = _PARTS_OF_CLIENT if endpoint.role == "action_client" else _PARTS_OF_SERVER
    parts = tuple(
        _part(endpoint, roles[name], name, _COMMON_ROS2.get(name) or (type_ + _OWN_ROS2[name] if type_ else None))
        for name in _PARTS_ROS2
    )
    return ActionEndpoint(endpoint, parts, _PARTS_ROS2)


def _part(endpoint: Endpoint, role: Role, name: str, type_: str | None) -> Endpoint:
    return Endpoint(
        role,
        f"{endpoint.name}/{name}",
        type_,
        evidence=endpoint.evidence,
    )


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
