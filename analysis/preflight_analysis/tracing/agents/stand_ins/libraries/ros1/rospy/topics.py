"""Publishers and subscribers (http://wiki.ros.org/rospy/Overview/Publishers%20and%20Subscribers)."""

from __future__ import annotations

import importlib
from typing import Any

import genpy  # type: ignore[import-not-found]

from . import core, msproxy, names
from .exceptions import ROSException

Message = genpy.Message
DEFAULT_BUFF_SIZE = 65536
_impls: dict[tuple[str, str], Any] = {}
_early: list[tuple[str, str, str]] = []
"""What was made before the node had a name."""


def tell_master(role: str = "", name: str = "", kind: str = "") -> None:
    """Register an end, once the node has its name."""
    if role:
        _early.append((role, name, kind))
    if names.get_name() != names.get_namespace() + "unnamed":
        waiting, _early[:] = list(_early), []
        for each in waiting:
            msproxy.register(*each)


class _Impl:
    """What all publishers, or subscribers, of a topic in the process have in common."""

    def __init__(self, role: str, name: str, data_class: Any) -> None:
        self.role, self.resolved_name, self.name, self.data_class = role, name, name, data_class
        self.type = data_class._type
        self.callbacks: list[Any] = []
        self.users = 0
        tell_master(role, name, self.type)
        if role == "Subscriber":
            # The real one asks at each topic whether it is to count messages.
            importlib.import_module("rospy").get_param("/enable_statistics", False)

    def get_num_connections(self) -> int:
        return 0

    def has_connections(self) -> bool:
        return False


class Topic:
    """What both ends have."""

    _role = ""

    def __init__(self, name: Any, data_class: Any, reg_type: Any = None) -> None:
        described = data_class
        if not name or not isinstance(name, str):
            raise ValueError("topic name is not a non-empty string")
        if data_class is None:
            raise ValueError("topic parameter 'data_class' is not initialized")
        if not isinstance(data_class, type):
            raise ValueError(f"data_class [{data_class}] is not a class")
        if not issubclass(data_class, genpy.Message):
            raise ValueError(f"data_class [{type(data_class).__name__}] is not a message data class")
        resolve = names.resolve_name if core.is_initialized() else names.resolve_name_without_node_name
        self.name = self.resolved_name = resolve(name)
        self.data_class = data_class
        self.type, self.md5sum = described._type, described._md5sum
        self.reg_type = reg_type
        key = (self._role, self.resolved_name)
        self.impl: Any = _impls.get(key) or _Impl(self._role, self.resolved_name, data_class)
        _impls[key] = self.impl
        self.impl.users += 1

    def get_num_connections(self) -> int:
        return 0

    def unregister(self) -> None:
        """It is not used any more."""
        impl, self.impl = self.impl, None
        if impl is None:
            return
        impl.users -= 1
        if not impl.users and _impls.pop((self._role, impl.resolved_name), None):
            impl.callbacks.clear()
            msproxy.unregister(self._role, impl.resolved_name)


class SubscribeListener:
    """Told of a publisher's subscribers."""

    def peer_subscribe(self, topic_name: str, topic_publish: Any, peer_publish: Any) -> None:
        pass

    def peer_unsubscribe(self, topic_name: str, num_peers: int) -> None:
        pass


class Subscriber(Topic):
    """One end of a topic."""

    _role = "Subscriber"

    def __init__(
        self,
        name: str,
        data_class: Any,
        callback: Any = None,
        callback_args: Any = None,
        queue_size: Any = None,
        buff_size: int = DEFAULT_BUFF_SIZE,
        tcp_nodelay: bool = False,
    ) -> None:
        super().__init__(name, data_class)
        self.callback, self.callback_args = callback, callback_args
        if callback is not None:
            self.impl.callbacks.append((callback, callback_args))

    def unregister(self) -> None:
        pair = (self.callback, self.callback_args)
        if self.impl is not None and pair in self.impl.callbacks:
            self.impl.callbacks.remove(pair)
        super().unregister()


class Publisher(Topic):
    """The other end."""

    _role = "Publisher"

    def __init__(
        self,
        name: str,
        data_class: Any,
        subscriber_listener: Any = None,
        tcp_nodelay: bool = False,
        latch: bool = False,
        headers: Any = None,
        queue_size: Any = None,
    ) -> None:
        super().__init__(name, data_class)

    def publish(self, *args: Any, **kwds: Any) -> None:
        """Nobody is there to hear it."""
        if self.impl is None:
            raise ROSException("publish() to an unregistered() handle")
        if not core.is_initialized():
            raise ROSException("ROS node has not been initialized yet. Please call init_node() first")
