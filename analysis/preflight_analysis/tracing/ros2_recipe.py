"""What exactly is executed for a node of ROS 2: as `launch_ros` does it, `--ros-args` with name, namespace and a file
of parameters, but without remaps other than those of nodes' names.

The console script of a Python package that is not built is a call of its function; all such packages of the workspace
are on the module search path, as they would be once it is built and sourced.
"""

from __future__ import annotations

import json
import math
import os
import re
import sys
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from preflight_analysis.documents.disk import Disk
from preflight_analysis.environment import middleware
from preflight_analysis.environment.ament import INDEX, python_folders
from preflight_analysis.environment.installed_paths import installed_elsewhere, package_around
from preflight_analysis.environment.model import Environment
from preflight_analysis.tracing import recipe as recipes
from preflight_analysis.tracing.agents.variables import EXPECTED, INSTALLED, LOAD, SHARES
from preflight_analysis.tracing.load_request import load_request
from preflight_analysis.tracing.recipe import Recipe
from preflight_analysis.tracing.request import TraceRequest

PARAMETERS = f"{recipes.ROS_HOME}/parameters.yaml"
"""The file with the node's parameters, inside."""

LOADED = f"{recipes.ROS_HOME}/load_request"
"""The file with the request for the component that a container is to load, inside."""

_START = (
    "import importlib, sys; path, target = sys.argv[1:3]; sys.argv[:3] = [path]; del sys.path[0]; "
    "module, _, name = target.partition(':'); sys.exit(getattr(importlib.import_module(module), name)())"
)
"""Calls an entry point as its console script does."""
_TEXT = re.compile(r"""['"]([A-Za-z]\w*)['"]""")
_MOST_INSTALLED = 100_000
"""Characters of a variable of the environment; the system's limit is 128 KiB."""
_ELSEWHERE = (
    "ROS_DISCOVERY_SERVER",
    "ROS_STATIC_PEERS",
    "ROS_SUPER_CLIENT",
    "ROS_SECURITY_KEYSTORE",
    "ROS_SECURITY_ENABLE",
    "ROS_SECURITY_STRATEGY",
    "ROS_LOCALHOST_ONLY",
    "CYCLONEDDS_URI",
    "ZENOH_CONFIG_OVERRIDE",
    "ZENOH_SESSION_CONFIG_URI",
)
"""What leads the middleware to others, who are not there, or to interfaces of a network."""


def make(
    environment: Environment, request: TraceRequest, preload: str | None = None, modules: Sequence[str] = ()
) -> Recipe:
    """The recipe of a request of generation 2: of a program, which `preload` is the library for, or of a node in
    Python. `modules` are the folders of Python packages of the workspace that are imported from elsewhere than the
    folder of a `setup.py`."""
    stable = variables(environment, request.env)
    stable["PYTHONPATH"] = _joined([*_roots(request), *_split(stable, "PYTHONPATH"), *modules])
    python = environment.ros2_python or recipes.any_python(environment)
    if preload is None and (installed := _installed_for_node(environment, request.executable)) is not None:
        stable[INSTALLED] = installed
    if request.entry_point is not None:
        argv = [python, "-c", _START, request.executable, request.entry_point, *request.args]
    elif request.component is not None:
        argv = [request.program, *request.component.container_args]
    else:
        argv = [*([python] if preload is None else []), request.executable, *request.args]
    argv.append("--ros-args")
    files = {}
    if request.component is not None:
        argv += _named(request.component.container_node, named=request.component.container_named)
        renames, given = request.component.container_renames, _of_each(request)
        files[LOADED] = load_request(request).hex()
    else:
        argv += _named(request.node, named=request.named)
        renames, given = request.renames, _parameters(request)
    for source, target in renames:
        argv += ["-r", f"{source}:={target}"]
    if given:
        files[PARAMETERS] = json.dumps(given, ensure_ascii=False)
        argv += ["--params-file", PARAMETERS]
    env = recipes.inside(stable) | {
        "ROS_DOMAIN_ID": "0",
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
        EXPECTED: request.node,
        SHARES: json.dumps(_source_packages(environment)),
    }
    if request.component is not None:
        env[LOAD] = LOADED
    if preload is not None:
        env["LD_PRELOAD"] = recipes.preloading(preload, stable)
    return Recipe(
        tuple(argv),
        env,
        stable,
        recipes.folder(request),
        python=preload is None,
        preload=preload,
        files=files,
        workspaces=environment.workspace_folders,
    )


def _named(node: str, *, named: bool = True) -> list[str]:
    """The arguments that give a node its full name; its base only where it is `named`."""
    space, _, base = node.rpartition("/")
    return [*(["-r", f"__node:={base}"] if named else []), *(["-r", f"__ns:={space}"] if space else [])]


