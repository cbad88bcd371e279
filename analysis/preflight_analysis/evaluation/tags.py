"""What the launch language of each generation is, as data."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache

from preflight_analysis.generation import ROS1
from preflight_analysis.launch.schema import Tag
from preflight_analysis.launch.schema_ros1 import TAGS


def tags_of(generation: int) -> Mapping[str, Tag]:
    """The tags by their names."""
    if generation == ROS1.number:
        return TAGS
    # Who has launch files of ROS 1 alone starts faster without.
    from preflight_analysis.evaluation.ros2.actions.registry import tags  # noqa: PLC0415

    return tags()


@cache
def scopes_of(generation: int) -> frozenset[str]:
    """The kinds of actions that have others inside, which count as if they stood in the file itself."""
    if generation == ROS1.number:
        return frozenset({"group"})
    from preflight_analysis.evaluation.ros2.actions.registry import actions  # noqa: PLC0415

    return frozenset(action.kind for action in actions().values() if action.holds_actions)
