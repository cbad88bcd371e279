"""What an edit asks of the disk does not grow by much with each node that it leaves alone."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from preflight_analysis.environment.detect import detect
from preflight_analysis.incremental.database import Database
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace

MOST_OF_A_NODE = 4
"""Measured: 1; 10 where imports were looked up for each node anew."""


def _written(folder: Path, count: int) -> Path:
    """A workspace with a launch file of so many nodes: programs that import a module of their package."""
    package = folder / "src" / "harbour"
    (package / "scripts").mkdir(parents=True)
    (package / "src" / "harbour").mkdir(parents=True)
    (package / "package.xml").write_text(
        '<package format="2"><name>harbour</name><version>1.0.0</version><description>Cranes</description>'
        '<maintainer email="harbour@example.com">Harbour</maintainer><license>BSD</license>'
        "<buildtool_depend>catkin</buildtool_depend></package>"
    )
    (package / "src" / "harbour" / "__init__.py").write_text("")
    (package / "src" / "harbour" / "crane.py").write_text("SPEED = 1\n")
    nodes = []
    for number in range(count):
        script = package / "scripts" / f"crane_{number}.py"
        script.write_text(
            "#!/usr/bin/env python3\nimport rospy\nfrom harbour import crane\n"
            f"rospy.init_node('crane')\nrospy.Publisher('load_{number}', None)\n"
            "rospy.get_param('~speed', crane.SPEED)\n"
        )
        script.chmod(0o755)
        nodes.append(
            f'<node pkg="harbour" type="crane_{number}.py" name="crane_{number}"><param name="speed" value="1"/></node>'
        )
    path = package / "yard.launch"
    path.write_text("<launch>\n" + "\n".join(nodes) + "\n</launch>\n")
    return path


def _reads_of_an_edit(folder: Path, count: int, monkeypatch: pytest.MonkeyPatch) -> int:
    path = _written(folder, count)
    sources = Sources()
    workspace = Workspace(detect(str(folder), [str(folder / "src")]), sources, str(folder))
    text = path.read_text()
    sources.open(str(path), text)
    assert len(workspace.analysed(str(path)).tree.nodes) == count
    reads = 0
    read = Database.read

    def counted(self: Database, kind: Any, key: Any) -> object:
        nonlocal reads
        reads += 1
        return read(self, kind, key)

    with monkeypatch.context() as patched:
        patched.setattr(Database, "read", counted)
        sources.open(str(path), text.replace('name="crane_0"', 'name="crane_first"'))
        assert workspace.analysed(str(path)).tree.nodes[0].name == "/crane_first"
    return reads


def test_reads_grow_little_with_the_nodes(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    few, many = (_reads_of_an_edit(tmp_path / str(count), count, monkeypatch) for count in (10, 60))
    assert many - few <= MOST_OF_A_NODE * (60 - 10), (few, many)


def test_an_edit_of_a_launch_file_looks_into_no_package_anew(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What is said of how a package is built and installed is made of its other files."""
    package = tmp_path / "src" / "harbour"
    for name, text in {
        "package.xml": '<package format="3"><name>harbour</name><export><build_type>ament_python</build_type></export>'
        "</package>",
        "setup.py": "from setuptools import setup\nsetup(name='harbour', packages=['harbour'], data_files=[])\n",
        "harbour/__init__.py": "",
        "harbour/crane.py": "import rclpy\n",
        "launch/yard.launch.py": "from launch import LaunchDescription\n\n\ndef generate_launch_description():\n"
        "    return LaunchDescription([])\n",
    }.items():
        (package / name).parent.mkdir(parents=True, exist_ok=True)
        (package / name).write_text(text)
    path, sources = str(package / "launch/yard.launch.py"), Sources()
    workspace = Workspace(detect(str(tmp_path)), sources, str(tmp_path))
    text = Path(path).read_text()
    sources.open(path, text)
    made: list[str] = []
    execute = Database._execute

    def noted(self: Database, cell: Any, kind: Any) -> None:
        made.append(kind.name)
        execute(self, cell, kind)

    monkeypatch.setattr(Database, "_execute", noted)
    assert "PKG004" in {finding.rule for finding in workspace.analysed(path).findings}
    assert "said_of_package" in made
    made.clear()
    sources.open(path, f"{text}\n")
    workspace.analysed(path)
    assert "_analysed" in made and "said_of_package" not in made