def make_command(environment: Environment, executable: str, args: Iterable[str], cwd: str) -> Recipe:
    """The recipe of a command, whose program was found as `executable`. Packages that are not built are offered to
    it as to nodes: xacro's `$(find)` asks `ament_index_python` for them."""
    stable = variables(environment, ())
    interpreter, python = recipes.shebang_interpreter(environment.ros2_python, executable, stable["PATH"])
    env = recipes.inside(stable) | {SHARES: json.dumps(_source_packages(environment))}
    argv, workspaces = (*interpreter, executable, *args), environment.workspace_folders
    return Recipe(argv, env, stable, cwd, python, workspaces=workspaces)


def variables(environment: Environment, extra: Iterable[tuple[str, str]]) -> dict[str, str]:
    """The variables of what is run for ROS 2: as if all prefixes were sourced, with what the launch file sets."""
    found = {k: v for k, v in recipes.variables(environment, extra, 2).items() if k not in _ELSEWHERE}
    if not middleware.is_there(environment, found.get(middleware.VARIABLE, ""), os.path.isfile):
        # Whichever it is, a node does the same: PKG008 speaks of one that is not installed.
        found.pop(middleware.VARIABLE, None)
    prefixes = environment.ament_prefixes
    beside = os.path.dirname(os.path.dirname(environment.ros2_python or sys.executable))
    own = [beside] if os.path.isdir(os.path.join(beside, INDEX)) else []
    sourced = _split(environment.variables, "AMENT_PREFIX_PATH")
    path = _split(found, "PATH")
    programs = [folder for prefix in prefixes if os.path.isdir(folder := f"{prefix}/bin") and folder not in path]
    folders = {
        "PATH": [*programs, *path],
        "PYTHONPATH": [*_split(found, "PYTHONPATH"), *_sources(environment), *_installed(environment)],
        "AMENT_PREFIX_PATH": [*_split(found, "AMENT_PREFIX_PATH"), *prefixes, *sourced, *own],
        "LD_LIBRARY_PATH": [*_split(found, "LD_LIBRARY_PATH"), *(f"{prefix}/lib" for prefix in prefixes)],
    }
    return found | {name: _joined(each) for name, each in folders.items() if each}


def _split(variables: Mapping[str, str], name: str) -> list[str]:
    return [entry for entry in variables.get(name, "").split(os.pathsep) if entry]


def _joined(folders: Iterable[str]) -> str:
    return os.pathsep.join(dict.fromkeys(folders))


def _roots(request: TraceRequest) -> list[str]:
    """The folder that the module of the entry point is imported from."""
    if request.entry_point is None:
        return []
    steps = request.entry_point.partition(":")[0].count(".") + 1
    at = request.executable
    for _ in range(steps + (os.path.basename(at) == "__init__.py")):
        at = os.path.dirname(at)
    return [at]


def _sources(environment: Environment) -> Iterable[str]:
    """The folders of the Python packages of the workspace that are there as source."""
    for package in environment.packages.values():
        if package.is_ament and os.path.isfile(os.path.join(package.share, "setup.py")):
            yield package.share


def _installed(environment: Environment) -> Iterable[str]:
    """What sourcing the prefixes would add."""
    for prefix in environment.ament_prefixes:
        yield from python_folders(prefix)


def _source_packages(environment: Environment) -> dict[str, str]:
    """Packages that the index of ament does not have, because they are not built."""
    installed = tuple(os.path.join(prefix, "") for prefix in environment.ament_prefixes)
    return {
        package.name: package.share
        for package in environment.packages.values()
        if package.is_ament and not package.share.startswith(installed)
    }


def _installed_for_node(environment: Environment, executable: str) -> str | None:
    """As `INSTALLED` has it; None where there is nothing."""
    pairs = installed_for(environment, executable, Disk().content(executable) or "")
    text = json.dumps(pairs)
    return text if pairs and len(text) <= _MOST_INSTALLED else None


def installed_for(environment: Environment, file: str, text: str, disk: Disk | None = None) -> list[tuple[str, str]]:
    """What the packages that a program names, and its own, install at other places of their share folders: it may open
    those."""
    own = package_around(environment, file)
    named = (environment.packages.get(name) for name in sorted(set(_TEXT.findall(text))))
    packages = {package.name: package for package in (own, *named) if package is not None}
    disk = disk or Disk()
    return [pair for package in packages.values() for pair in installed_elsewhere(disk, package)]


def _parameters(request: TraceRequest) -> dict[str, Any]:
    """The node's own parameters, for whatever name it has, or those of each node of the process; what a file cannot
    hold is left out."""
    return _of_each(request) or _sections({"/**": request.given_to(None)})


def _of_each(request: TraceRequest) -> dict[str, Any]:
    """Those of the nodes of the process that have others than the launch file's node."""
    return _sections({node: request.given_to(node) for node, _ in request.each})


def _sections(given_to: Mapping[str, Mapping[str, Any]]) -> dict[str, Any]:
    plain = {
        node: {name: value for name, value in given.items() if _is_plain(value)} for node, given in given_to.items()
    }
    return {node: {"ros__parameters": given} for node, given in plain.items() if given}


def _is_plain(value: Any) -> bool:
    items = value if isinstance(value, (list, tuple)) else (value,)
    return all(isinstance(i, (bool, int, str)) or (isinstance(i, float) and math.isfinite(i)) for i in items)
