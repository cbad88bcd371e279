"""What a launch file of any format would start, evaluated as the launcher of its generation does."""

from __future__ import annotations

from collections.abc import Mapping
from collections.abc import Set as AbstractSet
from dataclasses import replace

from preflight_analysis.documents.reading import Unreadable
from preflight_analysis.documents.span import Location
from preflight_analysis.environment.variables import with_variables
from preflight_analysis.evaluation.ros1.evaluate import evaluate
from preflight_analysis.evaluation.surroundings import Surroundings
from preflight_analysis.evaluation.tree import LaunchTree
from preflight_analysis.generation import ROS1


def evaluate_launch(
    path: str,
    args: Mapping[str, str],
    within: Surroundings,
    *,
    by_parts: bool = False,
    assumed: AbstractSet[Location] = frozenset(),
    variables: Mapping[str, str] | None = None,
) -> LaunchTree:
    """What launching `path` with `name:=value...` would start, where these `variables` of the environment are others;
    see `evaluate` and `evaluate_ros2`."""
    if _is_of_ros1(path, within):
        environment = with_variables(within.environment, variables or {})
        others = replace(within, environment=environment) if environment is not within.environment else within
        return evaluate(path, args, others, by_parts=by_parts, assumed=assumed)
    # Who has launch files of ROS 1 alone starts faster without.
    from preflight_analysis.evaluation.ros2.evaluate import evaluate_ros2  # noqa: PLC0415

    return evaluate_ros2(path, args, within, by_parts=by_parts, assumed=assumed, variables=variables)


def outline_of(path: str, args: Mapping[str, str], within: Surroundings) -> LaunchTree:
    """The includes of a launch, its nodes by their names, and what was read: of ROS 1 nothing else is worked out."""
    return (
        evaluate(path, args, within, outline=True) if _is_of_ros1(path, within) else evaluate_launch(path, args, within)
    )


def _is_of_ros1(path: str, within: Surroundings) -> bool:
    found = within.files.launch_file(path)
    return isinstance(found, Unreadable) or found.generation == ROS1.number
