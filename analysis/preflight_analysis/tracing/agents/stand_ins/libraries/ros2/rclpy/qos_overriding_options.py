"""Quality of service by parameters (https://docs.ros.org/en/jazzy/p/rclpy/)."""

from __future__ import annotations

import importlib
from typing import Any

from . import qos as policies
from .duration import Duration
from .exceptions import ParameterAlreadyDeclaredException
from .qos import QoSPolicyKind


class InvalidQosOverridesError(Exception):
    """A callback refuses them."""


class QoSOverridingOptions:
    """Which policies are parameters."""

    def __init__(self, policy_kinds: Any, *, callback: Any = None, entity_id: Any = None) -> None:
        self.policy_kinds, self.callback, self.entity_id = policy_kinds, callback, entity_id

    @classmethod
    def with_default_policies(cls, *, callback: Any = None, entity_id: Any = None) -> Any:
        kinds = (QoSPolicyKind.HISTORY, QoSPolicyKind.DEPTH, QoSPolicyKind.RELIABILITY)
        return cls(kinds, callback=callback, entity_id=entity_id)


def declare(kind: str, node: Any, topic: str, profile: Any, options: QoSOverridingOptions) -> None:
    """Declare the parameters of an end and apply them to its profile."""
    suffix = "" if options.entity_id is None else f"_{options.entity_id}"
    for policy in options.policy_kinds:
        word = policy.name.lower()
        if kind == "subscription" and policy == QoSPolicyKind.LIFESPAN:
            continue
        value = getattr(profile, word)
        plain = value.nanoseconds if isinstance(value, Duration) else getattr(value, "name", value)
        plain = plain.lower() if isinstance(plain, str) else plain
        descriptor = importlib.import_module("rcl_interfaces.msg").ParameterDescriptor(read_only=True)
        name = f"qos_overrides.{topic}.{kind}{suffix}.{word}"
        try:
            given = node.declare_parameter(name, plain, descriptor).value
        except ParameterAlreadyDeclaredException:
            given = node.get_parameter(name).value
        if isinstance(value, Duration):
            given = Duration(nanoseconds=given)
        elif isinstance(given, str):
            given = getattr(policies, f"{word.capitalize()}Policy")[given.upper()]
        setattr(profile, word, given)
    if options.callback is not None:
        result = options.callback(profile)
        if not result.successful:
            raise InvalidQosOverridesError(f"Provided QoS overrides, are not valid: {result.reason}")
