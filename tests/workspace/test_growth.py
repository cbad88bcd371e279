"""No text takes a time that grows faster than n log n: fragments are repeated, twice as often each time.

The fragments are those that were once quadratic or worse, and for each format what is not closed, nested, declared or
named again and again.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from preflight_analysis.documents.reading import Unreadable
from preflight_analysis.documents.span import Span
from preflight_analysis.environment.cmake import read_build
from preflight_analysis.environment.model import Environment, Package
from preflight_analysis.environment.packages import find_packages
from preflight_analysis.environment.setup_py import read_python_build
from preflight_analysis.findings.report import Report, to_json, to_text
from preflight_analysis.queries.folding import folds
from preflight_analysis.queries.hints import hints
from preflight_analysis.queries.hover import hover
from preflight_analysis.queries.language import described, place_in
from preflight_analysis.queries.links import links
from preflight_analysis.queries.symbols import symbols
from preflight_analysis.queries.tokens import tokens
from preflight_analysis.source.analyse import SourceAnalysis
from preflight_analysis.source.known_params import LaunchParams
from preflight_analysis.workspace.facts import facts_of
from preflight_analysis.workspace.not_run import not_run
from preflight_analysis.workspace.project_settings import read_project_settings
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace
from preflight_server.lsp.positions import Positions
from support.growth import Clock, steep
from support.open_buffers import disk_with

MOST_CHARACTERS = 20_000

Read = Callable[[Path, str, Clock], None]


def environment(folder: Path, generation: int) -> Environment:
    package = Package("p", str(folder), str(folder / "package.xml"))
    distro = "noetic" if generation == 1 else "humble"
    return Environment(generation, distro, {}, (str(folder),), {"p": package}, {}, (), (), None, workspace=str(folder))


def launch_file(name: str, generation: int) -> Read:
    """All that is asked of a launch file that is open."""

    def read(folder: Path, text: str, clock: Clock) -> None:
        sources, path = Sources(), str(folder / name)
        sources.open(path, text)
        found = clock("parsing", lambda: sources.launch_file(path))
        assert not isinstance(found, Unreadable)
        clock("facts", lambda: facts_of(found))
        workspace = Workspace(environment(folder, generation), sources, str(folder))
        static = clock("evaluation", lambda: workspace.static(path))
        interfaces = [not_run(node, workspace.executables) for node in static.tree.nodes]
        analysis = clock("graph", lambda: workspace.with_interfaces(static, interfaces, "it was not asked for"))
        findings = clock("rules", lambda: analysis.findings)
        report = Report(findings, analysis.documents)
        clock("text", lambda: to_text(report))
        clock("json", lambda: to_json(report))
        clock("folds", lambda: folds(found))
        clock("symbols", lambda: symbols(found))
        clock("links", lambda: links(analysis, path))
        clock("hints", lambda: hints([analysis], path, Span(0, len(text))))
        clock("hover", lambda: hover([analysis], path, len(text) // 2))
        clock("described", lambda: described(found, len(text) // 2))
        clock("place", lambda: place_in(found, len(text) // 2))
        coloured = clock("tokens", lambda: tokens(found))
        positions = Positions(text, found.document.lines, "utf-16")
        clock("positions", lambda: [positions.range(token.span) for token in coloured])

    return read


def parameter_file(name: str, launch: str, generation: int) -> Read:
    def read(folder: Path, text: str, clock: Clock) -> None:
        sources = Sources()
        sources.open(str(folder / name), launch.format(folder=folder))
        sources.open(str(folder / "p.yaml"), text)
        workspace = Workspace(environment(folder, generation), sources, str(folder))
        analysis = clock("evaluation", lambda: workspace.static(str(folder / name)))
        findings = clock("rules", lambda: analysis.findings)
        clock("text", lambda: to_text(Report(findings, analysis.documents)))

    return read


def manifest(folder: Path, text: str, clock: Clock) -> None:
    (folder / "package.xml").write_text(text)
    clock("crawl", lambda: find_packages([str(folder)]))


def cmake(folder: Path, text: str, clock: Clock) -> None:
    clock("build", lambda: read_build(str(folder), "p", disk_with({folder / "CMakeLists.txt": text})))


def python_build(name: str) -> Read:
    def read(folder: Path, text: str, clock: Clock) -> None:
        clock("build", lambda: read_python_build(str(folder), "p", disk_with({folder / name: text})))

    return read


def settings(folder: Path, text: str, clock: Clock) -> None:
    (folder / ".ros-preflight.yaml").write_text(text)
    clock("settings", lambda: read_project_settings(str(folder)))


def node(name: str, head: str, generation: int) -> Read:
    def read(folder: Path, text: str, clock: Clock) -> None:
        (folder / "CMakeLists.txt").write_text("project(p)\nadd_executable(t t.cpp)\n")
        (folder / name).write_text(head + text)
        (folder / name).chmod(0o755)
        kind, launch = ("type", "a.launch") if generation == 1 else ("exec", "a.launch.xml")
        sources = Sources()
        executable = "t" if name.endswith(".cpp") else name
        sources.open(str(folder / launch), f'<launch><node pkg="p" {kind}="{executable}" name="n"/></launch>')
        around = environment(folder, generation)
        tree = Workspace(around, sources, str(folder)).static(str(folder / launch)).tree
        clock("source", lambda: SourceAnalysis(around, sources).read(tree.nodes[0], LaunchParams({})))

    return read


LAUNCH = ("<launch>", "</launch>")
ROSPARAM = '<launch><rosparam command="load" file="{folder}/p.yaml"/></launch>'
PARAM_FROM = '<launch><node pkg="p" exec="t" name="n"><param from="{folder}/p.yaml"/></node></launch>'
PYTHON = "#!/usr/bin/env python3\nimport rospy\n"
ROSCPP = "#include <ros/ros.h>\nint main(int argc, char** argv) { ros::NodeHandle n; std::string s; "
READERS: dict[str, Read] = {
    "roslaunch": launch_file("a.launch", 1),
    "ROS 2 XML": launch_file("a.launch.xml", 2),
    "ROS 2 YAML": launch_file("a.launch.yaml", 2),
    "ROS 2 Python": launch_file("a.launch.py", 2),
    "rosparam": parameter_file("a.launch", ROSPARAM, 1),
    "parameters": parameter_file("a.launch.xml", PARAM_FROM, 2),
    "package.xml": manifest,
    "CMake": cmake,
    "setup.py": python_build("setup.py"),
    "setup.cfg": python_build("setup.cfg"),
    "pyproject.toml": python_build("pyproject.toml"),
    "settings": settings,
    "rospy": node("n.py", PYTHON, 1),
    "rclpy": node("n.py", PYTHON.replace("rospy", "rclpy"), 2),
    "roscpp": node("t.cpp", ROSCPP, 1),
    "rclcpp": node("t.cpp", ROSCPP.replace("ros/ros.h", "rclcpp/rclcpp.hpp"), 2),
}
XML = ('<a b="', "<a ", "<!--", "&amp;", "<a>", "</a>", "<a\n", "é<a/>")
BRACKETS = ("(", "{", "a(", "'")
NAMES = ("~", "a/", "$(arg ")
CASES: dict[str, list[tuple[str, str, str]]] = {
    "roslaunch": [
        ("", "<!--", ""),
        *(("<launch>", piece, "</launch>") for piece in XML[:3]),
        *(('<launch><remap from="', name, '" to="b"/><node pkg="p" type="t" name="n"/></launch>') for name in NAMES),
        ("<launch>", '<param name="a{i}" value="$(arg b)"/>', "</launch>"),
        ("<launch>", '<node pkg="p" type="t" name="n"/>', "</launch>"),
        ("<launch>", '<remap from="a{i}" to="b"/>\n', '<node pkg="p" type="t" name="n"/></launch>'),
        ("<launch>", "<foo/>\n", "</launch>"),
    ],
    "ROS 2 XML": [
        *(("<launch>", piece, "</launch>") for piece in XML[:1]),
        ('<launch><let name="a" value="', "$(var ", '"/></launch>'),
        ("<launch>", '<arg name="a{i}" default="1"/>', "</launch>"),
        ("<launch>", '<node pkg="p" exec="t" name="n"/>', "</launch>"),
    ],
    "ROS 2 YAML": [("launch:\n", piece, "") for piece in ("- ", "[", "a: ", "- arg: {name: a{i}}\n", "#\n")],
    "ROS 2 Python": [
        *(("x = ", piece, "") for piece in (*BRACKETS, "a.", "**", "a if b else ", "-")),
        ("x = a", ".a", ""),
        ("x = [", "LaunchConfiguration('a{i}'),\n", "]"),
        ("x = [", "Node(package='p', executable='t'),", "]"),
        ("é = [", "Node(package='p', executable='t'),", "]"),
    ],
    "rosparam": [("", piece, "") for piece in ("- ", "[", "{a: ", "a{i}: 1\n", "&a ", "a: &b{i} [*b{j}]\n", '"')],
    "parameters": [("n:\n  ros__parameters:\n", piece, "") for piece in ("    a{i}: 1\n", "    a: 1\n", "[", '"')],
    "package.xml": [("<package><name>p</name>", piece, "") for piece in (*XML[:5], "<depend>a{i}</depend>")],
    "CMake": [("", piece, "") for piece in ("(", '"', "set(a{i} b)\n", 'set(a "${a} b")\n', "${", "if(a)\n", "#[[")],
    "setup.py": [("x = ", piece, "") for piece in (*BRACKETS, "a.", "[1]\n")],
    "setup.cfg": [("[options.entry_points]\n", piece, "") for piece in ("a{i} = b\n", " a\n", "%(a)s", "[")],
    "pyproject.toml": [("", piece, "") for piece in ("a.", "a{i} = 1\n", "[a{i}]\n", "#", "x = [1,\n")],
    "settings": [("", piece, "") for piece in ("[", "{", "a{i}: 1\n", "- a\n", '"')],
    "rospy": [("x = a\n", piece, "") for piece in (*BRACKETS, "x.a\n", "print x\n", "x = x + 'a'\n", "f(1)\n")],
    "rclpy": [("x = a\n", piece, "") for piece in ("def f{i}():\n  f{j}()\n", "if a: x = {i}\n", "x = [x]\n")],
    "roscpp": [
        ("", piece, "") for piece in (*BRACKETS, "<", "#define A{i} A{j}\n", "int a{i};", 's = s + "a";', "::a")
    ],
    "rclcpp": [("", piece, "") for piece in ("{", "a<", "if(a){}else ", "f(a);", "auto x{i} = [&]() {};\n")],
}


def cases() -> Iterator[object]:
    for name, found in CASES.items():
        for before, piece, after in found:
            yield pytest.param(name, before, piece, after, id=f"{name} {before[-12:]!a} {piece!a}")


@pytest.mark.slow
@pytest.mark.parametrize(("name", "before", "piece", "after"), cases())
def test_time_grows_with_the_length(name: str, before: str, piece: str, after: str, tmp_path: Path) -> None:
    def run(count: int, clock: Clock) -> None:
        middle = (piece.replace("{i}", str(i + 1)).replace("{j}", str(i)) for i in range(count))
        READERS[name](tmp_path, before + "".join(middle) + after, clock)

    assert steep(run, MOST_CHARACTERS // len(piece)) == []
