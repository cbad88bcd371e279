"""How xacro is run where ROS has none: the one that is installed with the analysis, by its interpreter."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterable
from dataclasses import replace

from preflight_analysis.environment.model import Environment
from preflight_analysis.evaluation.commands import CommandResult
from preflight_analysis.evaluation.partial_text import lacks_of, named
from preflight_analysis.tracing import recipe as recipes
from preflight_analysis.tracing import ros2_recipe
from preflight_analysis.tracing.agents.variables import SHARES

_START = (
    "import os, sys; sys.path[0] = os.path.join(os.path.dirname(os.environ['PREFLIGHT_EVENTS']), 'lib'); "
    "from preflight_agents.own_xacro import main; del sys.path[0]; main()"
)


def make(environment: Environment, args: Iterable[str], cwd: str) -> recipes.Recipe:
    """The recipe of `xacro` with its arguments."""
    recipe = ros2_recipe.make_command(environment, sys.executable, ("-c", _START, *args), cwd)
    shares = {package.name: package.share for package in environment.packages.values()}
    return replace(recipe, env={**recipe.env, SHARES: json.dumps(shares)})


def judged(result: CommandResult) -> CommandResult:
    """The result of a run; that of one which lacks packages is known in part and does not count as done."""
    if result.status != "done" or not (lacks := lacks_of(result.output)):
        return result
    return CommandResult("not-run", result.output, named(lacks))
