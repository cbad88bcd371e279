"""Calls of one Python launch file that one run answers: each as if it had been run alone."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from preflight_analysis.tracing import run as run_module
from preflight_analysis.workspace import commands as commands_module
from preflight_analysis.workspace.workspace import Analysis
from support.python_launch_harness import PythonHarness

pytestmark = pytest.mark.ros

HEAD = """\
import os
import tempfile
import threading
from launch import LaunchDescription, Substitution
from launch_ros.actions import Node

count = 0
{before}

class Own(Substitution):
    def __init__(self, name):
        super().__init__()
        self.name = name

    def perform(self, context):
        global count
        count += 1
        {perform}
        return f'{{self.name}}_{{count}}'

def generate_launch_description():
    return LaunchDescription([Node(package='p', executable='x', name=Own(name)) for name in {names}])
"""
NAMES = [f"n{number}" for number in range(6)]


@pytest.fixture
def harness(tmp_path: Path) -> PythonHarness:
    return PythonHarness(tmp_path)


class Runs:
    """How often something was run."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.count = 0
        execute = run_module.execute_command

        def counted(*args: Any, **kwargs: Any) -> Any:
            self.count += 1
            return execute(*args, **kwargs)

        monkeypatch.setattr(run_module, "execute_command", counted)


@pytest.fixture
def runs(monkeypatch: pytest.MonkeyPatch) -> Runs:
    return Runs(monkeypatch)


def launched(harness: PythonHarness, perform: str = "pass", before: str = "") -> Analysis:
    text = HEAD.format(perform=perform, before=before, names=NAMES)
    return harness.launch(harness.write("launch/a.launch.py", text))


def names(analysis: Analysis) -> list[str]:
    return [node.name for node in analysis.tree.nodes]


def said(analysis: Analysis) -> list[tuple[str, str]]:
    return [(finding.rule, finding.message) for finding in analysis.findings]


def test_calls_of_one_file_are_one_run(harness: PythonHarness, runs: Runs) -> None:
    assert names(launched(harness)) == [f"/{name}_1" for name in NAMES], "none sees what another one did"
    assert runs.count == 2
    launched(harness)
    assert runs.count == 2, "each is kept"


def test_a_call_that_was_answered_with_others_is_known_alone(
    harness: PythonHarness, runs: Runs, monkeypatch: pytest.MonkeyPatch
) -> None:
    launched(harness)
    monkeypatch.setattr(commands_module, "MOST_TOGETHER", 1)
    assert names(launched(harness)) == [f"/{name}_1" for name in NAMES]
    assert runs.count == 2


@pytest.mark.parametrize(
    "perform",
    [
        "raise ValueError(self.name) if self.name == 'n2' else None",
        "os._exit(3) if self.name == 'n2' else None",
        "raise SystemExit(4) if self.name == 'n2' else None",
        "os.kill(os.getpid(), 9) if self.name == 'n2' else None",
        "os.environ['X'] = os.environ.get('X', '') + self.name; self.name = os.environ['X']",
        "self.name += str(len(os.listdir(tempfile.gettempdir()))); open(tempfile.mkstemp()[1], 'w').write(self.name)",
        "open('/tmp/same', 'a').write(self.name); self.name = open('/tmp/same').read()",
        "os.chdir('/tmp') if self.name == 'n2' else None; self.name += str(os.getcwd() == '/tmp')",
        "print('something', flush=True)",
        "threading.Thread(target=print, args=['more']).start()",
    ],
)
def test_each_is_as_if_it_were_alone(harness: PythonHarness, perform: str, monkeypatch: pytest.MonkeyPatch) -> None:
    together = launched(harness, perform)
    assert len(together.tree.nodes) + len(together.tree.unknowns) >= len(NAMES)
    monkeypatch.setattr(commands_module, "MOST_TOGETHER", 1)
    alone = launched(PythonHarness(harness.folder / "alone"), perform)
    assert names(together) == names(alone)
    assert said(together) == said(alone)


def test_a_file_with_threads_is_run_once_a_call(harness: PythonHarness, runs: Runs) -> None:
    before = "threading.Thread(target=threading.Event().wait, args=[2], daemon=True).start()"
    assert names(launched(harness, before=before)) == [f"/{name}_1" for name in NAMES]
    assert runs.count == 2 + len(NAMES)


def test_a_call_without_an_end_costs_the_others_nothing(
    harness: PythonHarness, runs: Runs, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(run_module, "COMMAND_SECONDS", 3.0)
    analysis = launched(harness, "threading.Event().wait() if self.name == 'n2' else None")
    assert {f"/{name}_1" for name in NAMES if name != "n2"} <= set(names(analysis))
    assert [unknown.reason for unknown in analysis.tree.unknowns if "did not end" in unknown.reason]
    assert runs.count == 2 + len(NAMES)
