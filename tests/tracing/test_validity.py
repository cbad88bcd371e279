"""What makes a node of a launch run again and what does not: real nodes of both client libraries, runs counted."""

from __future__ import annotations

import os
import shutil
import subprocess
import threading
import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import pytest
from preflight_analysis.environment.model import Package
from preflight_analysis.tracing.cache import TraceCache
from preflight_analysis.tracing.trace import Tracer, on_host
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace
from support.tracing_harness import environment, write_node

pytestmark = pytest.mark.ros

READER = """
import os, rospy
import helper
from std_msgs.msg import String
rospy.init_node("reader")
with open(os.path.join(os.path.dirname(__file__), "data.yaml")) as data:
    data.read()
rospy.Publisher(helper.topic, String, queue_size=1)
rospy.get_param("~rate", 1)
rospy.has_param("~extra")
rospy.search_param("robot_name")
rospy.get_param("/gains", {})
rospy.get_param("late", None)
rospy.spin()
"""
PLAIN = """
import rospy
from std_msgs.msg import String
rospy.init_node("plain")
rospy.Subscriber("news", String, print)
rospy.spin()
"""
CURIOUS = PLAIN.replace('("plain")', '("plain")\nrospy.get_name()').replace("plain", "curious")
LAUNCH = """
<launch>
  <param name="unread" value="1"/>
  <!-- here -->
  <node pkg="pkg" type="reader.py" name="reader"><param name="rate" value="5"/></node>
  <node pkg="pkg" type="plain.py" name="plain"/>
  <node pkg="pkg" type="curious.py" name="curious"/>
  <node pkg="pkg" type="native" name="native"><param name="frame" value="base"/></node>
</launch>
"""
LIBRARIES = ("roscpp", "rostime", "roscpp_serialization", "rosconsole", "boost_system", "boost_thread", "pthread", "dl")
LINKED = '#include <string>\nstd::string linked_name() {{ return "{}"; }}\n'


