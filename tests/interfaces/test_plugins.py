"""Which plugins are known, and what they declare."""

from __future__ import annotations

import pytest
from preflight_analysis.catalogue import packages
from preflight_analysis.documents.disk import Disk
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.interfaces.plugins import PluginIndex


def index(distro: str) -> PluginIndex:
    packages.interfaces_of.cache_clear()
    return PluginIndex(detect_environment("/nowhere", {"ROS_DISTRO": distro}, root="/nowhere"), Disk())


def test_those_of_the_catalogue() -> None:
    known = index("jazzy")
    plugins = [name for path in packages.INTERFACES.rglob("*.json") for name in known.names(path.stem) if "::" in name]
    assert len(plugins) > 60
    assert None not in map(known.plugin, plugins)
    assert known.plugin("nav2_costmap_2d/ObstacleLayer") == known.plugin("nav2_costmap_2d::ObstacleLayer") is not None


def test_another_distribution_may_have_others() -> None:
    found = index("humble").plugin("nav2_navfn_planner::NavfnPlanner")
    assert found is not None
    assert found.params["tolerance"] == 0.5


@pytest.mark.parametrize("name", ["", "/", "::", "::A", "nav2_navfn_planner", "../jazzy::A", "nobody::A", "a" * 5000])
def test_what_is_no_name_of_one(name: str) -> None:
    assert index("jazzy").plugin(name) is None
