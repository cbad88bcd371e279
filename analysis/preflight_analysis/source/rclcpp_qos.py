"""The QoS that a C++ node of ROS 2 asks for, as far as its text tells."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import field
from typing import Any

from preflight_analysis.dataclass import dataclass
from preflight_analysis.source.cpp_values import Constant, Fluent

_RELIABLE = {"reliability": "reliable", "durability": "volatile"}
_PROFILES: Mapping[str, Mapping[str, Any]] = {
    "rclcpp::SensorDataQoS": {"reliability": "best_effort", "durability": "volatile", "depth": 5},
    "rclcpp::SystemDefaultsQoS": {},
    "rclcpp::BestAvailableQoS": {},
    "rclcpp::ServicesQoS": {**_RELIABLE, "depth": 10},
    "rclcpp::ParametersQoS": {**_RELIABLE, "depth": 1000},
    "rclcpp::ParameterEventsQoS": {**_RELIABLE, "depth": 1000},
    "rclcpp::RosoutQoS": {"reliability": "reliable", "durability": "transient_local", "depth": 1000},
    "rclcpp::ClockQoS": {"reliability": "best_effort", "durability": "volatile", "depth": 1},
    "rmw_qos_profile_sensor_data": {"reliability": "best_effort", "durability": "volatile", "depth": 5},
    "rmw_qos_profile_default": {**_RELIABLE, "depth": 10},
    "rmw_qos_profile_services_default": {**_RELIABLE, "depth": 10},
    "rmw_qos_profile_parameters": {**_RELIABLE, "depth": 1000},
    "rmw_qos_profile_system_default": {},
}
_ORDER = ("reliability", "durability", "liveliness")
_WORDS = {
    "BestEffort": "best_effort",
    "Reliable": "reliable",
    "TransientLocal": "transient_local",
    "Volatile": "volatile",
    "Automatic": "automatic",
    "ManualByTopic": "manual_by_topic",
}
_METHODS = {
    "best_effort": ("reliability", "best_effort"),
    "reliable": ("reliability", "reliable"),
    "transient_local": ("durability", "transient_local"),
    "durability_volatile": ("durability", "volatile"),
    "reliability_best_available": ("reliability", None),
    "durability_best_available": ("durability", None),
}
_SETTING = frozenset({"reliability", "durability", "liveliness"})


@dataclass(frozen=True, slots=True)
class Qos(Fluent):
    """A profile by the policies of it that are known."""

    policies: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Depth:
    """`rclcpp::KeepLast(n)`, None where it is not known or all are kept."""

    size: int | None


def named(name: str) -> Any:
    """What a name of rclcpp or rmw stands for, None if it is neither a profile nor a policy."""
    leaf = name.rpartition("::")[2]
    if leaf in _PROFILES:
        return Qos(_PROFILES[leaf])
    if leaf.startswith("RMW_QOS_POLICY_"):
        for policy in _ORDER:
            prefix = f"RMW_QOS_POLICY_{policy.upper()}_"
            if leaf.startswith(prefix):
                return Constant(leaf.removeprefix(prefix).lower())
    return Constant(_WORDS[leaf]) if leaf in _WORDS and "Policy" in name else None


def make(name: str, given: Sequence[Any]) -> Any:
    """An object of a class of profiles, None if `name` is none."""
    first = given[0] if given else None
    match name:
        case "rclcpp::QoS":
            return _profile(given)
        case "rclcpp::KeepLast":
            return Depth(first if _is_size(first) else None)
        case "rclcpp::KeepAll":
            return Depth(None)
        case "rclcpp::QoSInitialization::from_rmw":
            return first if isinstance(first, Qos) else Qos()
    if name not in _PROFILES:
        return None
    profile = dict(_PROFILES[name])
    if isinstance(first, Depth) and first.size is not None:
        profile["depth"] = first.size
    return Qos(profile)


def changed(qos: Qos, name: str, given: Sequence[Any]) -> Any:
    """The profile after a call of one of its methods; what it has, in another form, for those that only ask."""
    policies = dict(qos.policies)
    first = given[0] if given else None
    if name in _METHODS:
        policy, value = _METHODS[name]
        return _with(policies, policy, value)
    if name in _SETTING and given:
        return _with(policies, name, first.name if isinstance(first, Constant) else None)
    if name == "keep_last":
        return _with(policies, "depth", first if _is_size(first) else None)
    return qos


def of(value: Any) -> Mapping[str, Any]:
    """The policies of what is given as the QoS of an end: a profile, or the depth alone."""
    if isinstance(value, Qos):
        return value.policies
    if _is_size(value):
        return {**_RELIABLE, "depth": value}
    if isinstance(value, Depth):
        return {**_RELIABLE, "depth": value.size} if value.size is not None else _RELIABLE
    return {}


def _profile(given: Sequence[Any]) -> Qos:
    known = next((value for value in given if isinstance(value, Qos)), None)
    policies = dict(known.policies if known is not None else _RELIABLE)
    first = given[0] if given else None
    if isinstance(first, list) and first:
        first = first[0]
    if len(given) > 1 and known is None:
        return Qos()
    if _is_size(first):
        policies["depth"] = first
    elif isinstance(first, Depth) and first.size is not None:
        policies["depth"] = first.size
    return Qos(policies)


def _with(policies: dict[str, Any], policy: str, value: Any) -> Qos:
    policies.pop(policy, None)
    return Qos(policies | {policy: value} if value is not None else policies)


def _is_size(value: Any) -> bool:
    return isinstance(value, int) and not isinstance(value, bool)
