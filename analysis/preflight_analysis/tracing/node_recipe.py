"""The recipe of a node, as the launcher of its generation of ROS starts it."""

from __future__ import annotations

from preflight_analysis.environment.model import Environment
from preflight_analysis.tracing import ros1_recipe, ros2_recipe
from preflight_analysis.tracing.recipe import Recipe
from preflight_analysis.tracing.request import TraceRequest

_MAKE = {1: ros1_recipe.make, 2: ros2_recipe.make}


def make(environment: Environment, request: TraceRequest, preload: str | None = None) -> Recipe:
    """The recipe of a request. `preload` is the library for the executable, if it is a program that one can be loaded
    into."""
    return _MAKE[request.generation](environment, request, preload)
