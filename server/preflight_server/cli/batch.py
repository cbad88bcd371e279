"""`tree --batch`: many launch files in one process, side by side; one line of JSON each, in the order of the jobs."""

from __future__ import annotations

import argparse
import json
import os
import threading
from collections.abc import Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from functools import lru_cache
from pathlib import Path
from typing import Any

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.reading import Unreadable
from preflight_analysis.environment.detect import detect_environment, workspace_of
from preflight_analysis.environment.model import Environment
from preflight_analysis.evaluation.arguments import arguments_of
from preflight_analysis.tracing.commands import CommandCache, CommandRunner
from preflight_analysis.tracing.schedule import processors
from preflight_analysis.workspace.commands import CommandResults
from preflight_analysis.workspace.resolve_commands import Resolving, resolve_commands
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.tree_json import tree_json
from preflight_analysis.workspace.workspace import Workspace

from preflight_server.cli.errors import CLEAN, CannotDoError
from preflight_server.cli.output import dumps_json, print_text
from preflight_server.cli.paths import with_paths

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
_BASE = {1: BASE_ENV, 2: BASE_ENV_ROS2}

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


def answer_all(jobs: Path, args: argparse.Namespace) -> int:
    """Answer all jobs, side by side where they have something run. Of what the files ask for only Python launch files
    are run, unless with `--no-run`, each in a sandbox of its own. Raises `CannotDoError` if a line is no job."""
    given = tuple(_read(jobs))
    surroundings = lru_cache(maxsize=4)(_Surroundings)
    cancel = threading.Event()

    def answer(job: Job) -> str:
        around = surroundings(job.package_path, tuple(sorted(job.env.items())))
        return _answer(job, around, cancel, args)

    with ThreadPoolExecutor(1 if args.no_run else processors()) as pool:
        try:
            for text in pool.map(answer, given):
                print_text(text)
        except BaseException:
            cancel.set()
            pool.shutdown(cancel_futures=True)
            raise
    return CLEAN


class _Surroundings:
    """What jobs with the same variables and package path share. Thread-safe."""

    def __init__(self, package_path: tuple[str, ...], env: tuple[tuple[str, str], ...]) -> None:
        self._package_path = package_path
        self._env = dict(env)
        self._lock = threading.Lock()
        self._runners: dict[int, CommandRunner] = {}
        self._sources = {1: Sources(), 2: Sources()}
        self._sources[2].undecided = 2

    def generation(self, file: str) -> int:
        """Of ROS, for which a launch file is."""
        undecided = 2 if self._env.get("ROS_VERSION") == "2" else 1
        launch_file = self._sources[undecided].launch_file(file)
        return 1 if isinstance(launch_file, Unreadable) else launch_file.generation

    def sources(self, generation: int) -> Sources:
        """The files, where one that shows no generation is of this one."""
        return self._sources[generation]

    def runner(self, generation: int) -> CommandRunner:
        """What runs Python launch files, in the environment of a generation."""
        with self._lock:
            if generation not in self._runners:
                self._runners[generation] = CommandRunner(
                    self._environment(generation), _CWD, CommandCache(), self._sources[generation]
                )
            return self._runners[generation]

    def _environment(self, generation: int) -> Environment:
        base = _BASE[generation]
        variables = {**base, "ROS_PACKAGE_PATH": os.pathsep.join(self._package_path), **self._env}
        prefixes = [prefix for prefix in self._env.get("AMENT_PREFIX_PATH", "").split(os.pathsep) if prefix]
        return detect_environment(None, variables, self._package_path, prefixes)


def _answer(job: Job, around: _Surroundings, cancel: threading.Event, options: argparse.Namespace) -> str:
    generation = around.generation(job.file)
    args = arguments_of(generation, job.args)
    runner = around.runner(generation)
    results = CommandResults(lambda: NO_RUN if options.no_run else None, _COMMAND)
    workspace = Workspace(runner.environment, around.sources(generation), _CWD, results)
    if options.no_run:
        analysis = workspace.static(job.file, args)
    else:
        by = Resolving(results, runner, cancel, only_launch_files=True)
        analysis = resolve_commands(workspace, job.file, args, by)
    data = tree_json(analysis.tree, analysis.documents, analysis.findings)
    return dumps_json(with_paths(data, options, [workspace_of(job.file)]), indent=None)


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
