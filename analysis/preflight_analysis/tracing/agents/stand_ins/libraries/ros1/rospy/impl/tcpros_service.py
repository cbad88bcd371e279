"""Services and their clients (http://wiki.ros.org/rospy/Overview/Services)."""

from __future__ import annotations

import time
from typing import Any

from .. import core, msproxy, names, rostime
from ..exceptions import ROSException, ROSInterruptException
from ..service import ServiceException
from ..topics import tell_master


def _is_there(service: str) -> bool:
    return bool(msproxy.call("lookupService", service)[0] == 1)


def wait_for_service(service: str, timeout: Any = None) -> None:
    """Wait until somebody offers it. Raises `ROSException` when the time is over."""
    full = names.resolve_name(service)
    seconds = timeout.to_sec() if hasattr(timeout, "to_sec") else timeout
    end = None if seconds is None else time.time() + seconds
    while not core.is_shutdown():
        if _is_there(full):
            return
        if end is not None and time.time() >= end:
            raise ROSException(f"timeout exceeded while waiting for service {full}")
        rostime.wallsleep(0.3 if end is None else max(0.0, min(0.3, end - time.time())))
    raise ROSInterruptException("rospy shutdown")


class _Service:
    def __init__(self, name: Any, service_class: Any) -> None:
        if not name or not isinstance(name, str):
            raise ValueError("service name is not a non-empty string")
        resolve = names.resolve_name if core.is_initialized() else names.resolve_name_without_node_name
        self.resolved_name = resolve(name)
        self.service_class = service_class
        self.request_class = service_class._request_class
        self.response_class = service_class._response_class


class Service(_Service):
    """One end of a service."""

    def __init__(
        self, name: str, service_class: Any, handler: Any, buff_size: int = 65536, error_handler: Any = None
    ) -> None:
        super().__init__(name, service_class)
        self.handler = handler
        tell_master("Service", self.resolved_name)

    def shutdown(self, reason: str = "") -> None:
        """It is not offered any more."""
        msproxy.unregister("Service", self.resolved_name)

    def spin(self) -> None:
        try:
            while not core.is_shutdown():
                rostime.wallsleep(0.5)
        except KeyboardInterrupt:
            core.signal_shutdown("keyboard interrupt")


class ServiceProxy(_Service):
    """The other end: nobody answers."""

    def __init__(self, name: str, service_class: Any, persistent: bool = False, headers: Any = None) -> None:
        super().__init__(name, service_class)

    def wait_for_service(self, timeout: Any = None) -> None:
        wait_for_service(self.resolved_name, timeout=timeout)

    def __call__(self, *args: Any, **kwds: Any) -> Any:
        return self.call(*args, **kwds)

    def call(self, *args: Any, **kwds: Any) -> Any:
        """Call it. Raises `ServiceException`."""
        if _is_there(self.resolved_name):
            return self.response_class()
        raise ServiceException(f"service [{self.resolved_name}] unavailable")

    def close(self) -> None:
        pass