def compiled(folder: Path, source: str, name: str) -> None:
    """A shared library."""
    path = folder / f"{name}.cpp"
    path.write_text(source)
    subprocess.run(["g++", "-shared", "-fPIC", str(path), "-o", str(folder / f"lib{name}.so")], check=True)


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the compiled node and its libraries."""
    folder = tmp_path_factory.mktemp("built")
    compiled(folder, LINKED.format("linked"), "linked")
    compiled(folder, "int plugin = 1;\n", "plugin")
    source = Path(__file__).parent / "validity_node.cpp"
    link = [f"-L{folder}", "-llinked", "-Wl,-rpath,$ORIGIN", *(f"-l{name}" for name in LIBRARIES)]
    subprocess.run(["g++", "-w", str(source), "-o", str(folder / "native"), *link], check=True)
    return folder


class Harness:
    """A launch of four nodes that were all run."""

    def __init__(self, folder: Path, built: Path) -> None:
        self.package = folder / "pkg"
        self.package.mkdir()
        for name in ("native", "liblinked.so", "libplugin.so"):
            shutil.copy(built / name, self.package)
        for name, text in (("reader.py", READER), ("plain.py", PLAIN), ("curious.py", CURIOUS)):
            write_node(self.package, text, name)
        self.write("helper.py", "topic = 'news'\n")
        self.write("data.yaml", "a: 1\n")
        self.write("config.txt", "base\n")
        self.write("more.txt", "more\n")
        self.write("package.xml", "<package><name>pkg</name></package>")
        self.cache = TraceCache(folder / "cache")
        self.variables: dict[str, str] = {}
        self.age()

    def write(self, name: str, text: str) -> None:
        (self.package / name).write_text(text)

    def age(self) -> None:
        """Files that were saved long ago: what is saved while a node runs is not kept."""
        past = time.time() - 100
        for path in self.package.iterdir():
            os.utime(path, (past, past))

    def runs(self, launch: str = LAUNCH) -> list[str]:
        """The executables that were run for a launch."""
        self.write("a.launch", launch.lstrip())
        base = environment(self.package, variables=self.variables)
        found = {"pkg": Package("pkg", str(self.package), str(self.package / "package.xml"))}
        known = replace(base, packages=found)
        workspace = Workspace(known, Sources(), str(self.package))
        tracer = Tracer(known, self.cache)
        static = workspace.static(str(self.package / "a.launch"))
        ran = []
        for request in workspace.requests(static):
            assert request is not None
            interface = tracer.trace(request, threading.Event())
            assert interface.outcome.status == "spinning", interface.outcome
            if not interface.cached:
                ran.append(os.path.basename(request.executable))
        return ran


@pytest.fixture(scope="module")
def first(tmp_path_factory: pytest.TempPathFactory, built: Path) -> Harness:
    """The harness after the first runs."""
    harness = Harness(tmp_path_factory.mktemp("harness"), built)
    assert harness.runs() == ["reader.py", "plain.py", "curious.py", "native"]
    assert harness.runs() == [], "the same again"
    return harness


@pytest.fixture
def harness(first: Harness, tmp_path: Path) -> Iterator[Harness]:
    """The same harness for each test: what a test does to its files and its cache is undone."""
    kept, cache = tmp_path / "kept", first.cache
    shutil.copytree(first.package, kept)
    first.cache = TraceCache(shutil.copytree(cache.folder, tmp_path / "cache"))
    yield first
    shutil.rmtree(first.package)
    shutil.copytree(kept, first.package)
    first.cache, first.variables = cache, {}


def with_each(inside: str) -> str:
    return LAUNCH.replace("<!-- here -->", inside)


@pytest.mark.parametrize(
    ("launch", "again"),
    [
        # what no run depended on
        (with_each('<remap from="news" to="/elsewhere"/>'), []),
        (with_each('<remap from="linked" to="other"/><remap from="~rate" to="speed"/>'), ["reader.py"]),
        (LAUNCH.replace('<param name="unread" value="1"/>', '<param name="unread" value="2"/>'), []),
        (LAUNCH.replace('<param name="unread" value="1"/>', ""), []),
        (with_each('<param name="more" value="3"/>'), []),
        # where nodes and their parameters are, only matters to those that ask
        (
            LAUNCH.replace("<!-- here -->", '<group ns="robot">').replace("</launch>", "</group></launch>"),
            ["curious.py"],
        ),
        (LAUNCH.replace('name="curious"', 'name="renamed"'), ["curious.py"]),
        (LAUNCH.replace('name="plain"', 'name="renamed"').replace('name="native"', 'name="other"'), []),
        # parameters that are read: by get, has, search, by namespace, and that were not there
        (LAUNCH.replace('value="5"', 'value="6"'), ["reader.py"]),
        (LAUNCH.replace('<param name="rate" value="5"/>', ""), ["reader.py"]),
        (LAUNCH.replace('<param name="rate"', '<param name="extra" value="1"/><param name="rate"'), ["reader.py"]),
        (with_each('<param name="robot_name" value="r"/>'), ["reader.py", "native"]),
        (with_each('<param name="gains/p" value="1"/>'), ["reader.py"]),
        (with_each('<param name="late" value="1"/>'), ["reader.py"]),
        (LAUNCH.replace('value="base"', 'value="map"'), ["native"]),
        (LAUNCH.replace('<param name="frame"', '<param name="gains/p" value="1"/><param name="frame"'), ["native"]),
        (LAUNCH.replace('<param name="frame"', '<param name="asked" value="1"/><param name="frame"'), ["native"]),
        # arguments and environment
        (LAUNCH.replace('name="plain"', 'name="plain" args="--fast"'), ["plain.py"]),
        (LAUNCH.replace('name="native"', 'name="native" args="--fast"'), ["native"]),
        (
            LAUNCH.replace('name="plain"/>', 'name="plain"><env name="MODE" value="x"/></node>'),
            ["plain.py"],
        ),
        (with_each('<env name="MODE" value="x"/>'), ["reader.py", "plain.py", "curious.py", "native"]),
    ],
)
def test_a_changed_launch_file(harness: Harness, launch: str, again: list[str]) -> None:
    assert launch != LAUNCH
    assert harness.runs(launch) == again
    assert harness.runs(launch) == [], "it is known from then on"
    assert harness.runs() == [], "and so is what was before"


def replaced_library(harness: Harness) -> None:
    compiled(harness.package, LINKED.format("linked_anew"), "linked")


def replaced_plugin(harness: Harness) -> None:
    compiled(harness.package, "int plugin = 2, more = 3;\n", "plugin")


CHANGES: list[tuple[Callable[[Harness], object], list[str]]] = [
    (lambda harness: harness.write("helper.py", "topic = 'olds'\n"), ["reader.py"]),
    (lambda harness: harness.write("data.yaml", "a: 2\n"), ["reader.py"]),
    (
        lambda harness: (harness.package / "plain.py").write_text("#!/usr/bin/env python3\n# new\n" + PLAIN),
        ["plain.py"],
    ),
    (lambda harness: harness.write("config.txt", "map\n"), ["native"]),
    (lambda harness: harness.write("more.txt", "less\n"), ["native"]),
    (lambda harness: harness.write("absent.txt", "here\n"), ["native"]),
    (replaced_library, ["native"]),
    (replaced_plugin, ["native"]),
    (lambda harness: harness.write("unrelated.py", "x = 1\n"), []),
    (lambda harness: harness.write("unrelated.yaml", "x: 1\n"), []),
    (lambda harness: (harness.package / "data.yaml").touch(), []),
]


@pytest.mark.parametrize(("change", "again"), CHANGES)
def test_a_changed_file(harness: Harness, change: Callable[[Harness], object], again: list[str]) -> None:
    change(harness)
    harness.age()
    assert harness.runs() == again
    assert harness.runs() == []


def test_a_changed_environment(harness: Harness) -> None:
    harness.variables["ROS_ANYTHING"] = "x"
    assert harness.runs() == ["reader.py", "plain.py", "curious.py", "native"]
    harness.variables["SOMETHING_ELSE"] = "x"
    assert harness.runs() == [], "nodes do not get it"


def test_what_the_sandbox_has_of_its_own_is_no_dependency() -> None:
    """Another process of the host may have a file of that name, and write to it during the run."""
    opened = ("/dev/shm/fastdds_port7000", "/proc/self/maps", "/dev/null", "/usr/lib/os-release")
    assert on_host(opened, ()) == ("/usr/lib/os-release",)
