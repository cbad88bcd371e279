"""How a Python launch file is run: as a command of the sandbox that tells what the file makes (`agents/recording/`)."""

from __future__ import annotations

import base64
import json
import os
import sys
import zlib
from dataclasses import replace
from typing import Any

from preflight_analysis.environment.model import Environment
from preflight_analysis.tracing import recipe as recipes

_WORD = 100_000
"""Characters of one argument; the system's limit is 128 KiB."""
_START = (
    # Our own code is beside the pipe for what is seen, wherever this run has that.
    "import os, sys; sys.path[0] = os.path.join(os.path.dirname(os.environ['PREFLIGHT_EVENTS']), 'lib'); "
    "from preflight_agents.recording.main import main; del sys.path[0]; main()"
)


def make(environment: Environment, request: dict[str, Any], cwd: str) -> recipes.Recipe:
    """The recipe of a request (`evaluation.ros2.python_runs.parse_request`)."""
    python = environment.python or sys.executable
    job = {
        **request,
        "packages": {name: package.share for name, package in environment.packages.items()},
        "paths": _module_folders(environment),
    }
    data = base64.b64encode(zlib.compress(json.dumps(job, sort_keys=True).encode(errors="surrogatepass"))).decode()
    words = [data[start : start + _WORD] for start in range(0, len(data), _WORD)]
    recipe = recipes.make_command(environment, python, ("-c", _START, *words), cwd)
    fixed = {"PYTHONHASHSEED": "0"}
    if "AMENT_PREFIX_PATH" in environment.variables:
        fixed["AMENT_PREFIX_PATH"] = environment.variables["AMENT_PREFIX_PATH"]
    return replace(recipe, env={**recipe.env, **fixed}, stable={**recipe.stable, **fixed})


def _module_folders(environment: Environment) -> list[str]:
    """Where the packages' Python modules are installed."""
    version = f"python{sys.version_info.major}.{sys.version_info.minor}"
    found: dict[str, None] = {}
    for name, package in environment.packages.items():
        end = os.path.join("share", name)
        if package.share.endswith("/" + end):
            prefix = package.share[: -len(end)].rstrip("/")
            for folder in _site_folders(prefix, version):
                found[folder] = None
    return list(found)


def _site_folders(prefix: str, version: str) -> list[str]:
    library = os.path.join(prefix, "lib")
    try:
        names = [name for name in os.listdir(library) if name.startswith("python3")]
    except OSError:
        return []
    names.sort(key=lambda name: name != version)
    folders = [os.path.join(library, name, kind) for name in names for kind in ("site-packages", "dist-packages")]
    return [folder for folder in folders if os.path.isdir(folder)]
