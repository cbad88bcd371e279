"""What came before catkin (http://wiki.ros.org/roslib): it does nothing any more."""

from __future__ import annotations

from typing import Any


def load_manifest(package_name: str) -> None:
    pass


def is_interactive() -> bool:
    return False


def set_interactive(interactive: Any) -> None:
    pass
