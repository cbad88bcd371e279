"""How a Python launch file is run: as a command of the sandbox that tells what the file makes
(`agents/fake_launch/`)."""

from __future__ import annotations

import base64
import errno
import hashlib
import json
import os
import sys
import zlib
from collections.abc import Iterable, Sequence
from dataclasses import replace
from functools import lru_cache
from typing import Any

from preflight_analysis.environment.ament import DISTRIBUTIONS, distribution
from preflight_analysis.environment.model import Environment
from preflight_analysis.tracing import interior, own_xacro, ros2_recipe
from preflight_analysis.tracing import recipe as recipes
from preflight_analysis.tracing.backend import AGENTS

_NETWORK = (errno.ENETUNREACH, errno.EHOSTUNREACH, errno.ECONNREFUSED, errno.ENETDOWN)
_WORD = 100_000
"""Characters of one argument; the system's limit is 128 KiB."""
_START = (
    # Our own code is beside the pipe for what is seen, wherever this run has that.
    "import os, sys; sys.path[0] = os.path.join(os.path.dirname(os.environ['PREFLIGHT_EVENTS']), 'lib'); "
    "from preflight_agents.fake_launch.main import main; del sys.path[0]; main()"
)


def make(environment: Environment, request: dict[str, Any], cwd: str) -> recipes.Recipe:
    """The recipe of a request (`evaluation.ros2.python_runs.parse_request`) in an environment as ROS 2 sees it."""
    # What the file imports is what the user's ROS 2 has, and that is for its interpreter.
    python = environment.ros2_python or environment.python or sys.executable
    # `ros2 launch` runs where a distribution is sourced, whatever is installed here.
    known = distribution(environment.variables, environment.ament_prefixes)
    distro = known or DISTRIBUTIONS[-1]
    sourced = {"AMENT_PREFIX_PATH": f"/opt/ros/{distro}", "ROS_DISTRO": distro}
    job = {
        **request,
        "packages": {name: p.share for name, p in environment.packages.items()} | request.get("packages", {}),
        "installed": ros2_recipe.installed_for(environment, str(request["file"]), str(request["text"])),
        "paths": _module_folders(environment),
        "own_xacro": own_xacro.module(),
        "descriptions": own_xacro.descriptions_for(environment),
        "assumed": [] if known else sorted(sourced.keys() - environment.variables.keys()),
    }
    data = base64.b64encode(zlib.compress(json.dumps(job, sort_keys=True).encode(errors="surrogatepass"))).decode()
    words = [data[start : start + _WORD] for start in range(0, len(data), _WORD)]
    recipe = ros2_recipe.make_command(environment, python, ("-c", _START, *words), cwd)
    fixed = {"PYTHONHASHSEED": "0"}
    sourced |= {"ROS_VERSION": "2", "ROS_PYTHON_VERSION": "3"}
    fixed |= {name: value for name, value in sourced.items() if name not in recipe.env}
    # What another version of ours told is not to be believed.
    stable = {**recipe.stable, **fixed, "fake_launch": _edition()}
    return replace(recipe, env={**recipe.env, **fixed}, stable=stable, ours=own_xacro.needed())


def group(request: dict[str, Any]) -> str | None:
    """The same for requests that differ in their last call alone; None for one without calls."""
    if not request["calls"]:
        return None
    return json.dumps({**request, "calls": request["calls"][:-1]}, sort_keys=True)


def together(requests: Sequence[dict[str, Any]]) -> dict[str, Any]:
    """One request for several of a `group`: what comes before the last call is done once, and each last call in a copy
    of the process."""
    return {**requests[0], "calls": requests[0]["calls"][:-1], "branches": [each["calls"][-1] for each in requests]}


def apart(output: str, count: int) -> list[str | None]:
    """The answers to requests that were run together; None for one that has to be asked alone."""
    try:
        found = json.loads(output).get("branches")
    except (ValueError, RecursionError, AttributeError):
        found = None
    if not isinstance(found, list) or len(found) != count:
        return [None] * count
    return [each if isinstance(each, str) else None for each in found]


@lru_cache(maxsize=1)
def _edition() -> str:
    """Names the code that tells what a launch file makes."""
    digest = hashlib.sha256()
    besides = (AGENTS.library / f"{name}.py" for name in ("anything", "installed", "missing_modules"))
    for path in (*besides, *sorted((AGENTS.library / "fake_launch").glob("*.py"))):
        digest.update(path.read_bytes())
    return digest.hexdigest()


def sandbox_to_blame(output: str, visible: Iterable[str], *, narrow: bool) -> str | None:
    """Why a launch file that raised would most likely not do so outside; None where there is no reason to think so.
    `narrow`: the sandbox refuses more than it must."""
    try:
        error = json.loads(output).get("error")
    except (ValueError, RecursionError, AttributeError):
        return None
    if not isinstance(error, dict):
        return None
    path, number, message = error.get("path"), error.get("errno"), str(error.get("message"))
    said = f"{error.get('type')}: {message}"
    if error.get("refused"):
        return message
    if number == errno.EROFS:
        return f"{said}: the sandbox lets no files be written"
    if isinstance(path, str) and os.path.isabs(path) and not interior.shown(path, visible) and os.path.exists(path):
        return f"{said}: the sandbox hides the file"
    if number in _NETWORK:
        return f"{said}: the sandbox has no network"
    return f"{said}: it may be the sandbox that refuses it" if narrow and isinstance(number, int) else None


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
