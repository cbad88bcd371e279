"""Generated launch files of ROS 2 mean to us what they meant to real launch (`fixtures/ros2/meaning`)."""

from __future__ import annotations

import json
import shlex
import shutil
from collections import Counter
from pathlib import Path
from typing import Any

import pytest
from preflight_analysis.documents.json_text import dumps
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.evaluation.arguments import parse_ros2_arguments
from preflight_analysis.workspace.commands import CommandResults
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.tree_json import tree_json
from preflight_analysis.workspace.workspace import Workspace

FIXTURES = Path(__file__).parent.parent.parent / "fixtures" / "ros2" / "meaning"
CASES = [json.loads(line) for line in (FIXTURES / "cases.jsonl").read_text().splitlines()]
ENV = {
    "HOME": "$CWD/home",
    "USER": "robot",
    "PATH": "/usr/bin:/bin",
    "ROS_DISTRO": "rolling",
    "ROS_VERSION": "2",
}
_GIVEN = "-p x:=1"
_KINDS = {"lifecycle_node": "lifecycle"}


@pytest.mark.parametrize("number", range(len(CASES)))
def test_as_real_launch_has_it(number: int, tmp_path: Path) -> None:
    case = CASES[number]
    share = tmp_path / "src" / "gp"
    shutil.copytree(FIXTURES / "gp", share)
    (share / "launch").mkdir()
    for name, text in case["files"].items():
        (share / "launch" / name).write_text(text)
    main = next(name for name in case["files"] if name.startswith("main."))
    environment = detect_environment(None, ENV, (str(tmp_path / "src"),))
    workspace = Workspace(environment, Sources(), "/", CommandResults(lambda: "not in tests", "<command>"))
    analysis = workspace.static(str(share / "launch" / main), parse_ros2_arguments(case["args"]))
    told = dumps(tree_json(analysis.tree, analysis.documents, analysis.findings)).replace(str(share), "$SHARE")
    tree = json.loads(told)
    if "error" in case["answer"]:
        assert tree["errors"], case["answer"]["error"]
        return
    assert not tree["errors"]
    ours, real = _ours(tree), _launch(case["answer"])
    # launch hands it on as it is written (`ros_args`); to rcl alone it is a parameter, which only we have.
    if any(_GIVEN in text for text in case["files"].values()):
        values = [
            Counter(repr(node["params"].pop("x", None)) for node in of["nodes"] if node["params"])
            for of in (ours, real)
        ]
        assert set((values[0] - values[1]).elements()) <= {"1"}
        assert set((values[1] - values[0]).elements()) <= {"None"}
    assert ours == real


def _launch(answer: dict[str, Any]) -> dict[str, Any]:
    nodes = [
        {
            **node,
            "kind": _KINDS.get(node["kind"], node["kind"]),
            "package": node["package"] or "",
            "namespace": _ending(node["namespace"]),
            "arguments": " ".join(node["arguments"]).split(),
            # launch knows no parameters of a node without a name.
            "params": node["params"] if node["name"] else None,
        }
        for node in answer["nodes"]
    ]
    composable = [
        {**node, "name": _below(node["namespace"], node["name"]), "namespace": _ending(node["namespace"])}
        for node in answer["composable"]
    ]
    return {
        "nodes": _sorted(nodes),
        "composable": _sorted(composable),
        "processes": _sorted(answer["processes"]),
        "includes": sorted(answer["includes"]),
    }


def _ours(tree: dict[str, Any]) -> dict[str, Any]:
    nodes, composable, processes = [], [], []
    for node in tree["nodes"]:
        always = {"env": dict(node["env"]), "cwd": node["cwd"], "respawn": node["respawn"]}
        if node["kind"] == "process":
            prefix = shlex.split(node["launch_prefix"] or "")
            processes.append({"cmd": " ".join([*prefix, node["executable"], node["args"]]).split(), **always})
        elif node["kind"] == "composable":
            kept = ("container", "package", "plugin", "namespace", "remaps", "params")
            composable.append({**{key: node[key] for key in kept}, "name": node["name"]})
        else:
            kept = ("kind", "package", "executable", "namespace", "remaps", "name")
            params = node["params"] if node["name"] else None
            nodes.append(
                {**{key: node[key] for key in kept}, "arguments": node["args"].split(), "params": params, **always}
            )
    includes = sorted(tree["includes"])
    ours = {"nodes": _sorted(nodes), "composable": _sorted(composable), "processes": _sorted(processes)}
    return {**ours, "includes": includes}


def _ending(namespace: str | None) -> str:
    return (namespace or "").rstrip("/") + "/"


def _below(namespace: str | None, name: str | None) -> str | None:
    return _ending(namespace) + name if name else None


def _sorted(items: list[dict[str, Any]]) -> list[dict[str, Any]]:
    for item in items:
        if "cmd" in item:
            item["cmd"] = " ".join(item["cmd"]).split()
    return sorted(items, key=lambda item: json.dumps(item, sort_keys=True))


def test_the_tree_has_what_launch_reads_in_a_parameter_file(tmp_path: Path) -> None:
    """The rules go by what arrives at the node, which rcl's own YAML decides."""
    (tmp_path / "p.yaml").write_text("/**: {ros__parameters: {small: 1e-9, flag: y, plain: 1}}\n")
    launch = tmp_path / "a.launch.xml"
    launch.write_text('<launch><node pkg="p" exec="e" name="n"><param from="$(dirname)/p.yaml"/></node></launch>')
    analysis = Workspace(detect_environment(None, ENV, ()), Sources()).static(str(launch))
    (node,) = analysis.tree.nodes
    assert {p.name: p.value for p in node.params} == {"small": 1e-9, "flag": True, "plain": 1}
    shown = tree_json(analysis.tree, analysis.documents, ())
    assert shown["nodes"][0]["params"] == {"small": "1e-9", "flag": "y", "plain": 1}
