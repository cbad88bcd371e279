"""What exactly is executed for a `TraceRequest` or a command: argv, environment, folder, and what must be visible.

Here is what both generations of ROS have in common; `ros1_recipe` and `ros2_recipe` make the recipes.
"""

from __future__ import annotations

import os
import re
import shutil
import sys
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import field
from pathlib import Path

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.secrets import ALLOWED, withheld
from preflight_analysis.environment import reach
from preflight_analysis.environment.model import Environment
from preflight_analysis.environment.packages import MANIFEST
from preflight_analysis.tracing import interior
from preflight_analysis.tracing.agents.variables import LOAD, STAND_INS
from preflight_analysis.tracing.cache_folder import VARIABLE
from preflight_analysis.tracing.request import TraceRequest

ROS_HOME = "/tmp/ros_home"  # noqa: S108
LOG_FOLDER = "/tmp/ros_log"  # noqa: S108
MASTER_URI = "http://127.0.0.1:11311/"

OURS = ("HOME", "ROS_HOME", "ROS_LOG_DIR", "TMPDIR", "PREFLIGHT_EVENTS", LOAD, STAND_INS)
"""The variables that name folders and files of the sandbox's own."""

_SEARCH_PATHS = ("PYTHONPATH", "LD_LIBRARY_PATH", "GAZEBO_MODEL_PATH", "GAZEBO_RESOURCE_PATH", "GAZEBO_PLUGIN_PATH")
_PASSED = frozenset(
    (*_SEARCH_PATHS, "PATH", "LANG", "LANGUAGE", "TZ", "PYTHONUNBUFFERED", "PYTHONIOENCODING", "CMAKE_PREFIX_PATH")
)
_PASSED_PREFIXES = ("ROS_", "ROSCONSOLE_", "LC_")
_MAX_LINKS = 5
_DEFAULT_PATH = "/usr/local/bin:/usr/bin:/bin"


@dataclass(frozen=True, slots=True)
class Recipe:
    """Everything of a run but the parameters. `stable` is the part of the environment that names the run in the
    cache: the node's name and namespace and what is the same for all are left out."""

    argv: tuple[str, ...]
    env: Mapping[str, str]
    stable: Mapping[str, str]
    cwd: str
    python: bool
    """Whether the executable is a Python script."""
    remapped: bool = False
    """Whether it gets the remaps. The client library then tells the names from before remapping."""
    preload: str | None = None
    """The library that watches the client library in it."""
    files: Mapping[str, str] = field(default_factory=dict)
    """What is to be written inside, by its path there."""
    workspaces: tuple[str, ...] = ()
    """The folders of the workspace that it is run for: for another one it would see other files."""
    ours: tuple[str, ...] = ()
    """What it needs of what this program was installed with, wherever that lies."""


def preloading(library: str, stable: Mapping[str, str]) -> str:
    """LD_PRELOAD with a library of ours before those of the user."""
    return ":".join(path for path in (library, stable.get("LD_PRELOAD", "")) if path)


def inside(stable: Mapping[str, str]) -> dict[str, str]:
    """The variables inside the sandbox."""
    env = dict(stable)
    env["PYTHONPATH"] = os.pathsep.join(p for p in (interior.SITE, stable.get("PYTHONPATH", "")) if p)
    env |= {
        "HOME": interior.home(),
        "ROS_MASTER_URI": MASTER_URI,
        "ROS_IP": "127.0.0.1",
        "ROS_HOME": ROS_HOME,
        "ROS_LOG_DIR": LOG_FOLDER,
        "TMPDIR": "/tmp",  # noqa: S108
        "PREFLIGHT_EVENTS": "/run/preflight/events",
    }
    # Its threads cost more than they give in a run of half a second: 0.1 s of processor time for numpy's import.
    env.setdefault("OPENBLAS_NUM_THREADS", "1")
    return env


