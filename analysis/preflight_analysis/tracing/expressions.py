"""How an expression of a ROS 2 launch file is evaluated that our own evaluator does not do: in the sandbox, by the
user's Python."""

from __future__ import annotations

import json
import sys
from dataclasses import replace
from typing import Any

from preflight_analysis.environment.model import Environment
from preflight_analysis.tracing import recipe as recipes
from preflight_analysis.tracing import ros2_recipe

_EVALUATE = """
import importlib, json, math, sys
request = json.loads(sys.argv[1])
try:
    names = {}
    for module in map(importlib.import_module, request["modules"]) if request["imports"] else [math]:
        if module is math:
            names.update(vars(math))
        if request["imports"]:
            names[module.__name__] = module
    answer = {"text": str(eval(request["expression"], {}, names))}
except BaseException as error:
    # What the machine or the sandbox lacks is no mistake of the expression.
    elsewhere = isinstance(error, (OSError, ImportError, MemoryError))
    answer = {"error": str(error) or type(error).__name__, "sure": not elsewhere}
print("\\n" + json.dumps(answer), end="", flush=True)
"""
"""As `launch.substitutions.PythonExpression.perform` has it."""


def make(environment: Environment, request: dict[str, Any], cwd: str) -> recipes.Recipe:
    """The recipe of a request (`evaluation.ros2.expressions.parse_request`)."""
    python = environment.ros2_python or environment.python or sys.executable
    recipe = ros2_recipe.make_command(environment, python, ("-c", _EVALUATE, json.dumps(request, sort_keys=True)), cwd)
    fixed = {"PYTHONHASHSEED": "0"}  # the text of a set is the same each time
    return replace(recipe, env={**recipe.env, **fixed}, stable={**recipe.stable, **fixed})
