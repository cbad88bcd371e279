"""A package with executables on the disk, and what the rules say of a node of it."""

from pathlib import Path

from preflight_analysis.environment.model import Environment, Package
from preflight_analysis.findings.finding import Finding
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace


def create_demo_package(folder: Path) -> Path:
    """A package `demo` with two nodes and a file that is not executable; the path of a launch file to write."""
    nodes = folder / "demo" / "nodes"
    nodes.mkdir(parents=True)
    (folder / "demo" / "package.xml").write_text("<package><name>demo</name></package>")
    for name in ("talker.py", "listener"):
        (nodes / name).write_text("#!/bin/sh\n")
        (nodes / name).chmod(0o755)
    (nodes / "plain.py").write_text("#!/bin/sh\n")
    (nodes / "plain.py").chmod(0o644)
    return folder / "demo" / "demo.launch"


def judge(launch: Path, executable: str, rest: str = "/>") -> list[Finding]:
    """The findings of a launch file with one node of the package `demo`; its tag ends with `rest`."""
    launch.write_text(f'<launch><node pkg="demo" type="{executable}" name="n"{rest}</launch>')
    share = str(launch.parent)
    packages = {"demo": Package("demo", share, f"{share}/package.xml")}
    environment = Environment(1, "noetic", {}, (str(launch.parent.parent),), packages, {}, (), (), None)
    return list(Workspace(environment, Sources(), share).static(str(launch)).findings)
