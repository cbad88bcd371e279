"""The node's side: two topics and a service. Which parameters there are, only the generated module knows."""

from __future__ import annotations

import importlib
from typing import Any

import rospy  # type: ignore[import-not-found]


class _Config(dict):  # type: ignore[type-arg]
    """Values that are not known."""

    def __missing__(self, key: str) -> Any:
        return importlib.import_module("preflight_agents.anything").Anything(f"config.{key}")

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        return self[name]


class Server:
    """Takes changes."""

    def __init__(self, type: Any, callback: Any, namespace: str = "") -> None:
        messages = importlib.import_module("dynamic_reconfigure.msg")
        space = namespace + "/" if namespace and not namespace.endswith("/") else namespace
        prefix = "~" + space
        described = getattr(type, "defaults", None)
        self.type, self.callback, self.ns = type, callback, namespace
        self.config: Any = _Config()
        if isinstance(described, dict):
            self.config.update((name, rospy.get_param(prefix + name, value)) for name, value in described.items())
        else:
            rospy.get_param_names()  # any of its own
        self.descr_topic = rospy.Publisher(
            prefix + "parameter_descriptions", messages.ConfigDescription, latch=True, queue_size=10
        )
        self.update_topic = rospy.Publisher(prefix + "parameter_updates", messages.Config, latch=True, queue_size=10)
        self.config = callback(self.config, 0xFFFFFFFF) or self.config
        service = importlib.import_module("dynamic_reconfigure.srv").Reconfigure
        self.set_service = rospy.Service(prefix + "set_parameters", service, lambda request: None)

    def update_configuration(self, changes: Any) -> Any:
        self.config.update(changes)
        return self.config
