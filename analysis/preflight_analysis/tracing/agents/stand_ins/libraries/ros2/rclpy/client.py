"""Clients of services: nobody answers."""

from __future__ import annotations

import time
from typing import Any

from .task import Future


class Client:
    """The other end of a service."""

    def __init__(self, context: Any, srv_type: Any, srv_name: str, qos_profile: Any, full_name: str) -> None:
        self.context, self.srv_type, self.srv_name, self.qos_profile = context, srv_type, srv_name, qos_profile
        self.service_name = full_name

    def call(self, request: Any, timeout_sec: Any = None) -> Any:
        if not isinstance(request, self.srv_type.Request):
            raise TypeError()
        end = None if timeout_sec is None else time.monotonic() + timeout_sec
        while self.context.ok() and (end is None or time.monotonic() < end):
            time.sleep(0.05)
        return None

    def call_async(self, request: Any) -> Future:
        if not isinstance(request, self.srv_type.Request):
            raise TypeError()
        return Future()

    def remove_pending_request(self, future: Any) -> None:
        pass

    def service_is_ready(self) -> bool:
        return False

    def wait_for_service(self, timeout_sec: Any = None) -> bool:
        end = None if timeout_sec is None else time.monotonic() + timeout_sec
        while self.context.ok() and not self.service_is_ready() and (end is None or time.monotonic() < end):
            time.sleep(0.05)
        return bool(self.service_is_ready())

    def configure_introspection(self, *args: Any) -> None:
        pass

    def destroy(self) -> None:
        pass
