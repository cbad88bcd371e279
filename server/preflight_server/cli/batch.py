"""`tree --batch`: many launch files in one process, one line of JSON each, in the order of the jobs."""

from __future__ import annotations

import json
import os
import threading
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

from preflight_analysis.documents.reading import Unreadable
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.environment.model import Environment
from preflight_analysis.evaluation.arguments import parse_arguments, parse_ros2_arguments
from preflight_analysis.evaluation.tree_json import tree_json
from preflight_analysis.tracing.commands import CommandCache, CommandRunner
from preflight_analysis.workspace.commands import CommandResults
from preflight_analysis.workspace.settle import settled
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace

from preflight_server.cli.errors import CLEAN, CannotDoError
from preflight_server.cli.output import print_json

BASE_ENV: Mapping[str, str] = {
    "HOME": "/home/robot",
    "USER": "robot",
    "LOGNAME": "robot",
    "HOSTNAME": "bench",
    "PATH": "/usr/bin:/bin",
    "LANG": "C.UTF-8",
    "ROS_DISTRO": "noetic",
    "ROS_VERSION": "1",
    "ROS_PYTHON_VERSION": "3",
    "ROS_MASTER_URI": "http://localhost:11311",
    "ROS_ETC_DIR": "/etc/ros",
    "ROS_HOSTNAME": "localhost",
    "ROS_IP": "127.0.0.1",
    "PYTHONDONTWRITEBYTECODE": "1",
}
"""What every job starts from, whatever this process was started with: the answers are the same on every machine."""

BASE_ENV_ROS2: Mapping[str, str] = {
    **BASE_ENV,
    "HOME": "$CWD/home",
    "ROS_DISTRO": "rolling",
    "ROS_VERSION": "2",
}
"""The same for ROS 2, with the home folder as the recorded answers of the real launch name it."""

NO_RUN = "--no-run was given"
_COMMAND = "<command>"
"""What the recorded answers of the real launch have for the output of commands, which are not run."""
_ROOT = "$ROOT"
_CWD = "/"
"""Relative include paths are relative to where roslaunch is called; a batch is called from nowhere in particular."""


@dataclass(frozen=True, slots=True)
class Job:
    """One line of the jobs file, its paths absolute."""

    file: str
    args: tuple[str, ...]
    env: Mapping[str, str]
    package_path: tuple[str, ...]


def answer_all(jobs: Path, *, no_run: bool = False) -> int:
    """Answer all jobs. Of what the files ask for only Python launch files are run, unless `no_run`. Raises
    `CannotDoError` at the first line that is no job."""
    environment_of = lru_cache(maxsize=4)(_environment)
    for job in _read(jobs):
        sources = Sources()
        sources.undecided = 2 if job.env.get("ROS_VERSION") == "2" else 1
        launch_file = sources.launch_file(job.file)
        generation = 1 if isinstance(launch_file, Unreadable) else launch_file.generation
        args = parse_arguments(job.args) if generation == 1 else parse_ros2_arguments(job.args)
        environment = environment_of(generation, job.package_path, tuple(sorted(job.env.items())))
        results = CommandResults(lambda: NO_RUN if no_run else None, _COMMAND)
        workspace = Workspace(environment, sources, _CWD, results)
        if no_run:
            analysis = workspace.static(job.file, args)
        else:
            runner = CommandRunner(environment, _CWD, CommandCache())
            analysis = settled(workspace, job.file, args, results, runner, threading.Event(), only_launch_files=True)
        print_json(tree_json(analysis.tree, analysis.documents, analysis.findings), indent=None)
    return CLEAN


def _environment(generation: int, package_path: tuple[str, ...], env: tuple[tuple[str, str], ...]) -> Environment:
    base = BASE_ENV if generation == 1 else BASE_ENV_ROS2
    variables = {**base, "ROS_PACKAGE_PATH": os.pathsep.join(package_path), **dict(env)}
    prefixes = [prefix for prefix in dict(env).get("AMENT_PREFIX_PATH", "").split(os.pathsep) if prefix]
    return detect_environment(None, variables, package_path, prefixes)


def _read(jobs: Path) -> Iterator[Job]:
    root = os.path.dirname(os.path.abspath(jobs))
    try:
        with jobs.open(encoding="utf-8") as lines:
            for number, line in enumerate(lines, 1):
                if line.strip():
                    yield _job(line, root, f"{jobs}:{number}")
    except (OSError, UnicodeDecodeError) as error:
        raise CannotDoError(f"{jobs} cannot be read: {error}") from error


def _job(line: str, root: str, where: str) -> Job:
    try:
        data: Any = json.loads(line)
        file, args = data["file"], data.get("args") or []
        env, package_path = data.get("env") or {}, data.get("package_path") or []
        ok = (
            isinstance(file, str)
            and isinstance(env, dict)
            and isinstance(args, list)
            and isinstance(package_path, list)
        )
        ok = ok and all(isinstance(each, str) for each in (*args, *env, *env.values(), *package_path))
    except (ValueError, KeyError, AttributeError, TypeError) as error:
        raise CannotDoError(f"{where}: no job: {error!r}") from error
    if not ok:
        raise CannotDoError(f"{where}: no job: file is text, args and package_path are lists of text, env maps to text")

    def filled(text: str) -> str:
        return text.replace(_ROOT, root)

    return Job(
        os.path.normpath(os.path.join(root, filled(file))),
        tuple(filled(each) for each in args),
        {name: filled(value) for name, value in env.items()},
        tuple(os.path.normpath(os.path.join(root, filled(folder))) for folder in package_path),
    )
