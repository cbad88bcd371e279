"""Tags that packages add to the launch language of ROS 2."""

from __future__ import annotations

from pathlib import Path

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace

MANIFEST = "<package><name>{}</name><export><build_type>ament_cmake</build_type></export></package>"
ENTRY = "[options.entry_points]\nlaunch.frontend.launch_extension =\n  sim = sim\n"
LAUNCH = (
    "<launch>\n  <open_hangar world='w'/>\n  <group><open_hangar/></group>\n  <node><open_hangar/></node>\n</launch>\n"
)


def write(path: Path, text: str) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    return path


def said(folder: Path) -> list[tuple[int, str]]:
    """What is said of tags: lines from 0, severities."""
    path = write(folder / "src" / "robot" / "launch" / "a.launch.xml", LAUNCH)
    write(folder / "src" / "robot" / "package.xml", MANIFEST.format("robot"))
    environment = detect_environment(str(folder), {"AMENT_PREFIX_PATH": str(folder / "opt"), "ROS_VERSION": "2"})
    analysis = Workspace(environment, Sources(), str(folder)).static(str(path))
    lines = analysis.documents[str(path)].lines
    found = [f for f in analysis.findings if f.rule == "LCH004"]
    return [(lines.position(f.location.span.start)[0], f.severity) for f in found]


def extension(folder: Path) -> None:
    write(folder / "sim" / "__init__.py", "")
    write(folder / "sim" / "actions" / "server.py", "@expose_action('open_hangar')\nclass Server(Action):\n    pass\n")


def test_a_tag_that_nobody_defines(tmp_path: Path) -> None:
    assert said(tmp_path) == [(1, "hint"), (2, "hint"), (3, "hint")]


def test_with_ros_a_tag_that_nobody_defines_stops_the_launch(tmp_path: Path) -> None:
    write(tmp_path / "opt" / "share" / "ament_index" / "resource_index" / "packages" / "launch_ros", "")
    assert said(tmp_path) == [(1, "warning"), (2, "warning"), (3, "warning")]


@pytest.mark.parametrize("installed", [False, True])
def test_a_tag_that_a_package_defines(tmp_path: Path, *, installed: bool) -> None:
    if installed:
        write(tmp_path / "opt" / "share" / "ament_index" / "resource_index" / "packages" / "sim", "")
        site = tmp_path / "opt" / "lib" / "python3.12" / "site-packages"
        entry = "[launch.frontend.launch_extension]\nsim = sim\n"
        write(site / "sim-1.0-py3.12.egg-info" / "entry_points.txt", entry)
        extension(site)
    else:
        package = tmp_path / "src" / "sim"
        write(package / "package.xml", MANIFEST.format("sim"))
        write(package / "setup.cfg", ENTRY)
        extension(package)
    assert [line for line, _ in said(tmp_path)] == [3], "no action may stand in a node"


def test_what_an_entry_point_names_elsewhere_is_not_read(tmp_path: Path) -> None:
    """It may be the root of the file system, which takes for ever."""
    outside = tmp_path / "outside"
    extension(outside)
    write(tmp_path / "opt" / "share" / "ament_index" / "resource_index" / "packages" / "launch_ros", "")
    site = tmp_path / "opt" / "lib" / "python3.12" / "site-packages"
    entry = f"[launch.frontend.launch_extension]\nsim = {outside}\n"
    write(site / "sim-1.0-py3.12.egg-info" / "entry_points.txt", entry)
    assert said(tmp_path) == [(1, "warning"), (2, "warning"), (3, "warning")]


def test_a_huge_package_is_not_walked_to_its_end(tmp_path: Path) -> None:
    package = tmp_path / "src" / "sim"
    write(package / "package.xml", MANIFEST.format("sim"))
    write(package / "setup.cfg", ENTRY)
    for number in range(600):
        (package / "sim" / f"a{number}").mkdir(parents=True)
    extension(package)
    write(package / "sim" / "z" / "late.py", "@expose_action('open_hangar')\n")
    (package / "sim" / "actions" / "server.py").unlink()
    assert [line for line, _ in said(tmp_path)] == [1, 2, 3]