def any_python(environment: Environment) -> str:
    """The interpreter of nodes where their client library is not installed, and has a stand-in: the first `python3` of
    the PATH that is no script of a version manager, or our own."""
    for folder in environment.variables.get("PATH", _DEFAULT_PATH).split(os.pathsep):
        python = os.path.join(folder, "python3")
        if os.path.isabs(folder) and os.access(python, os.X_OK) and not _shebang(python):
            return python
    return sys.executable


def visible_paths(environment: Environment) -> list[str]:
    """What nodes of this environment need to see below the masked folders, as far as it may be shown."""
    paths = [*environment.package_path, *environment.devel_spaces, *environment.system_prefixes]
    for package in environment.packages.values():
        paths += [package.share, *_linked(package.manifest)]
    for variable in _SEARCH_PATHS:
        paths += environment.variables.get(variable, "").split(os.pathsep)
    paths += environment.ament_prefixes
    for python in (environment.python, environment.ros2_python, None):
        paths += reach.interpreter_paths(python or any_python(environment))
    own = [str(p) for p in Path(os.path.expanduser("~")).glob(".local/lib/python3*/site-packages")]
    return interior.needs_binding([*_allowed(environment, paths), *own])


def _allowed(environment: Environment, paths: Iterable[str]) -> list[str]:
    return [path for path in dict.fromkeys(paths) if os.path.isabs(path) and reach.may_be_shown(environment, path)]


def _linked(manifest: str) -> Iterator[str]:
    """The folders that a package's files are links into, one after another, where it was installed with
    `--symlink-install`: those of its manifest. A link to anything but a manifest shows nothing of where it leads."""
    for _ in range(_MAX_LINKS):
        try:
            manifest = os.path.join(os.path.dirname(manifest), os.readlink(manifest))
        except OSError:
            return
        if os.path.basename(manifest) != MANIFEST or not os.path.isfile(manifest):
            return
        yield os.path.dirname(manifest)


def request_paths(environment: Environment, request: TraceRequest, recipe: Recipe) -> list[str]:
    """What this node needs to see besides, as far as it may be shown."""
    started = dict.fromkeys((request.program, request.executable))
    paths = [path for program in started for path in _program_paths(environment, program)]
    return interior.needs_binding([*paths, recipe.preload or ""])


def command_paths(
    environment: Environment, recipe: Recipe, executable: str, files: Iterable[str], interpreter: str
) -> list[str]:
    """What a command needs to see besides: its program and those of the PATH, the folder it runs in, the files it names
    with what is beside them, and the interpreter of the supervisor, as far as that may be shown.

    Of what lies elsewhere the files that it names are shown, and nothing beside them: not where a link of the workspace
    leads there, and nothing in hidden folders, such as `~/.ssh`.
    """
    files = list(files)
    paths = [*recipe.stable["PATH"].split(os.pathsep), *reach.interpreter_paths(interpreter)]
    paths += [place for path in files for place in (path, os.path.dirname(path))]
    alone = [path for path in (executable, *files) if _may_be_named(environment, path)]
    programs = _program_paths(environment, executable)
    return interior.needs_binding([*programs, *_allowed(environment, paths), *alone, recipe.cwd, *recipe.ours])


def _may_be_named(environment: Environment, path: str) -> bool:
    access = environment.access
    hidden = "/." in path + os.path.realpath(path) or access.refusal(path) or access.out_of_reach(path)
    return os.path.isfile(path) and not hidden and not reach.in_workspace(environment, path)


def _program_paths(environment: Environment, executable: str) -> list[str]:
    paths = [os.path.dirname(executable), os.path.dirname(os.path.realpath(executable))]
    interpreter = _shebang(executable)
    if interpreter:
        paths += reach.interpreter_paths(interpreter[0])
    return paths if reach.is_users_program(environment, executable) else _allowed(environment, paths)


