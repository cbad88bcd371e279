"""The side of others: two topics and a service of the node that is changed."""

from __future__ import annotations

import importlib
from typing import Any

import rospy  # type: ignore[import-not-found]


class Client:
    """Makes changes."""

    def __init__(
        self, name: str, timeout: Any = None, config_callback: Any = None, description_callback: Any = None
    ) -> None:
        messages = importlib.import_module("dynamic_reconfigure.msg")
        self.name = name
        service = rospy.resolve_name(name) + "/set_parameters"
        rospy.wait_for_service(service, timeout)
        kind = importlib.import_module("dynamic_reconfigure.srv").Reconfigure
        self._set_service = rospy.ServiceProxy(service, kind)
        base = rospy.resolve_name(name)
        self._descriptions = rospy.Subscriber(
            base + "/parameter_descriptions", messages.ConfigDescription, callback=self._ignore
        )
        self._updates = rospy.Subscriber(base + "/parameter_updates", messages.Config, callback=self._ignore)

    def _ignore(self, message: Any) -> None:
        pass

    def get_configuration(self, timeout: Any = None) -> Any:
        return {}

    def update_configuration(self, changes: Any) -> Any:
        return changes

    def close(self) -> None:
        pass
