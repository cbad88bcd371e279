"""The configuration that RViz is started with: `rviz2 -d FILE`, https://github.com/ros2/rviz#start-rviz."""

from __future__ import annotations

from itertools import pairwise

from preflight_analysis.evaluation.collector import Collector
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.evaluation.words import words_of

_RVIZ = (("rviz2", "rviz2"), ("rviz", "rviz"))
_OPTIONS = ("-d", "--display-config")


def rviz_config_of(node: LaunchNode) -> str | None:
    """The path of the file; None of other nodes, and where it is not known."""
    if (node.package, node.executable) not in _RVIZ or node.unknowns:
        return None
    path = next((value for option, value in pairwise(words_of(node.args)) if option in _OPTIONS), "")
    return path if path.startswith("/") else None


def note_configs_of_rviz(found: Collector, nodes: list[LaunchNode]) -> None:
    """Read the files: their displays subscribe to topics."""
    for path in filter(None, map(rviz_config_of, nodes)):
        found.read_text(path)
