"""Nodes with a life cycle (https://design.ros2.org/articles/node_lifecycle.html)."""

from __future__ import annotations

from typing import Any, NamedTuple

from ..node import Node
from .managed_entity import ManagedEntity, TransitionCallbackReturn
from .publisher import LifecyclePublisher


class LifecycleState(NamedTuple):
    """A state."""

    label: str
    state_id: int


_UNCONFIGURED, _INACTIVE = LifecycleState("unconfigured", 1), LifecycleState("inactive", 2)
_ACTIVE, _FINALIZED = LifecycleState("active", 3), LifecycleState("finalized", 4)
_TRANSITIONS = {
    "configure": ((_UNCONFIGURED,), _INACTIVE),
    "cleanup": ((_INACTIVE,), _UNCONFIGURED),
    "activate": ((_INACTIVE,), _ACTIVE),
    "deactivate": ((_ACTIVE,), _INACTIVE),
    "shutdown": ((_UNCONFIGURED, _INACTIVE, _ACTIVE), _FINALIZED),
}
"""Each with the states that it may begin in, and the one that it ends in."""
_CALLBACKS = tuple(f"on_{name}" for name in (*_TRANSITIONS, "error"))


class LifecycleNodeMixin(ManagedEntity):
    """What makes a node one with a life cycle."""

    def __init__(self, *, enable_communication_interface: bool = True, callback_group: Any = None) -> None:
        if not isinstance(self, Node):
            raise RuntimeError("LifecycleNodeMixin uses Node fields so Node needs to be in the inheritance tree.")
        self._managed_entities: set[Any] = set()
        self._of_transitions = {name: getattr(self, name) for name in _CALLBACKS}
        self._state = _UNCONFIGURED

    def _call(self, name: str, before: LifecycleState) -> Any:
        """rclpy tells nobody what a callback raises."""
        try:
            return self._of_transitions[name](before)
        except Exception:
            return TransitionCallbackReturn.ERROR

    def _trigger(self, transition: str) -> Any:
        before, (begins, ends) = self._state, _TRANSITIONS[transition]
        if before not in begins:
            return TransitionCallbackReturn.ERROR
        result = self._call(f"on_{transition}", before)
        if result == TransitionCallbackReturn.SUCCESS:
            self._state = ends
        elif result == TransitionCallbackReturn.ERROR:
            mended = self._call("on_error", before) == TransitionCallbackReturn.SUCCESS
            self._state = _UNCONFIGURED if mended else _FINALIZED
        return result

    def trigger_configure(self) -> Any:
        return self._trigger("configure")

    def trigger_cleanup(self) -> Any:
        return self._trigger("cleanup")

    def trigger_activate(self) -> Any:
        return self._trigger("activate")

    def trigger_deactivate(self) -> Any:
        return self._trigger("deactivate")

    def trigger_shutdown(self) -> Any:
        return self._trigger("shutdown")

    def add_managed_entity(self, entity: Any) -> None:
        if not isinstance(entity, ManagedEntity):
            raise TypeError("Expected a rclpy.lifecycle.ManagedEntity instance.")
        self._managed_entities.add(entity)

    def _all(self, name: str, state: Any) -> Any:
        for entity in self._managed_entities:
            result = getattr(entity, name)(state)
            if not isinstance(result, TransitionCallbackReturn):
                raise TypeError(f"{name}() return value of class {type(entity)} should be `TransitionCallbackReturn`.")
            if result != TransitionCallbackReturn.SUCCESS:
                return result
        return TransitionCallbackReturn.SUCCESS

    def on_configure(self, state: Any) -> Any:
        return self._all("on_configure", state)

    def on_cleanup(self, state: Any) -> Any:
        return self._all("on_cleanup", state)

    def on_shutdown(self, state: Any) -> Any:
        return self._all("on_shutdown", state)

    def on_activate(self, state: Any) -> Any:
        return self._all("on_activate", state)

    def on_deactivate(self, state: Any) -> Any:
        return self._all("on_deactivate", state)

    def on_error(self, state: Any) -> Any:
        return self._all("on_error", state)

    def create_lifecycle_publisher(
        self, msg_type: Any, topic: str, qos_profile: Any, *, publisher_class: None = None, **kwargs: Any
    ) -> Any:
        if publisher_class:
            raise TypeError("create_publisher() got an unexpected keyword argument 'publisher_class'")
        made = self.create_publisher(  # type: ignore[attr-defined]
            msg_type, topic, qos_profile, publisher_class=LifecyclePublisher, **kwargs
        )
        self._managed_entities.add(made)
        return made

    def destroy_lifecycle_publisher(self, publisher: Any) -> bool:
        self._managed_entities.discard(publisher)
        return bool(self.destroy_publisher(publisher))  # type: ignore[attr-defined]


class LifecycleNode(LifecycleNodeMixin, Node):
    """A node with a life cycle."""

    def __init__(self, node_name: str, *, enable_communication_interface: bool = True, **kwargs: Any) -> None:
        Node.__init__(self, node_name, **kwargs)
        LifecycleNodeMixin.__init__(self, enable_communication_interface=enable_communication_interface)
