"""The lifecycle nodes of rclpy in a process: what they offer to their managers, and what one would ask of them."""

from __future__ import annotations

from typing import Any, Callable

from . import channel
from .rclpy_names import expanded, full_name, given_name
from .weaving import bound_arguments, quiet

TRIGGERS = {"configure": "inactive", "activate": "active", "deactivate": "inactive", "cleanup": "unconfigured"}
"""The transitions between the states that a node works in, with the state that each leads to."""
_OFFERS = (
    ("~/change_state", "ChangeState"),
    ("~/get_state", "GetState"),
    ("~/get_available_states", "GetAvailableStates"),
    ("~/get_available_transitions", "GetAvailableTransitions"),
    ("~/get_transition_graph", "GetAvailableTransitions"),
)
_UNCONFIGURED = "unconfigured"
_ASKED = {_UNCONFIGURED: ("configure", "activate"), "inactive": ("activate",)}
"""What a manager asks of a node in each state."""

not_asked: list[Any] = []
"""The nodes that were not asked yet, be they lifecycle nodes or not."""
_asking: list[Any] = []


@quiet
def _offer(node: Any) -> None:
    for name, kind in _OFFERS:
        channel.send(
            "endpoint",
            role="service",
            name=given_name(node, name),
            resolved=expanded(node, name),
            node=full_name(node),
            type=f"lifecycle_msgs/srv/{kind}",
            qos={},
            builtin=True,
        )


def offers_transitions(original: Callable[..., Any]) -> Callable[..., Any]:
    """A lifecycle node is made: rclpy does not make its services as the node's own are made."""

    def made(*args: Any, **kwargs: Any) -> None:
        original(*args, **kwargs)
        arguments = bound_arguments(original, args, kwargs)
        if arguments.get("enable_communication_interface", True):
            _offer(arguments["self"])

    return made


def triggers(transition: str) -> Callable[..., Any]:
    """A node goes from one state to another."""

    @quiet
    def report(node: Any, result: Any) -> None:
        if getattr(result, "name", "SUCCESS") == "SUCCESS":
            node._preflight_state = TRIGGERS[transition]
        if node not in _asking:
            channel.send("transition", name=transition)

    def advice(original: Callable[..., Any]) -> Callable[..., Any]:
        def triggered(self: Any, *args: Any, **kwargs: Any) -> Any:
            result = original(self, *args, **kwargs)
            report(self, result)
            return result

        return triggered

    return advice


def activate() -> None:
    """Have lifecycle nodes do what a manager would ask of them."""
    waiting, not_asked[:] = list(not_asked), []
    for node in waiting:
        if not (hasattr(node, "trigger_configure") and hasattr(node, "trigger_activate")):
            continue
        _asking.append(node)
        for transition in _ASKED.get(getattr(node, "_preflight_state", _UNCONFIGURED), ()):
            if getattr(getattr(node, f"trigger_{transition}")(), "name", "SUCCESS") != "SUCCESS":
                # What it would have made is not known.
                channel.send("answered", kind="transition", name=transition)
                break
        _asking.remove(node)
