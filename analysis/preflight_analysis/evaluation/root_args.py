"""Arguments that a launch is given from outside: `name:=value` of a command line, the settings, an editor."""

from __future__ import annotations

from collections.abc import Collection

from preflight_analysis.evaluation.collector import Collector
from preflight_analysis.evaluation.problems import UnknownLaunchArgument
from preflight_analysis.launch.model import LaunchFile


def report_undeclared(state: Collector, root: LaunchFile, given: Collection[str], names: Collection[str]) -> None:
    """Note those that nothing asks for, where `names` are all that launch files could ask for; parameter files may have
    substitutions, too. roslaunch and `ros2 launch` take them without a word. Names with two underscores are
    roslaunch's own (`__ns`)."""
    if root.root is None or not given:
        return
    at = (root.document.location(root.root.kind_span),)
    used = {use.name for use in state.uses if use.kind == "arg"}
    for name in given:
        if name not in names and name not in used and not name.startswith("__"):
            state.problem(UnknownLaunchArgument(name, tuple(sorted(names))), at)
