"""What exactly is executed for a node of ROS 1, or for the command of a parameter.

As roslaunch does it (roslaunch.node_args): arguments, then remaps as `from:=to`, then `__name:=`, `__log:=`; the
namespace in `ROS_NAMESPACE`; the folder ROS_HOME unless `cwd="node"`. The command of a parameter has the environment
and the folder of roslaunch itself.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence

from preflight_analysis.environment.model import Environment
from preflight_analysis.evaluation import names
from preflight_analysis.tracing import nodelets
from preflight_analysis.tracing import recipe as recipes
from preflight_analysis.tracing.agents.variables import NODELET, SOURCES
from preflight_analysis.tracing.recipe import Recipe
from preflight_analysis.tracing.request import TraceRequest


def make(
    environment: Environment, request: TraceRequest, preload: str | None = None, modules: Sequence[str] = ()
) -> Recipe:
    """The recipe of a request of generation 1. Reads the executable's first line; an unreadable one is left for exec
    to complain of. `preload` is the library for the executable, if it is a program that one can be loaded into."""
    stable = variables(environment, request.env)
    user_python = environment.python or recipes.any_python(environment)
    interpreter, python = recipes.shebang_interpreter(user_python, request.executable, stable["PATH"])
    if python:
        stable |= _unbuilt(modules)
    args, remaps, process = request.args, request.remaps, request.node
    env = recipes.inside(stable)
    if nodelets.loaded_alone(request):
        args = ("standalone", args[1], *args[3:])
        if preload is not None:
            # `~` is the process's, and what the nodelet's own is the remaps of the loader say.
            remaps = tuple(names.resolve_remaps(remaps, request.node).items())
            process, env[NODELET] = nodelets.in_process(request.node), request.node
    argv = [*interpreter, request.executable, *args]
    remapped = python or preload is not None
    if remapped:
        argv += [f"{source}:={target}" for source, target in remaps]
    # Of any other executable only the master's view is known, where names are remapped already. It gets no remaps, so
    # that there too the names are those before remapping, and the graph can apply them.
    namespace, _, base = process.rpartition("/")
    argv += [f"__name:={base}", f"__log:={recipes.LOG_FOLDER}/{base}.log"]
    if namespace:
        env["ROS_NAMESPACE"] = namespace
    if preload is not None:
        env["LD_PRELOAD"] = recipes.preloading(preload, stable)
    cwd, workspaces = recipes.folder(request), environment.workspace_folders
    return Recipe(tuple(argv), env, stable, cwd, python, remapped, preload, workspaces=workspaces)


def make_command(
    environment: Environment, executable: str, args: Iterable[str], cwd: str, modules: Sequence[str] = ()
) -> Recipe:
    """The recipe of a command of a parameter, whose program was found as `executable`."""
    stable = variables(environment, ())
    interpreter, python = recipes.shebang_interpreter(environment.python, executable, stable["PATH"])
    if python:
        stable |= _unbuilt(modules)
    argv, workspaces = (*interpreter, executable, *args), environment.workspace_folders
    return Recipe(argv, recipes.inside(stable), stable, cwd, python, workspaces=workspaces)


def variables(environment: Environment, extra: Iterable[tuple[str, str]]) -> dict[str, str]:
    """The variables of what is run for ROS 1, with what the launch file sets."""
    return recipes.variables(environment, extra, 1)


def _unbuilt(modules: Sequence[str]) -> dict[str, str]:
    """Where Python finds what a build of the workspace will make known, if it finds it nowhere else."""
    return {SOURCES: os.pathsep.join(modules)} if modules else {}
