"""Which middleware of ROS 2 is here: `RMW_IMPLEMENTATION` names the package of the one that nodes are to use."""

from __future__ import annotations

import os
import re
from collections.abc import Callable

from preflight_analysis.environment.model import Environment

VARIABLE = "RMW_IMPLEMENTATION"
_NAME = re.compile(r"\w+", re.ASCII)


def is_there(environment: Environment, name: str, is_file: Callable[[str], bool]) -> bool:
    """Whether nodes find a middleware: its library, as `rmw_implementation` and the loader look for it, lies in a
    prefix or beside the interpreter with rclpy."""
    if name in environment.packages:
        return True
    python = environment.ros2_python
    beside = (os.path.dirname(os.path.dirname(python)),) if python is not None else ()
    listed = environment.variables.get("LD_LIBRARY_PATH", "").split(os.pathsep)
    folders = [*(f"{prefix}/lib" for prefix in (*environment.ament_prefixes, *beside)), *filter(None, listed)]
    return _NAME.fullmatch(name) is not None and any(is_file(f"{folder}/lib{name}.so") for folder in folders)
