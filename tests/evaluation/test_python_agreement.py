"""What a run of a Python launch file tells, beside what is read of it."""

from __future__ import annotations

import json
import logging
from pathlib import Path

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.evaluation.commands import CommandResult
from preflight_analysis.evaluation.tree import LaunchTree
from preflight_analysis.workspace.commands import CommandResults
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace

TEXT = """from launch import LaunchDescription
from launch_ros.actions import Node
import no_such_module

def generate_launch_description():
    package = "demo"
    return LaunchDescription([
        Node(package=package, executable="talker", name=no_such_module.NAME),
        Node(package=package, executable="talker", name="b"),
    ])
"""


def _run(tmp_path: Path, *, name: str) -> LaunchTree:
    """The launch once it was run; the second node has that name there."""
    path = tmp_path / "a.launch.py"
    path.write_text(TEXT)
    results = CommandResults(lambda: None)
    environment = detect_environment(None, {"ROS_VERSION": "2"}, (str(tmp_path),), ())
    workspace = Workspace(environment, Sources(), str(tmp_path), results)
    (command,) = workspace.static(str(path)).tree.commands
    nodes = [
        {
            "k": "node",
            "n": "Node",
            "p": [line, 8],
            "a": {"pkg": ["demo"], "exec": ["talker"], "name": [each], "output": ["log"], "id": [f"{line}"]},
            "c": [],
            "i": line,
        }
        for line, each in ((8, "a"), (9, name))
    ]
    told = {"actions": nodes, "env": {}, "guessed": [], "missed": [], "assumed": [], "unmatched": [], "files": {}}
    results.update({command.line: CommandResult("done", json.dumps(told))})
    return workspace.static(str(path)).tree


def test_a_reading_that_differs_is_logged_once(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    with caplog.at_level(logging.WARNING):
        tree = _run(tmp_path, name="c")
        assert [node.name for node in tree.nodes] == ["/a", "/c"], "the run counts"
    said = [record.getMessage() for record in caplog.records if "differs" in record.getMessage()]
    assert said == [f'reading {tmp_path}/a.launch.py differs from its run: actions[1].a.name[0]: read "b" run "c"']


def test_one_that_agrees_is_not(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    with caplog.at_level(logging.WARNING):
        tree = _run(tmp_path, name="b")
    assert not [record for record in caplog.records if "differs" in record.getMessage()]
    (use, *_) = [each for each in tree.uses if each.kind == "executable"]
    assert TEXT[slice(*use.location.span)] == "talker"


def test_a_run_has_the_places_that_are_read(tmp_path: Path) -> None:
    tree = _run(tmp_path, name="b")
    value = tree.nodes[0].action.value("pkg")
    assert value is not None
    assert value.span.start == TEXT.index('"demo"') + 1
