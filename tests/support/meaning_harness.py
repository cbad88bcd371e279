"""Launch files asked of us and of real roslaunch: the same job for both, answers that `against_roslaunch` compares."""

from __future__ import annotations

import json
import subprocess
from dataclasses import asdict, dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

from preflight_analysis.documents.json_text import dumps
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.environment.model import Environment
from preflight_analysis.evaluation.arguments import parse_arguments
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.tree_json import tree_json
from preflight_analysis.workspace.workspace import Workspace

ENV = {
    "HOME": "/home/robot",
    "PATH": "/usr/bin:/bin",
    "LANG": "C.UTF-8",
    "ROS_DISTRO": "noetic",
    "ROS_MASTER_URI": "http://localhost:11311",
}


@dataclass(frozen=True)
class Job:
    file: str
    args: tuple[str, ...]
    env: tuple[tuple[str, str], ...]
    package_path: tuple[str, ...]


def write_case(text: str, folder: Path) -> Job:
    """A case is a launch file, preceded by `args:` and `env:` lines and followed by files after `//- path` lines."""
    args: list[str] = []
    env, files, path = dict(ENV), {"root.launch": list[str]()}, "root.launch"
    for line in text.split("\n"):
        if line.startswith("//- "):
            path = line[4:].strip()
            files[path] = []
        elif line.startswith("args: ") and path == "root.launch":
            args = line[6:].split()
        elif line.startswith("env: ") and path == "root.launch":
            env.update(word.split("=") for word in line[5:].split())
        else:
            files[path].append(line)
    for name, lines in files.items():
        target = folder / name
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes("\n".join(lines).encode())
    return Job(str(folder / "root.launch"), tuple(args), tuple(env.items()), (str(folder),))


class Roslaunch:
    """Real roslaunch, in one process for many jobs: it takes 0.4 s to start."""

    def __enter__(self) -> Roslaunch:
        self._process = subprocess.Popen(
            ["/usr/bin/python3", str(Path(__file__).with_name("roslaunch_oracle.py"))],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            encoding="utf-8",
            cwd="/",
        )
        return self

    def __exit__(self, *_: object) -> None:
        with self._process:
            self._process.stdin.close()

    def ask(self, job: Job) -> dict[str, Any]:
        """What roslaunch makes of a launch file: a record that `against_roslaunch` compares with."""
        self._process.stdin.write(json.dumps({**asdict(job), "env": dict(job.env)}) + "\n")
        self._process.stdin.flush()
        found: dict[str, Any] = json.loads(self._process.stdout.readline())
        return found


def ask_us(job: Job) -> dict[str, Any]:
    """What `tree --format json` prints."""
    workspace = Workspace(_environment(job.env, job.package_path), Sources(), "/")
    analysis = workspace.static(job.file, parse_arguments(job.args))
    answer: dict[str, Any] = json.loads(dumps(tree_json(analysis.tree, analysis.documents, analysis.findings)))
    return answer


@lru_cache(maxsize=8)
def _environment(env: tuple[tuple[str, str], ...], package_path: tuple[str, ...]) -> Environment:
    return detect_environment(None, dict(env), package_path)
