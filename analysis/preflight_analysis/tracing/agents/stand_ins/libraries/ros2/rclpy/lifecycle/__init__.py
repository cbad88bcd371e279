"""Nodes with a life cycle (https://design.ros2.org/articles/node_lifecycle.html)."""

from __future__ import annotations

import enum
from typing import Any, NamedTuple

from ..node import Node
from ..publisher import Publisher


class TransitionCallbackReturn(enum.Enum):
    """How a transition went."""

    SUCCESS = 97
    FAILURE = 98
    ERROR = 99

    def to_label(self) -> str:
        return "transition_" + self.name.lower()


TransitionCallbackReturnType = TransitionCallbackReturn


class LifecycleState(NamedTuple):
    """A state."""

    state_id: int
    label: str


class ManagedEntity:
    """What takes part in transitions."""

    def on_configure(self, state: Any) -> Any:
        return TransitionCallbackReturn.SUCCESS

    def on_cleanup(self, state: Any) -> Any:
        return TransitionCallbackReturn.SUCCESS

    def on_shutdown(self, state: Any) -> Any:
        return TransitionCallbackReturn.SUCCESS

    def on_activate(self, state: Any) -> Any:
        return TransitionCallbackReturn.SUCCESS

    def on_deactivate(self, state: Any) -> Any:
        return TransitionCallbackReturn.SUCCESS

    def on_error(self, state: Any) -> Any:
        return TransitionCallbackReturn.FAILURE


class SimpleManagedEntity(ManagedEntity):
    """One that is on or off."""

    is_activated = False

    def on_activate(self, state: Any) -> Any:
        self.is_activated = True
        return TransitionCallbackReturn.SUCCESS

    def on_deactivate(self, state: Any) -> Any:
        self.is_activated = False
        return TransitionCallbackReturn.SUCCESS


class LifecyclePublisher(SimpleManagedEntity, Publisher):
    """A publisher of such a node."""

    def publish(self, msg: Any) -> None:
        if self.is_activated:
            super().publish(msg)


class LifecycleNodeMixin(ManagedEntity):
    """What makes a node one with a life cycle."""

    def __init__(self, *, enable_communication_interface: bool = True, callback_group: Any = None) -> None:
        self._managed_entities: list[Any] = []
        self._state = LifecycleState(1, "unconfigured")

    def _trigger(self, name: str, after: LifecycleState) -> Any:
        before, self._state = self._state, after
        result = getattr(self, f"on_{name}")(before)
        if result != TransitionCallbackReturn.SUCCESS:
            self._state = before
        return result

    def trigger_configure(self) -> Any:
        return self._trigger("configure", LifecycleState(2, "inactive"))

    def trigger_cleanup(self) -> Any:
        return self._trigger("cleanup", LifecycleState(1, "unconfigured"))

    def trigger_activate(self) -> Any:
        return self._trigger("activate", LifecycleState(3, "active"))

    def trigger_deactivate(self) -> Any:
        return self._trigger("deactivate", LifecycleState(2, "inactive"))

    def trigger_shutdown(self) -> Any:
        return self._trigger("shutdown", LifecycleState(4, "finalized"))

    def add_managed_entity(self, entity: Any) -> None:
        self._managed_entities.append(entity)

    def _all(self, name: str, state: Any) -> Any:
        for entity in self._managed_entities:
            result = getattr(entity, name)(state)
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

    def create_lifecycle_publisher(self, *args: Any, **kwargs: Any) -> Any:
        publisher = self.create_publisher(*args, publisher_class=LifecyclePublisher, **kwargs)  # type: ignore[attr-defined]
        self._managed_entities.append(publisher)
        return publisher

    def destroy_lifecycle_publisher(self, publisher: Any) -> bool:
        self._managed_entities.remove(publisher)
        return bool(self.destroy_publisher(publisher))  # type: ignore[attr-defined]


class LifecycleNode(LifecycleNodeMixin, Node):
    """A node with a life cycle."""

    def __init__(self, node_name: str, *, enable_communication_interface: bool = True, **kwargs: Any) -> None:
        Node.__init__(self, node_name, **kwargs)
        LifecycleNodeMixin.__init__(self, enable_communication_interface=enable_communication_interface)


LifecycleMixin = LifecycleNodeMixin
State = LifecycleState
NodeMixin = LifecycleNodeMixin
