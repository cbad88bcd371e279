"""An analysis of what is known of the runs of its nodes."""

from __future__ import annotations

from pathlib import Path

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.tracing.interface import Interface, Outcome
from preflight_analysis.workspace.run_results import NOT_ASKED_FOR, RunResults, node_keys
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Analysis, Workspace
from support.demo_package import create_demo_package

RAN = Interface("trace", Outcome("spinning"))


class Launch:
    """Two nodes that can be run, and one that has no executable."""

    def __init__(self, folder: Path) -> None:
        path = create_demo_package(folder)
        node = '<node pkg="demo" type="talker.py" name="a"/>'
        path.write_text(f'<launch>{node}<group ns="b">{node}</group><node pkg="none" type="t" name="c"/></launch>')
        self.workspace = Workspace(detect_environment(str(folder), {}, root=str(folder / "nothing")), Sources())
        self.static = self.workspace.static(str(path))

    def analysis(self, results: RunResults) -> Analysis:
        self.workspace.set_results(self.static.launch, results)
        return self.workspace.analysed(self.static.root)

    def reasons(self, results: RunResults) -> list[str | None]:
        graph = self.analysis(results).graph
        assert graph is not None
        return [each.outcome.reason for each in graph.processes]


@pytest.fixture
def launch(tmp_path: Path) -> Launch:
    return Launch(tmp_path)


def test_while_the_first_runs_are_under_way_there_is_no_graph(launch: Launch) -> None:
    analysis = launch.analysis(RunResults(pending=True))
    assert (analysis.graph, analysis.findings) == (None, launch.static.findings)


def test_what_was_not_asked_for_says_so(launch: Launch) -> None:
    missing = "package 'none' is not installed here"
    assert launch.reasons(RunResults()) == [NOT_ASKED_FOR, NOT_ASKED_FOR, missing]


@pytest.mark.parametrize("pending", [True, False])
def test_why_nothing_was_run_is_said_once_for_all(launch: Launch, pending: bool) -> None:
    results = RunResults(why_not_run="no trust", pending=pending)
    assert launch.analysis(results).why_not_run == "no trust"
    assert launch.reasons(results)[:2] == ["no trust", "no trust"]


def test_where_earlier_runs_tell_of_some_the_others_say_why(launch: Launch) -> None:
    known = {node_keys(launch.static.tree)[0]: RAN}
    results = RunResults(known, "no trust", pending=True)
    assert launch.analysis(results).why_not_run is None
    assert launch.reasons(results)[:2] == [None, "no trust"]


def test_a_run_under_way_is_no_reason_to_hold_back_the_rest(launch: Launch) -> None:
    known = {node_keys(launch.static.tree)[1]: RAN}
    found = launch.analysis(RunResults(known, pending=True)).graph
    assert found is not None
    assert [each.pending for each in found.processes[:2]] == [True, False]
