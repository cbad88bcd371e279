"""Includes of launch files whose package is not here: the catalogue has them."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from preflight_analysis.catalogue import launches
from preflight_analysis.documents.reading import Text
from preflight_analysis.launch.catalogued import read_catalogued
from preflight_analysis.workspace.workspace import Analysis
from support.package_elsewhere import analysed

COMMIT = "0123456789abcdef0123456789abcdef01234567"
ROS1: list[list[Any]] = [
    [0, "arg", {"name": "rate"}],
    [0, "arg", {"name": "frame", "default": "base"}],
    [0, "include", {"file": "$(find scanner)/launch/filter.launch"}],
    [1, "arg", {"name": "topic", "value": "$(arg frame)_scan"}],
    [0, "node", {"pkg": "scanner", "type": "scan_node", "name": "scan_$(arg frame)"}],
    [1, "rosparam", {}, '{"size": 3}'],
    [1, "param", {"name": "rate", "value": "$(arg rate)"}],
]
FILTER: list[list[Any]] = [
    [0, "arg", {"name": "topic"}],
    [0, "node", {"pkg": "scanner", "type": "filter_node", "name": "filter"}],
    [1, "remap", {"from": "scan", "to": "$(arg topic)"}],
]
ROS2: list[list[Any]] = [
    [0, "arg", {"name": "rate"}],
    [0, "arg", {"name": "mode", "default": "slow"}],
    [1, "choice", {"value": "slow"}],
    [1, "choice", {"value": "fast"}],
    [0, "opaque", {"class": "OpaqueFunction"}],
    [0, "include", {"file": [["find-pkg-share", ["scanner"]], "/launch/filter.launch.xml"]}],
    [0, "node", {"pkg": "scanner", "exec": "scan_node", "name": [["var", ["mode"]], "_scan"]}],
    [1, "param", {"name": "size", "value": {"v": 3}}],
]
FILTER2: list[list[Any]] = [[0, "node", {"pkg": "scanner", "exec": "filter_node", "name": "filter"}]]


def data(rows: list[list[Any]], generation: int) -> str:
    head = ["makers/scanner", COMMIT, "2024-01-01", generation]
    return "[\n" + ",\n".join(json.dumps(row) for row in (head, *rows)) + "\n]\n"


@pytest.fixture(autouse=True)
def catalogue(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    folder = tmp_path / "catalogue"
    for distro, name, rows in (
        ("noetic", "scan.launch", ROS1),
        ("noetic", "filter.launch", FILTER),
        ("jazzy", "scan.launch.py", ROS2),
        ("jazzy", "filter.launch.xml", FILTER2),
    ):
        path = folder / distro / "scanner" / "launch" / f"{name}.json"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(data(rows, 1 if distro == "noetic" else 2))
    monkeypatch.setattr(launches, "LAUNCHES", folder)
    launches.launch_files_of.cache_clear()
    yield folder
    launches.launch_files_of.cache_clear()


def include(file: str, *arguments: str, ros2: bool = False) -> str:
    find = "find-pkg-share" if ros2 else "find"
    passed = "".join(f'<arg name="{name}" value="fast"/>' for name in arguments)
    return f'<launch><include file="$({find} scanner)/launch/{file}">{passed}</include></launch>'


def said(analysis: Analysis) -> list[tuple[str, str, str]]:
    """Of all findings but that the package is not here: rule, severity and confidence."""
    return [(f.rule, f.severity, f.confidence) for f in analysis.findings if f.rule not in ("PKG001", "PKG005")]


def test_the_nodes_of_ros1_are_those_of_the_launch(tmp_path: Path) -> None:
    analysis = analysed(tmp_path, include("scan.launch", "rate", "frame"))
    assert [node.name for node in analysis.tree.nodes] == ["/filter", "/scan_fast"]
    assert [(r.source, r.target) for r in analysis.tree.nodes[0].remaps] == [("scan", "fast_scan")]
    assert analysis.tree.params["/scan_fast/size"].value == 3
    assert said(analysis) == []


def test_the_nodes_of_ros2_are_those_of_the_launch(tmp_path: Path) -> None:
    analysis = analysed(tmp_path, include("scan.launch.py", "rate", "mode", ros2=True), "a.launch.xml")
    assert [node.name for node in analysis.tree.nodes] == ["/filter", "/fast_scan"]
    assert [(param.name, param.value) for param in analysis.tree.nodes[1].params] == [("size", 3)]
    assert not analysis.tree.complete  # a function of its own may do more
    assert said(analysis) == []


@pytest.mark.parametrize(
    ("distro", "sure"),
    [("noetic", ("error", "likely")), ("melodic", ("hint", "possible")), (None, ("hint", "possible"))],
)
def test_what_is_passed_in_ros1_is_checked(tmp_path: Path, distro: str | None, sure: tuple[str, str]) -> None:
    analysis = analysed(tmp_path, include("scan.launch", "raet"), distro=distro)
    assert said(analysis) == [("ARG002", *sure), ("ARG004", *sure)]
    messages = [finding.message for finding in analysis.findings if finding.rule.startswith("ARG")]
    where = "(from the catalogue of noetic, makers/scanner at 0123456)"
    assert messages == [
        f"required argument 'rate' of 'scanner/launch/scan.launch' is not passed; the include passes 'raet' {where}",
        f"argument 'raet' is not declared by 'scanner/launch/scan.launch'; did you mean 'rate'? {where}",
    ]


@pytest.mark.parametrize("passed", [("rate", "ratte", "raate"), ("rate", "enable_imu")])
def test_what_another_version_may_declare(tmp_path: Path, passed: tuple[str, ...]) -> None:
    found = said(analysed(tmp_path, include("scan.launch", *passed), distro="noetic"))
    assert found == [("ARG004", "info", "possible")] * (len(passed) - 1)


def test_what_is_passed_in_ros2_is_checked(tmp_path: Path) -> None:
    text = include("scan.launch.py", "mode", ros2=True)
    assert said(analysed(tmp_path, text, "a.launch.xml", "jazzy")) == [("ARG002", "error", "likely")]
    assert said(analysed(tmp_path, text, "a.launch.xml", "humble")) == [("ARG002", "hint", "possible")]
    wrong = include("scan.launch.py", "rate", "mode", ros2=True).replace('"mode" value="fast"', '"mode" value="fats"')
    assert said(analysed(tmp_path, wrong, "a.launch.xml", "jazzy")) == [("ARG009", "error", "likely")]


def test_a_file_that_is_a_slip_of_one(tmp_path: Path) -> None:
    finding = next(
        f for f in analysed(tmp_path, include("scna.launch"), distro="noetic").findings if f.rule == "LCH013"
    )
    assert (finding.severity, finding.confidence) == ("warning", "likely")
    assert finding.message.endswith("has no launch file 'launch/scna.launch'; did you mean 'scan.launch'?")
    assert [fix.title for fix in finding.fixes] == ["Replace 'scna.launch' with 'scan.launch'"]
    marked = analysed(tmp_path, include("scan_launch.py", ros2=True), "a.launch.xml", "jazzy")
    assert said(marked) == [("LCH013", "warning", "likely")]
    (in_mark,) = (
        f
        for f in analysed(tmp_path, include("scan.lanch.py", ros2=True), "a.launch.xml", "jazzy").findings
        if f.rule == "LCH013"
    )
    assert in_mark.message.endswith("did you mean 'scan.launch.py'?")


def test_a_file_that_no_known_one_is_like_may_be_of_another_version(tmp_path: Path) -> None:
    assert said(analysed(tmp_path, include("calibrate.launch"), distro="noetic")) == []
    assert said(analysed(tmp_path, include("../../../../noetic/scanner/launch/scan.launch"), distro="noetic")) == []


def test_a_package_that_is_here_is_what_it_is_here(tmp_path: Path) -> None:
    here = {
        "../scanner/package.xml": "<package><name>scanner</name></package>",
        "../scanner/launch/scan.launch": '<launch><node pkg="a" type="b" name="own"/></launch>',
    }
    analysis = analysed(tmp_path, include("scan.launch"), **here)
    assert [node.name for node in analysis.tree.nodes] == ["/own"]


def test_what_is_wrong_in_it_is_nobody_s_here(tmp_path: Path, catalogue: Path) -> None:
    wrong: list[list[Any]] = [
        [0, "nod", {}],
        [0, "include", {"file": "$(find nobodys)/a.launch"}],
        [0, "node", {"pkg": "$(find nobodys)", "name": "x", "type": "$(arg unknown)"}],
    ]
    (catalogue / "noetic" / "scanner" / "launch" / "wrong.launch.json").write_text(data(wrong, 1))
    launches.launch_files_of.cache_clear()
    assert said(analysed(tmp_path, include("wrong.launch"), distro="noetic")) == []


def test_places_are_rows() -> None:
    found = read_catalogued(Text.of("/x/scan.launch.py.json", data(ROS2, 2)))
    assert found.root is not None
    lines = [found.document.lines.position(action.span.start)[0] for action in found.root.walk()][1:]
    assert lines == list(range(2, 2 + len(ROS2)))
    assert [len(action.children) for action in found.root.children] == [0, 2, 0, 0, 1]


def test_the_real_data_can_be_read(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.undo()
    files = sorted(launches.LAUNCHES.rglob("*.json"), key=lambda path: path.stat().st_size)
    assert len(files) > 500
    for path in files:
        found = read_catalogued(Text.of(str(path), path.read_text()))
        assert found.root is not None
        assert launches.path_of(launches.catalogued_file(str(path)) or pytest.fail(path.name)) == str(path)
