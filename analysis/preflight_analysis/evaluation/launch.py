"""What a launch file of any format would start, evaluated as the launcher of its generation does."""

from __future__ import annotations

from collections.abc import Mapping
from collections.abc import Set as AbstractSet

from preflight_analysis.documents.reading import Unreadable
from preflight_analysis.documents.span import Location
from preflight_analysis.environment.model import Environment
from preflight_analysis.environment.variables import with_variables
from preflight_analysis.evaluation.commands import Commands
from preflight_analysis.evaluation.files import Executables, Files
from preflight_analysis.evaluation.ros1.evaluate import evaluate
from preflight_analysis.evaluation.surroundings import Surroundings
from preflight_analysis.evaluation.tree import LaunchTree
from preflight_analysis.generation import ROS1
from preflight_analysis.knowledge.model import Knowledge


def evaluate_launch(
    path: str,
    args: Mapping[str, str],
    files: Files,
    executables: Executables,
    environment: Environment,
    cwd: str,
    commands: Commands,
    surroundings: Surroundings | None = None,
    assumed: AbstractSet[Location] = frozenset(),
    variables: Mapping[str, str] | None = None,
    *,
    knowledge: tuple[Knowledge, ...] = (),
    outline: bool = False,
) -> LaunchTree:
    """What launching `path` with `name:=value...` would start, where these `variables` of the environment are others;
    see `evaluate` and `evaluate_ros2`. `knowledge` is that of the user's own files. An `outline` has the includes, the
    nodes by their names, and what was read: of ROS 1 nothing else is worked out then."""
    found = files.launch_file(path)
    if isinstance(found, Unreadable) or found.generation == ROS1.number:
        environment = with_variables(environment, variables or {})
        given = files, executables, environment, cwd, commands, surroundings, assumed
        return evaluate(path, args, *given, knowledge=knowledge, outline=outline)
    # Who has launch files of ROS 1 alone starts faster without.
    from preflight_analysis.evaluation.ros2.evaluate import evaluate_ros2  # noqa: PLC0415

    common = files, executables, environment, cwd, commands, surroundings, assumed
    return evaluate_ros2(path, args, *common, variables, knowledge=knowledge)
