"""Python launch files and what their packages install: moved files, linked underlays, modules, prefixes."""

from __future__ import annotations

from pathlib import Path

import pytest
from support.python_launch_harness import MANIFEST, PythonHarness

pytestmark = pytest.mark.ros

HEAD = """\
import os, pathlib
from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch_ros.actions import Node
"""
DESCRIPTION = """
def generate_launch_description():
    return LaunchDescription([Node(package='p', executable='x', name=NAME)])
"""
CMAKE_MANIFEST = MANIFEST.replace("ament_python", "ament_cmake")
CMAKE = """
project(demo)
install(DIRECTORY launch DESTINATION share/${PROJECT_NAME})
install(DIRECTORY doc/tut/cfg/ DESTINATION share/${PROJECT_NAME}/config)
install(FILES doc/names.txt DESTINATION share/${PROJECT_NAME}/text RENAME moved.txt)
ament_python_install_package(scripts)
ament_python_install_package(${PROJECT_NAME}_py PACKAGE_DIR python/inner)
"""


@pytest.fixture
def harness(tmp_path: Path) -> PythonHarness:
    harness = PythonHarness(tmp_path)
    harness.write("setup.py", "from setuptools import setup\nsetup(name='p')\n")
    demo = tmp_path / "src" / "demo"
    for name, text in {
        "package.xml": CMAKE_MANIFEST.format("demo"),
        "CMakeLists.txt": CMAKE,
        "doc/tut/cfg/p.yaml": "in_cfg",
        "doc/names.txt": "in_names",
        "scripts/__init__.py": "",
        "scripts/names.py": "NAME = 'in_scripts'",
        "python/inner/__init__.py": "NAME = 'in_inner'",
    }.items():
        (demo / name).parent.mkdir(parents=True, exist_ok=True)
        (demo / name).write_text(text)
    return harness


def _names(harness: PythonHarness, code: str) -> list[str]:
    analysis = harness.launch(harness.write("launch/a.launch.py", HEAD + code + DESCRIPTION))
    assert [finding.message for finding in analysis.findings if finding.rule == "LCH032"] == []
    return [node.name for node in analysis.tree.nodes]


SHARE = "SHARE = get_package_share_directory('demo')\n"


@pytest.mark.parametrize(
    ("code", "name"),
    [
        ("NAME = open(os.path.join(SHARE, 'config', 'p.yaml')).read()", "in_cfg"),
        ("NAME = open(SHARE + '/text/moved.txt').read()", "in_names"),
        ("NAME = pathlib.Path(SHARE, 'config', 'p.yaml').read_text()", "in_cfg"),
        ("NAME = 'n%d' % os.path.isfile(SHARE + '/config/p.yaml')", "n1"),
        ("NAME = 'n%d' % os.path.isdir(SHARE + '/config')", "n1"),
        ("NAME = 'n%d' % (pathlib.Path(SHARE) / 'config' / 'p.yaml').exists()", "n1"),
        ("NAME = os.listdir(SHARE + '/config')[0].partition('.')[0]", "p"),
        ("NAME = 'n%d' % os.path.exists(SHARE + '/config/q.yaml')", "n0"),
        ("NAME = 'n%d' % os.path.exists(SHARE + '/doc/names.txt')", "n1"),
    ],
)
def test_a_file_is_where_it_will_be_installed(harness: PythonHarness, code: str, name: str) -> None:
    assert _names(harness, SHARE + code) == [f"/{name}"]


def test_what_is_installed_nowhere_is_missing(harness: PythonHarness) -> None:
    path = harness.write(
        "launch/a.launch.py", HEAD + SHARE + "open(SHARE + '/config/q.yaml')\nNAME = 'n'" + DESCRIPTION
    )
    (finding,) = [f for f in harness.launch(path).findings if f.rule == "LCH032"]
    assert finding.message.startswith("FileNotFoundError: ")
    assert finding.message.endswith("demo/config/q.yaml'")


@pytest.mark.parametrize(
    ("code", "name"),
    [("from scripts.names import NAME", "in_scripts"), ("from demo_py import NAME", "in_inner")],
)
def test_modules_that_cmake_installs(harness: PythonHarness, code: str, name: str) -> None:
    assert _names(harness, code) == [f"/{name}"]


def test_the_prefix_path_is_set_where_ros2_launch_runs(harness: PythonHarness, tmp_path: Path) -> None:
    code = "NAME = 'n%d' % bool(os.getenv('AMENT_PREFIX_PATH').split(':')[0])"
    assert _names(harness, code) == ["/n1"]
    path = harness.write(
        "launch/a.launch.py", HEAD + "NAME = os.environ['AMENT_PREFIX_PATH'].split('/')[-1]" + DESCRIPTION
    )
    underlay = tmp_path / "underlay"
    underlay.mkdir()
    tree = harness.launch(path, variables={"AMENT_PREFIX_PATH": str(underlay)}).tree
    assert [node.name for node in tree.nodes] == ["/underlay"]


def test_an_underlay_of_links_shows_what_they_lead_to(harness: PythonHarness, tmp_path: Path) -> None:
    """`colcon build --symlink-install` of a package with `setup.py` has links to `build/`, and there to the source."""
    underlay = tmp_path.parent / f"underlay of {tmp_path.name}"
    source, build, share = underlay / "src" / "u", underlay / "build" / "u", underlay / "install" / "share" / "u"
    index = underlay / "install" / "share" / "ament_index" / "resource_index" / "packages"
    for folder in (source, build, share, index):
        folder.mkdir(parents=True)
    (index / "u").write_text("")
    for name, text in {"package.xml": CMAKE_MANIFEST.format("u"), "names.txt": "in_underlay"}.items():
        (source / name).write_text(text)
        (build / name).symlink_to(source / name)
        (share / name).symlink_to(Path("..", "..", "..", "build", "u", name))
    code = "NAME = open(get_package_share_directory('u') + '/names.txt').read()"
    path = harness.write("launch/a.launch.py", HEAD + code + DESCRIPTION)
    tree = harness.launch(path, prefixes=[underlay / "install"]).tree
    assert [node.name for node in tree.nodes] == ["/in_underlay"]
