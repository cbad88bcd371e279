"""Where packages are (http://docs.ros.org/en/independent/api/rospkg/html/): the host knows."""

from __future__ import annotations

import json
import os
from typing import Any


class ResourceNotFound(Exception):
    """There is no such package."""


def packages() -> dict[str, str]:
    """Folders by name."""
    with open(os.environ["PREFLIGHT_STAND_INS"], encoding="utf-8") as file:
        return dict(json.load(file)["packages"])


class RosPack:
    """All packages."""

    def __init__(self, ros_paths: Any = None) -> None:
        self._packages = packages()

    def list(self) -> Any:
        return list(self._packages)

    def get_path(self, name: str) -> str:
        """The folder. Raises `ResourceNotFound`."""
        if name not in self._packages:
            raise ResourceNotFound(name)
        return self._packages[name]

    def get_depends(self, name: str, implicit: bool = True) -> Any:
        return []


RosStack = RosPack


def get_ros_home(env: Any = None) -> str:
    return os.environ.get("ROS_HOME", os.path.expanduser("~/.ros"))


def get_log_dir(env: Any = None) -> str:
    return os.environ.get("ROS_LOG_DIR", os.path.join(get_ros_home(), "log"))
