"""The running system of a ROS 2 domain. Who is there is only known to who takes part: a process of the user's own
interpreter, with rclpy, tells it (`ros2_helper.py`). It is our code in the user's environment, and started only when
the user asks to watch."""

from __future__ import annotations

import json
import math
import os
import subprocess
import threading
from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, cast, get_args

from preflight_analysis.environment.ament import ament_prefixes, python_folders, rclpy_interpreter
from preflight_analysis.environment.model import Environment
from preflight_analysis.live.model import CannotObserveError, LiveEndpoint, LiveNode, Observation
from preflight_analysis.live.names import check_number, with_shown_names
from preflight_analysis.tracing.interface import Role

_HELPER = Path(__file__).with_name("ros2_helper.py")
_START_SECONDS = 60.0
"""Seconds until the helper has told the first graph."""
_MAX_LINE = 64 << 20
"""Characters; the largest system that is compared takes a third of it."""
_ROLES = frozenset(get_args(Role))


class Ros2Observer:
    """Observes the domain that the environment's variables name (ROS_DOMAIN_ID), as soon as it is first asked."""

    def __init__(self, environment: Environment) -> None:
        self._environment = environment
        self._process: subprocess.Popen[str] | None = None
        self._closed = False
        self._starting = threading.Lock()
        self._news = threading.Condition()
        self._latest: Observation | None = None
        self._error: str | None = None

    @property
    def place(self) -> str:
        """What is observed, for people."""
        return f"ROS 2 domain {self._environment.variables.get('ROS_DOMAIN_ID') or 0}"

    def close(self) -> None:
        """End the helper; another thread may be about to start it."""
        with self._starting:
            self._closed = True
            process, self._process = self._process, None
        if process is not None:
            process.kill()
            process.wait()

    def observe(self, within: float = math.inf) -> Observation:
        """The system as it was last told; only the first time it is waited for. Raises `CannotObserveError`."""
        with self._starting:
            if self._closed:
                raise CannotObserveError(f"{self.place} is no longer watched", final=True)
            if self._process is None:
                self._start()
        with self._news:
            self._news.wait_for(
                lambda: self._latest is not None or self._error is not None, min(within, _START_SECONDS)
            )
            if self._error is not None:
                raise CannotObserveError(self._error, final=True)
            if self._latest is None:
                raise CannotObserveError(f"rclpy reports nothing about {self.place}")
            return self._latest

    def _start(self) -> None:
        # Not the environment's own: that has the interpreters and folders of a workspace that nobody sourced.
        own = self._environment.own_variables
        prefixes = ament_prefixes(own, None, "/")
        python = rclpy_interpreter(own, prefixes, "/")
        if python is None:
            raise CannotObserveError(_lacking(self._environment.ros2_python), final=True)
        try:
            self._process = subprocess.Popen(
                [python, "-I", str(_HELPER), *_python_path(own, prefixes)],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.DEVNULL,
                env=_variables(own, prefixes),
                cwd="/",
                text=True,
                errors="replace",
            )
        except OSError as error:
            raise CannotObserveError(f"{python} cannot be started: {error.strerror}", final=True) from None
        threading.Thread(target=self._read, args=(self._process,), name="observe", daemon=True).start()

    def _read(self, process: subprocess.Popen[str]) -> None:
        assert process.stdout is not None
        while line := process.stdout.readline(_MAX_LINE):
            if len(line) == _MAX_LINE and not line.endswith("\n"):
                process.kill()
                self._report(None, f"{self.place} has more names than the limit")
                break
            try:
                self._report(said(line, self.place), None)
            except CannotObserveError as error:
                self._report(None, str(error))
            except (ValueError, TypeError, KeyError, AttributeError, RecursionError):
                continue  # a library that prints
        code = process.wait()
        if self._error is None:
            self._report(None, f"the process that queries rclpy exited with code {code}")

    def _report(self, observation: Observation | None, error: str | None) -> None:
        with self._news:
            self._latest, self._error = observation, error
            self._news.notify_all()


def said(line: str, place: str) -> Observation:
    """What a line of the helper says of the system. Raises `CannotObserveError` where it cannot be seen, any of
    `ValueError`, `TypeError`, `KeyError`, `AttributeError` and `RecursionError` if the line is none of the helper's."""
    observed: Mapping[str, Any] = json.loads(line)
    if error := observed.get("error"):
        raise CannotObserveError(f"rclpy does not work: {error}")
    counts = Counter(str(name) for name in observed["nodes"])
    check_number(place, counts, observed["endpoints"])
    endpoints = [
        LiveEndpoint(cast(Role, role), str(node), str(name), str(kind), dict(qos))
        for role, node, name, kind, qos in observed["endpoints"]
        if role in _ROLES
    ]
    lifecycle = {str(name): str(state) for name, state in observed["lifecycle"].items()}
    nodes = {name: LiveNode(name, count=count, lifecycle=lifecycle.get(name)) for name, count in counts.items()}
    return with_shown_names(Observation(2, nodes, tuple(endpoints)))


def _lacking(of_workspace: str | None) -> str:
    how = "source its set-up script, such as `source /opt/ros/jazzy/setup.bash`"
    if of_workspace is not None:
        return (
            f"rclpy was found only in the workspace ({of_workspace}), whose programs run only in "
            f"the sandbox: {how}, or the workspace's own if you trust it"
        )
    return f"rclpy was not found, but a running ROS 2 system is queried with it: {how}"


def _python_path(own: Mapping[str, str], prefixes: Sequence[str]) -> list[str]:
    """Where the helper imports from beside its interpreter's own folders, which alone count with `-I`: as modules on a
    path that Python starts with, a `sitecustomize` in it would be run, too."""
    named = [folder for folder in own.get("PYTHONPATH", "").split(os.pathsep) if os.path.isabs(folder)]
    return list(dict.fromkeys((*named, *(folder for prefix in prefixes for folder in python_folders(prefix)))))


def _variables(own: Mapping[str, str], prefixes: Sequence[str]) -> dict[str, str]:
    """The user's own, with what sourcing the distribution would add where it is not sourced."""
    given = dict(own)
    for name, folders in (
        ("LD_LIBRARY_PATH", [os.path.join(prefix, "lib") for prefix in prefixes]),
        ("AMENT_PREFIX_PATH", list(prefixes)),
    ):
        here = [entry for entry in given.get(name, "").split(os.pathsep) if entry]
        if joined := os.pathsep.join(dict.fromkeys((*here, *folders))):
            given[name] = joined
    return given
