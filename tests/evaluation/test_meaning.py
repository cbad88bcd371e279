"""Our evaluation against real roslaunch: each file of fixtures/ros1/meaning is asked of both.

A case is a launch file, preceded by `args:` and `env:` lines and followed by further files after `//- path` lines.
"""

import json
import subprocess
from dataclasses import dataclass
from pathlib import Path

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.evaluation.arguments import parse_arguments
from preflight_analysis.evaluation.ros1.evaluate import evaluate
from preflight_analysis.evaluation.tree import Executable
from preflight_analysis.workspace.sources import Sources

pytestmark = pytest.mark.ros

HERE = Path(__file__).parent
CASES = sorted((HERE.parent.parent / "fixtures" / "ros1" / "meaning").glob("*.txt"))
ENV = {
    "HOME": "/home/robot",
    "PATH": "/usr/bin:/bin",
    "ROS_DISTRO": "noetic",
    "ROS_MASTER_URI": "http://localhost:11311",
}


@dataclass
class Case:
    file: Path
    args: list[str]
    env: dict[str, str]


def write(case: Path, folder: Path) -> Case:
    args, env, files, path = [], dict(ENV), {"root.launch": []}, "root.launch"
    for line in case.read_text().split("\n"):
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
        target.write_text("\n".join(lines))
    return Case(folder / "root.launch", args, env)


@pytest.fixture(scope="module")
def answers(tmp_path_factory: pytest.TempPathFactory) -> dict[str, tuple[Case, dict]]:
    cases = {case.stem: write(case, tmp_path_factory.mktemp(case.stem)) for case in CASES}
    jobs = [
        {"file": str(c.file), "args": c.args, "env": c.env, "package_path": [str(c.file.parent)]}
        for c in cases.values()
    ]
    done = subprocess.run(
        ["/usr/bin/python3", str(HERE.parent / "roslaunch_oracle.py")],
        input=json.dumps(jobs),
        capture_output=True,
        text=True,
        check=True,
        cwd="/",
    )
    return dict(zip(cases, zip(cases.values(), json.loads(done.stdout), strict=True), strict=True))


class NoExecutables:
    def find(self, package: str, name: str) -> Executable:
        return Executable(None)


def ours(case: Case) -> dict:
    folder = str(case.file.parent)
    environment = detect_environment(None, case.env, package_path=[folder])
    tree = evaluate(str(case.file), parse_arguments(case.args), Sources(), NoExecutables(), environment, "/")
    errors = [f"{p.kind}: {dict(p.data)}" for p in tree.problems if p.fatal]
    if errors:
        return {"error": "; ".join(errors)}
    return {
        "error": None,
        "nodes": sorted(
            (
                {
                    "name": n.name,
                    "namespace": n.namespace,
                    "package": n.package,
                    "executable": n.executable,
                    "args": n.args,
                    "remaps": [[r.source, r.target] for r in n.remaps],
                    "env": [list(e) for e in n.env],
                    "machine": n.machine,
                    "output": n.output,
                    "cwd": n.cwd,
                    "launch_prefix": n.launch_prefix,
                    "respawn": n.respawn,
                    "required": n.required,
                }
                for n in tree.nodes
            ),
            key=lambda n: n["name"],
        ),
        "params": {
            name: {"binary": list(p.value)} if isinstance(p.value, bytes) else [type(p.value).__name__, repr(p.value)]
            for name, p in tree.params.items()
        },
        "clear_params": sorted(tree.clear_params),
    }


@pytest.mark.parametrize("name", [case.stem for case in CASES])
def test_means_what_roslaunch_means(name: str, answers: dict[str, tuple[Case, dict]]) -> None:
    case, expected = answers[name]
    actual = ours(case)
    if expected["error"] is not None:
        assert actual["error"] is not None, expected["error"]
    else:
        assert actual == expected
