"""`$(find package)/path` with devel spaces, against real roslaunch."""

import subprocess
from pathlib import Path

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.environment.model import Executable
from preflight_analysis.evaluation.ros1.evaluate import evaluate
from preflight_analysis.evaluation.surroundings import Surroundings
from preflight_analysis.workspace.sources import Sources

pytestmark = pytest.mark.ros

WRITTEN = ["$(find demo)/scripts/run", "$(find demo)/config/a.yaml", "$(find demo)/nowhere/x", "$(find demo)/run2"]
MANIFEST = """<package format="2"><name>demo</name><version>1.0.0</version><description>x</description>
<maintainer email="a@example.org">a</maintainer><license>x</license></package>"""
ASK = """
import sys
from roslaunch.substitution_args import resolve_args
for text in sys.argv[1:]:
    print(resolve_args(text))
"""


class NoExecutables:
    def find(self, package: str, name: str) -> Executable:
        return Executable(None)


def touch(path: Path, mode: int = 0o644) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("")
    path.chmod(mode)


def test_executables_of_the_devel_space_come_first(tmp_path: Path) -> None:
    source = tmp_path / "ws" / "src" / "demo"
    touch(source / "config" / "a.yaml")
    touch(source / "scripts" / "run", 0o755)
    touch(source / "run2", 0o755)
    (source / "package.xml").write_text(MANIFEST)
    devel = tmp_path / "ws" / "devel"
    touch(devel / "lib" / "demo" / "run", 0o755)
    touch(devel / "lib" / "demo" / "run2")
    (devel / ".catkin").write_text(str(tmp_path / "ws" / "src"))
    env = {
        "HOME": str(tmp_path),
        "PATH": "/usr/bin:/bin",
        "ROS_DISTRO": "noetic",
        "ROS_PACKAGE_PATH": str(tmp_path / "ws" / "src"),
        "CMAKE_PREFIX_PATH": str(devel),
    }
    asked = subprocess.run(
        ["/usr/bin/python3", "-c", ASK, *WRITTEN], env=env, capture_output=True, text=True, check=True
    )
    params = "".join(f'<param name="p{n}" value="{text}"/>' for n, text in enumerate(WRITTEN))
    launch = tmp_path / "x.launch"
    launch.write_text(f"<launch>{params}</launch>")
    environment = detect_environment(None, env)
    tree = evaluate(str(launch), {}, Surroundings(Sources(), NoExecutables(), environment, "/"))
    assert [tree.params[f"/p{n}"].value for n in range(len(WRITTEN))] == asked.stdout.split()
