"""Launch files of a package that depends on `scanner`, which is not on this machine."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.tracing.interface import NOT_RUN, Interface
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Analysis, Workspace

_MANIFEST = "<package><name>robot</name><exec_depend>scanner</exec_depend></package>"


def analysed(
    folder: Path,
    text: str,
    name: str = "a.launch",
    distro: str | None = None,
    **files: str,
) -> Analysis:
    """Write the package with a launch file, and `files` beside it, into a workspace below `folder`, and analyse that
    without running anything. `distro`: what the environment names, None where it names none."""
    return _analysed(folder, text, name, distro, NOT_RUN, files)


def analysed_after(run: Interface, folder: Path, text: str, distro: str) -> Analysis:
    """The same where a run of each node told this."""
    return _analysed(folder, text, "a.launch", distro, run, {})


def _analysed(
    folder: Path, text: str, name: str, distro: str | None, run: Interface, files: Mapping[str, str]
) -> Analysis:
    package = folder / "ws" / "src" / "robot"
    for path, content in {"package.xml": _MANIFEST, name: text, **files}.items():
        (package / path).parent.mkdir(parents=True, exist_ok=True)
        (package / path).write_text(content)
    variables = {"ROS_DISTRO": distro} if distro else {}
    environment = detect_environment(str(folder / "ws"), variables, root=str(folder / "nowhere"))
    workspace = Workspace(environment, Sources(), str(folder / "ws"))
    analysis = workspace.static(str(package / name))
    return workspace.with_interfaces(analysis, [run] * len(analysis.tree.nodes), None)
