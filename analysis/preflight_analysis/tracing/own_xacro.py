"""How xacro is run where ROS has none: the one that is installed with the analysis, by its interpreter."""

from __future__ import annotations

import importlib.util
import json
import os
import sys
from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache
from typing import Any

from preflight_analysis.catalogue import descriptions
from preflight_analysis.catalogue.packages import distribution_of
from preflight_analysis.environment import reach
from preflight_analysis.environment.model import Environment
from preflight_analysis.evaluation.commands import CommandResult
from preflight_analysis.evaluation.partial_text import catalogued_of, missing_of, named
from preflight_analysis.tracing import recipe as recipes
from preflight_analysis.tracing import ros2_recipe
from preflight_analysis.tracing.agents.variables import DESCRIPTIONS, SHARES

_START = (
    "import os, sys; sys.path[0] = os.path.join(os.path.dirname(os.environ['PREFLIGHT_EVENTS']), 'lib'); "
    "from preflight_agents.own_xacro import main; del sys.path[0]; main({})"
)


def make(environment: Environment, args: Sequence[str], cwd: str, *, old: bool = False) -> recipes.Recipe:
    """The recipe of `xacro` with its arguments; of `xacro.py` if it is the `old` one."""
    start = _START.format("old=True" if old else "")
    recipe = ros2_recipe.make_command(environment, sys.executable, ("-c", start, *args), cwd)
    shares = {package.name: package.share for package in environment.packages.values()}
    known = {DESCRIPTIONS: json.dumps(descriptions_for(environment, *args))}
    stable = {**recipe.stable, **known}
    ours = (*reach.interpreter_paths(sys.executable), *needed())
    return replace(recipe, env={**recipe.env, **known, SHARES: json.dumps(shares)}, stable=stable, ours=ours)


def module() -> str:
    """The folder of the module that came along, "" if it did not."""
    return _installed("xacro")


def needed() -> tuple[str, ...]:
    """What the module needs of the host, besides an interpreter: itself, what it imports, and the catalogue."""
    return tuple(filter(None, (module(), _installed("yaml"), str(descriptions.DESCRIPTIONS))))


@lru_cache(maxsize=2)
def _installed(name: str) -> str:
    """The folder of a module of ours, "" without it. It is not imported: only the sandbox needs it."""
    spec = importlib.util.find_spec(name)
    return os.path.dirname(spec.origin) if spec is not None and spec.origin else ""


def descriptions_for(environment: Environment, *paths: str) -> dict[str, Any]:
    """What the catalogue has of robot descriptions in packages that are not here: of the distribution that the paths
    are of, or else of that which the environment has."""
    distro = next(filter(None, map(descriptions.distribution_of, paths)), None)
    distro = distro or distribution_of(environment.generation, environment.distro)
    return descriptions.known_descriptions(distro, environment.packages)


def judged(result: CommandResult) -> CommandResult:
    """The result of a run; that of one which asks for packages that are not here is no more than a part of it, and does
    not count as done."""
    if result.status != "done" or not (missing := missing_of(result.output)):
        return result
    catalogued = catalogued_of(result.output)
    known = f"; the catalogue has {catalogued}" if catalogued is not None else ""
    return CommandResult("not-run", result.output, f"{named(missing)}{known}")