def out_of_reach(recipe: Recipe, executable: str, visible: Iterable[str]) -> str | None:
    """Of what is needed to start a program, what is there and not shown: where a link of the workspace leads out of it,
    or the interpreter that a script names."""
    needed = (recipe.argv[0], executable, *_shebang(executable)[:1])
    places = dict.fromkeys(place for path in needed for place in (path, os.path.realpath(path)))
    return next((p for p in places if os.path.exists(p) and not interior.shown(p, visible)), None)


def variables(environment: Environment, extra: Iterable[tuple[str, str]], generation: int) -> dict[str, str]:
    """What a node of a generation of ROS gets of the user's variables, with what the set-up of that ROS would set
    whatever is sourced here, and what the launch file sets."""
    overridden = {"ROS_MASTER_URI", "ROS_HOSTNAME", "ROS_IP", "ROS_IPV6", "ROS_HOME", "ROS_LOG_DIR", "ROS_NAMESPACE"}
    overridden |= {VARIABLE, ALLOWED}  # where the cache lies is nothing that a run may depend on, nor what we may read
    overridden |= withheld(environment.variables, environment.access.allowed)  # whoever made the environment
    kept = {
        name: value
        for name, value in environment.variables.items()
        if (name in _PASSED or name.startswith(_PASSED_PREFIXES)) and name not in overridden
    }
    kept.setdefault("PATH", _DEFAULT_PATH)
    if kept.get("ROS_VERSION") != str(generation):
        kept |= {"ROS_VERSION": str(generation), "ROS_PYTHON_VERSION": "3"}
    kept.update((name, value) for name, value in extra if name and "=" not in name and "\0" not in name + value)
    return kept


def _shebang(executable: str) -> list[str]:
    try:
        with Path(executable).open("rb") as file:
            line = file.read(256).split(b"\n", 1)[0]
    except OSError:
        return []
    # A carriage return is part of the name for the kernel, and nothing has such a name.
    return [word for word in re.split("[ \t]+", line[2:].decode(errors="replace")) if word] if line[:2] == b"#!" else []


def shebang_interpreter(user_python: str | None, executable: str, path: str) -> tuple[list[str], bool]:
    """What to put before the script, and whether it is Python.

    `#!/usr/bin/env python3` means the interpreter that the user's nodes have, which is not always the first of the
    PATH that this process was started with. `python` means that one too where there is none of that name: a build puts
    `python3` there. Any other name that is not known stays for `env` or the kernel to complain of.
    """
    words = _shebang(executable)
    if not words:
        return [], False
    if os.path.basename(words[0]) != "env":
        if os.path.basename(words[0]) == "python" and user_python and not os.path.exists(words[0]):
            return [user_python, *words[1:]], True
        return [], os.path.basename(words[0]).startswith("python")
    names_after = [word for word in words[1:] if not word.startswith("-") and "=" not in word]
    name = names_after[0] if names_after else ""
    python = name.startswith("python") and not name.startswith("python2")
    known = name == "python" or shutil.which(name, path=path) is not None
    if python and len(words) == 2 and user_python and known:
        return [user_python], True
    return [], python


def is_python(executable: str) -> bool:
    """Whether it is a Python script, by its first line."""
    return any(os.path.basename(word).startswith("python") for word in _shebang(executable)[:2])


def may_be_python2(executable: str) -> bool:
    """Whether it is a script that asks for Python 2, or for any version."""
    return any(re.match(r"python(2[\d.]*)?\Z", os.path.basename(word)) for word in _shebang(executable)[:2])


def missing_interpreter(executable: str) -> str | None:
    """The interpreter that the first line of a script names and that is not there."""
    words = _shebang(executable)
    return words[0] if words and not os.path.exists(words[0]) else None


def folder(request: TraceRequest) -> str:
    """The folder that the node starts in."""
    if request.cwd == "node":
        return os.path.dirname(request.executable)
    if request.cwd and os.path.isabs(request.cwd):
        return request.cwd
    return ROS_HOME
