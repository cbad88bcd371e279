"""Which types a bridge converts into each other, as data."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from pathlib import Path

from preflight_analysis.documents.yaml import load_plain

_FILE = Path(__file__).with_name("ros_gz_bridge.yaml")


@cache
def gazebo_types() -> Mapping[str, tuple[str, ...]]:
    """The types of Gazebo, without their package, by the ROS type `package/Name` that is converted to and from them."""
    types = load_plain(_FILE.read_text(encoding="utf-8"))["types"]
    return {name: tuple(others) for name, others in types.items()}
