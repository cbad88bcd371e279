"""The endpoints that a node of rclpy makes: each is sent with the name that the node gave it."""

from __future__ import annotations

from typing import Any, Callable, Optional

from . import channel, mock_replies
from .rclpy_names import caller, expanded, full_name, given_name
from .weaving import bound_arguments, quiet

_FOREVER = 9_000_000_000
"""Seconds: the "infinite" durations of rmw are longer."""


def interface_type(described: Any) -> Optional[str]:
    """`pkg/msg/Name` of a class that the generators of rosidl made."""
    package, _, rest = str(getattr(described, "__module__", "")).partition(".")
    kind = rest.partition(".")[0]
    return f"{package}/{kind}/{described.__name__}" if kind in ("msg", "srv", "action") else None


def _qos(profile: Any) -> dict[str, Any]:
    """The policies that are settled; what is left to the middleware is left out."""
    found: dict[str, Any] = {}
    for policy, allowed in (
        ("reliability", ("reliable", "best_effort")),
        ("durability", ("volatile", "transient_local")),
        ("liveliness", ("automatic", "manual_by_topic")),
    ):
        word = str(getattr(getattr(profile, policy, None), "name", "")).lower()
        if word in allowed:
            found[policy] = word
    depth = getattr(profile, "depth", None)
    if isinstance(depth, int) and depth > 0:
        found["depth"] = depth
    for policy, name in (("deadline", "deadline"), ("liveliness_lease_duration", "lease_duration")):
        nanoseconds = getattr(getattr(profile, policy, None), "nanoseconds", 0)
        if isinstance(nanoseconds, int) and 0 < nanoseconds < _FOREVER * 1_000_000_000:
            found[name] = nanoseconds / 1e9
    return found


@quiet
def _report_endpoint(node: Any, role: str, name: Any, described: Any, profile: Any = None) -> None:
    file, line, internal = caller()
    channel.send(
        "endpoint",
        role=role,
        name=given_name(node, str(name)),
        resolved=expanded(node, str(name)),
        node=full_name(node),
        type=interface_type(described),
        qos=_qos(profile) if profile is not None else {},
        file=file,
        line=line,
        builtin=internal,
        speculative=mock_replies.speculative(),
    )


def creates(role: str, type_name: str, name: str, profiled: bool) -> Callable[..., Any]:
    """A method of the node that makes an endpoint."""

    def advice(original: Callable[..., Any]) -> Callable[..., Any]:
        def made(*args: Any, **kwargs: Any) -> Any:
            result = original(*args, **kwargs)
            arguments = bound_arguments(original, args, kwargs)
            profile = getattr(result, "qos_profile", None) if profiled else None
            _report_endpoint(arguments["self"], role, arguments.get(name), arguments.get(type_name), profile)
            return result

        return made

    return advice


def makes_action(role: str) -> Callable[..., Any]:
    """The constructor of an end of an action."""

    def advice(original: Callable[..., Any]) -> Callable[..., Any]:
        def made(*args: Any, **kwargs: Any) -> None:
            original(*args, **kwargs)
            arguments = bound_arguments(original, args, kwargs)
            name = arguments.get("action_name")
            _report_endpoint(arguments.get("node"), role, name, arguments.get("action_type"))
            if role == "action_client":
                arguments["self"]._preflight_name = name

        return made

    return advice
