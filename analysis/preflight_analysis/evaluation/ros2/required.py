"""Whether each argument that a launch file requires is passed, which launch looks at before it executes the file."""

from __future__ import annotations

import os

from preflight_analysis.documents.reading import Unreadable
from preflight_analysis.documents.span import LineIndex, Origin
from preflight_analysis.evaluation.catalogued import data_of
from preflight_analysis.evaluation.problems import ArgumentNeeded, MissingArgument, Problem
from preflight_analysis.evaluation.ros2.context import Context
from preflight_analysis.evaluation.ros2.declared import required_arguments
from preflight_analysis.evaluation.ros2.missing_packages import named_in_catalogue
from preflight_analysis.evaluation.ros2.place import Place
from preflight_analysis.evaluation.ros2.python_runs import recorded
from preflight_analysis.evaluation.ros2.state import State
from preflight_analysis.evaluation.ros2.substitute import Performer
from preflight_analysis.evaluation.ros2.walk import Walk
from preflight_analysis.evaluation.surroundings import Surroundings
from preflight_analysis.incremental.database import Database
from preflight_analysis.incremental.derived import derived
from preflight_analysis.incremental.query import query
from preflight_analysis.launch.model import Action, LaunchFile, Value


def check_required(walk: Walk, launch_file: LaunchFile, passed: list[str], include: Origin | None) -> None:
    """The include itself has to pass it: a configuration that is set already does not count. `include` is its place,
    None for the root file."""
    names = list(passed)
    if launch_file.partial:
        return

    def included(file: LaunchFile, action: Action) -> LaunchFile | None:
        return _included_without_context(walk, file, action)

    for declared in required_arguments(launch_file, included):
        names += declared.passed
        if declared.name in names:
            continue
        if declared.include is not None:
            walk.missing_below.append(declared)
        elif include is None:
            walk.state.problem(ArgumentNeeded(declared.name), (declared.location,))
        else:
            kind = MissingArgument(declared.name, declared.location.file, tuple(passed))
            walk.state.problem(kind, include)


def report_missing_below(walk: Walk) -> None:
    """launch stops there also where the include is never executed, for a condition around it that is false."""
    kinds = ((problem.kind, problem.location) for problem in walk.state.problems)
    said = {(place, kind.name) for kind, place in kinds if isinstance(kind, MissingArgument)}
    for missing in walk.missing_below:
        if missing.include is not None and (missing.include, missing.name) not in said:
            said.add((missing.include, missing.name))
            kind = MissingArgument(missing.name, missing.location.file, tuple(missing.passed))
            walk.state.problems.append(Problem(kind, (missing.include,), True))


def _included_without_context(walk: Walk, file: LaunchFile, action: Action) -> LaunchFile | None:
    state = walk.state
    value = action.value("file")
    if value is None or value.problem is not None:
        return None
    if any(part.command not in ("find-pkg-share", "find-pkg-prefix", "env") for part in value.substitutions):
        return None
    if state.by_parts:
        path = _path_without_context(state.files.db, state.within, _file_of(action))
    else:
        path = _path(state.within, value)
    if path is None:
        return None
    found = state.read_launch_file(path)
    if isinstance(found, Unreadable):
        return None
    if found.is_python:
        # Whether it is executed at all is not known yet: launch keeps to itself what it raises now.
        quiet = State(state.within)
        quiet.commands, quiet.inputs = state.commands, state.inputs
        found, _ = recorded(quiet, walk.context, found, (file.document.location(value.span),))
    return None if found.partial else found


@derived
def _file_of(include: Action) -> Value | None:
    """What an include names, wherever that stands."""
    value = include.value("file")
    return value.moved(-value.span.start) if value is not None else None


@query
def _path_without_context(db: Database, within: Surroundings, value: Value | None) -> str | None:
    """As `_path`: each file above asks for it, in each launch."""
    return _path(within, value) if value is not None else None


def _path(within: Surroundings, value: Value) -> str | None:
    """The file that a value leads to that asks for no launch configuration."""
    quiet = State(within)
    empty, nowhere = Context(within.environment.variables), Place("", LineIndex(""), ())
    result = Performer(quiet, empty, nowhere).value(value)
    if result.known:
        return quiet.located(os.path.normpath(os.path.join(within.cwd, result.text)))
    named = named_in_catalogue(quiet, empty, nowhere, value)
    return data_of(named) if named is not None else None
