"""Services: nobody calls them."""

from __future__ import annotations

from typing import Any


class Service:
    """One end of a service."""

    def __init__(self, srv_type: Any, srv_name: str, callback: Any, qos_profile: Any, full_name: str) -> None:
        self.srv_type, self.srv_name, self.callback, self.qos_profile = srv_type, srv_name, callback, qos_profile
        self.service_name = full_name

    def configure_introspection(self, *args: Any) -> None:
        pass

    def destroy(self) -> None:
        pass
