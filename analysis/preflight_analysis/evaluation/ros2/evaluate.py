"""From the root launch file of ROS 2 to a LaunchTree."""

from __future__ import annotations

import os
from collections.abc import Mapping
from collections.abc import Set as AbstractSet
from functools import cache

from preflight_analysis.documents.reading import Unreadable
from preflight_analysis.documents.span import Location
from preflight_analysis.evaluation.known_files import params_of_files
from preflight_analysis.evaluation.meanings import KnownMeanings
from preflight_analysis.evaluation.problems import DuplicateNode
from preflight_analysis.evaluation.resolved import Resolved
from preflight_analysis.evaluation.root_args import report_undeclared
from preflight_analysis.evaluation.ros2.actions.registry import actions, parts, tags
from preflight_analysis.evaluation.ros2.bridges import note_files_of_bridges
from preflight_analysis.evaluation.ros2.check_language import check_language_ros2
from preflight_analysis.evaluation.ros2.check_values import check_values_ros2
from preflight_analysis.evaluation.ros2.context import Context, NotByPartsError
from preflight_analysis.evaluation.ros2.domain_bridges import note_files_of_domain_bridges
from preflight_analysis.evaluation.ros2.place import Place
from preflight_analysis.evaluation.ros2.required import check_required, report_missing_below
from preflight_analysis.evaluation.ros2.simulated import note_files_of_spawners, simulated_managers
from preflight_analysis.evaluation.ros2.state import State
from preflight_analysis.evaluation.ros2.walk import Ros2Language, Walk
from preflight_analysis.evaluation.rviz import note_configs_of_rviz
from preflight_analysis.evaluation.surroundings import Surroundings
from preflight_analysis.evaluation.tree import LaunchNode, LaunchTree
from preflight_analysis.launch.configurations import IMPLICIT
from preflight_analysis.launch.model import LaunchFile
from preflight_analysis.launch.problems import LanguageProblem


def evaluate_ros2(
    path: str,
    args: Mapping[str, str],
    within: Surroundings,
    *,
    by_parts: bool = False,
    assumed: AbstractSet[Location] = frozenset(),
    variables: Mapping[str, str] | None = None,
) -> LaunchTree:
    """What `ros2 launch path name:=value...` would start.

    Never raises for what the files contain: what is wrong is in the tree's problems, and evaluation goes on. What
    starts of processes bring about comes after the rest, then, marked as deferred, what timers and other events do.
    Reads through `within.files` only; runs nothing. `by_parts`: within a query, parts are remembered for these
    surroundings. The tags at `assumed` are taken whatever their conditions say, and `variables` of the environment are
    others: not by parts then.
    """
    try:
        state = State(within, by_parts=by_parts and within.files.db.is_making, assumed=assumed)
        _launch(path, args, variables or {}, state)
    except NotByPartsError:
        state = State(within, assumed=assumed)
        _launch(path, args, variables or {}, state)
    note_files_of_spawners(state)
    note_files_of_bridges(state)
    note_files_of_domain_bridges(state)
    note_configs_of_rviz(state, state.nodes)
    file_params = params_of_files(
        state, state.nodes, None, KnownMeanings(within.knowledge, within.environment.distro, 2)
    )
    simulated = simulated_managers(state)
    return LaunchTree(
        os.path.normpath(path),
        2,
        state.args,
        tuple(state.nodes),
        {},
        (),
        tuple(state.includes),
        {},
        tuple(state.uses),
        tuple(state.problems),
        tuple(state.unknowns),
        tuple(state.visited),
        state.inputs,
        tuple(state.commands),
        tuple(state.not_taken),
        state.edited,
        tuple(state.nodes_before),
        simulated,
        frozenset(state.made),
        file_params,
        tuple(state.state_changes),
    )


def _launch(path: str, args: Mapping[str, str], variables: Mapping[str, str], state: State) -> None:
    context = Context(state.environment.variables)
    for name, value in args.items():
        context.set(name, Resolved(value), None)
    for name, value in variables.items():
        context.set_variable(name, value)
    _execute(Walk(state, context, _language()), os.path.normpath(path), args)


@cache
def _language() -> Ros2Language:
    return Ros2Language(actions(), parts(), tags(), _check)


def _check(launch_file: LaunchFile) -> tuple[LanguageProblem, ...]:
    return (*check_language_ros2(launch_file), *check_values_ros2(launch_file))


def _execute(walk: Walk, path: str, args: Mapping[str, str]) -> None:
    """The root file, then what waits for events."""
    state = walk.state
    found = state.read_launch_file(path)
    if isinstance(found, Unreadable):
        state.unreadable_root(path, found)
        return
    walk.context.launch_file = path
    found, run = walk.as_run(found, ())
    check_required(walk, found, sorted(args), None)
    walk.file(Place(path, found.document.lines, (), run, found.partial), found)
    if (asked_for := walk.names[-1]) is not None:
        given = [name for name in args if not asked_for.may_have(name)]
        report_undeclared(state, found, given, asked_for.known | IMPLICIT)
    state.args = {name: arg for name, arg in state.args.items() if arg.origin[-1].file == found.path}
    while (upcoming := walk.events.upcoming(sure=not state.unknowns)) is not None:
        walk.deferred = upcoming.deferred
        walk.actions(upcoming.place, upcoming.actions)
    report_missing_below(walk)
    _report_duplicates(state)


def _report_duplicates(state: State) -> None:
    """Two nodes of one name: launch only warns, and both run."""
    first: dict[str, LaunchNode] = {}
    for node in state.nodes:
        if not node.named or node.unknowns:
            continue
        other = first.get(node.name)
        if other is None:
            first[node.name] = node
        else:  # it may be the same object: a loop executes an include twice
            origin = (*node.origin[:-1], _place_of_name(state, node))
            state.problem(DuplicateNode(node.name, _place_of_name(state, other)), origin, fatal=False)


def _place_of_name(state: State, node: LaunchNode) -> Location:
    return state.location(node.location.file, node.tag.span_of("name") or node.action.kind_span)
