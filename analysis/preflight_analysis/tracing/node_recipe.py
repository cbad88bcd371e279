"""The recipe of a node, as the launcher of its generation of ROS starts it."""

from __future__ import annotations

from collections.abc import Sequence

from preflight_analysis.environment.model import Environment
from preflight_analysis.tracing import ros1_recipe, ros2_recipe
from preflight_analysis.tracing.recipe import Recipe
from preflight_analysis.tracing.request import TraceRequest


def make(
    environment: Environment, request: TraceRequest, preload: str | None = None, modules: Sequence[str] = ()
) -> Recipe:
    """The recipe of a request. `preload` is the library for the executable, if it is a program that one can be loaded
    into. `modules` are the folders of the Python modules of packages that are not built, as CMake installs them."""
    if request.ros.ament:
        return ros2_recipe.make(environment, request, preload, modules)
    return ros1_recipe.make(environment, request, preload, modules)
