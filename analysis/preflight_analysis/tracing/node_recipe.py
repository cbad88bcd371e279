"""The recipe of a node, as the launcher of its generation of ROS starts it."""

from __future__ import annotations

from preflight_analysis.environment.model import Environment
from preflight_analysis.tracing import ros1_recipe, ros2_recipe
from preflight_analysis.tracing.recipe import Recipe
from preflight_analysis.tracing.request import TraceRequest


def make(environment: Environment, request: TraceRequest, preload: str | None = None) -> Recipe:
    """The recipe of a request. `preload` is the library for the executable, if it is a program that one can be loaded
    into."""
    make_recipe = ros2_recipe.make if request.generation == 2 else ros1_recipe.make
    return make_recipe(environment, request, preload)
