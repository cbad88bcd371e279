"""How much was looked at."""

from __future__ import annotations

from preflight_analysis.evaluation.problems import LaunchFileNotRun, PythonImportFailed, UnsetVariable
from preflight_analysis.findings.coverage import Coverage


def test_in_words() -> None:
    nodes = {"none": 2, "source": 15, "catalogue": 2, "trace": 12}
    assert str(Coverage(41, 40, nodes)) == (
        "40 of 41 launch files evaluated, 31 nodes: 12 run, 15 by source, 2 by catalogue, 2 unknown"
    )
    assert str(Coverage(1, 1, {"trace": 1})) == "1 of 1 launch file evaluated, 1 node: 1 run"
    assert str(Coverage()) == "0 of 0 launch files evaluated, 0 nodes"
    assert Coverage(nodes={"of another kind": 3}).total_nodes == 3


def test_a_stand_in_leaves_nothing_out() -> None:
    assert LaunchFileNotRun("a.launch.py", "no sandbox").leaves_out
    assert PythonImportFailed("x", "No module named 'x'").leaves_out
    assert not PythonImportFailed("x", "No module named 'x'", stood_in_for=True).leaves_out
    assert not UnsetVariable("ROBOT").leaves_out
