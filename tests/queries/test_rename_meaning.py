"""A rename changes nothing but the name: the same is started before and after, in each of the cases of meaning."""

from __future__ import annotations

import json
import os
import re
import shutil
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from preflight_analysis.edits.edit import Edit
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.problems import DuplicateNode
from preflight_analysis.evaluation.tree import LaunchTree
from preflight_analysis.model.entry import Kind, Mention
from preflight_analysis.queries.query_context import QueryContext
from preflight_analysis.queries.rename import RenameRefusedError, rename
from preflight_analysis.workspace.commands import CommandResults
from preflight_analysis.workspace.index import Root, WorkspaceIndex
from preflight_analysis.workspace.indexing import build_index
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace
from support.editor_harness import ROOT
from support.meaning_harness import write_case

CASES = sorted((ROOT / "fixtures/ros1/meaning").glob("*.txt"))
ROS2 = ROOT / "fixtures/ros2/meaning"
ROS2_CASES = [json.loads(line) for line in (ROS2 / "cases.jsonl").read_text().splitlines()]
ROS2_INCLUDING = [case for case in ROS2_CASES if len(case["files"]) > 1]
NEW = "zz_renamed"


def workspace_of(case: Path, folder: Path) -> tuple[Workspace, str]:
    job = write_case(case.read_bytes().decode(), folder)
    environment = detect_environment(None, dict(job.env), package_path=job.package_path)
    return Workspace(environment, Sources(), "/"), job.file


def workspace_of_ros2(case: Mapping[str, Any], folder: Path) -> Workspace:
    share = folder / "src" / "gp"
    shutil.copytree(ROS2, folder / "src", ignore=shutil.ignore_patterns("*.jsonl", "*.md"))
    (share / "launch").mkdir()
    for name, text in case["files"].items():
        (share / "launch" / name).write_text(text)
    variables = {"HOME": "/home/robot", "USER": "robot", "PATH": "/usr/bin:/bin", "ROS_VERSION": "2"}
    environment = detect_environment(None, {**variables, "ROS_DISTRO": "rolling"}, (str(folder / "src"),))
    return Workspace(environment, Sources(), "/", CommandResults(lambda: "not in tests", "<command>"))


def index_of(workspace: Workspace, folder: Path) -> WorkspaceIndex:
    index = build_index(workspace, str(folder))
    assert index is not None
    return index


def renames(
    workspace: Workspace, index: WorkspaceIndex, *kinds: Kind
) -> Iterator[tuple[str, Mention, tuple[Edit, ...]]]:
    """Each mention of these kinds: its file, itself, and what renames it."""
    for path, facts in index.files.items():
        for mention in (m for m in facts.mentions if m.entry.kind in kinds):
            analyses = tuple(workspace.static(root.path, dict(root.args)) for root in index.roots_of(path))
            try:
                edits = rename(QueryContext(path, analyses, index, workspace), mention.span.start, NEW)
            except RenameRefusedError:
                continue
            yield path, mention, edits


def after(workspace: Workspace, roots: tuple[Root, ...], edits: tuple[Edit, ...]) -> list[LaunchTree]:
    """What is started with the edits made in the editor."""
    texts: dict[str, str] = {}
    for edit in sorted(edits, key=lambda e: e.location.span, reverse=True):
        path, span = edit.location.file, edit.location.span
        found = workspace.sources.text(path)
        text = texts.get(path) or getattr(found, "text")  # noqa: B009 - it is there, or the test fails
        texts[path] = text[: span.start] + edit.text + text[span.end :]
    for path, text in texts.items():
        workspace.sources.open(path, text)
    trees = [workspace.tree(root.path, dict(root.args)) for root in roots]
    for path in texts:
        workspace.sources.close(path)
    return trees


def started(tree: LaunchTree, renamed: Mapping[str, str]) -> dict[str, Any]:
    """What a launch comes to, with nodes and what is named below them under the names of `renamed`."""

    def new(name: str) -> str:
        found = next((old for old in renamed if name == old or name.startswith(f"{old}/")), None)
        return name if found is None else renamed[found] + name[len(found) :]

    return {
        "nodes": [
            (
                new(node.name),
                node.namespace,
                (node.package, node.executable, node.env, node.machine, node.args.replace(NEW, "_")),
                [(param.name, repr(param.value)) for param in node.params],
                new(node.container) if node.container else None,
                sorted(
                    (new(names.resolve(r.source, node.name)), new(names.resolve(r.target, node.name)))
                    for r in node.remaps
                ),
            )
            for node in tree.nodes
        ],
        "params": sorted((new(name), repr(param.value)) for name, param in tree.params.items()),
        "problems": sorted(
            (type(p.kind).__name__, os.path.basename(p.location.file)) for p in tree.problems if p.fatal
        ),
        "includes": [include.path for include in tree.includes],
    }


def without(name: str, trees: list[LaunchTree]) -> str:
    """What launches come to, whatever an argument is called: a value that is not known keeps its substitutions."""
    return repr([started(tree, {}) for tree in trees]).replace(NEW, "_").replace(name, "_")


def test_arguments(tmp_path: Path) -> None:
    done = 0
    for case in CASES:
        workspace, _ = workspace_of(case, tmp_path / case.stem)
        index = index_of(workspace, tmp_path / case.stem)
        roots = tuple(index.entries)
        before = after(workspace, roots, ())
        for path, mention, edits in renames(workspace, index, "argument"):
            now = after(workspace, roots, edits)
            assert without(mention.entry.text, now) == without(mention.entry.text, before), (case.name, path, mention)
            done += 1
    assert done > 60


def test_arguments_of_ros2(tmp_path: Path) -> None:
    done = 0
    for number, case in enumerate(ROS2_INCLUDING):
        folder = tmp_path / str(number)
        workspace = workspace_of_ros2(case, folder)
        index = index_of(workspace, folder)
        roots = tuple(index.entries)
        before = after(workspace, roots, ())
        for path, mention, edits in renames(workspace, index, "argument"):
            now = after(workspace, roots, edits)
            assert without(mention.entry.text, now) == without(mention.entry.text, before), (
                number,
                path,
                mention,
                edits,
            )
            done += 1
    assert done > 100


def test_nodes(tmp_path: Path) -> None:
    done = 0
    for case in CASES:
        workspace, _ = workspace_of(case, tmp_path / case.stem)
        done += nodes_renamed(workspace, index_of(workspace, tmp_path / case.stem), case.name)
    assert done > 20


def test_nodes_of_ros2(tmp_path: Path) -> None:
    done = 0
    for number, case in enumerate(ROS2_INCLUDING):
        workspace = workspace_of_ros2(case, tmp_path / str(number))
        done += nodes_renamed(workspace, index_of(workspace, tmp_path / str(number)), str(number))
    assert done > 20


def nodes_renamed(workspace: Workspace, index: WorkspaceIndex, case: str) -> int:
    """How many renames of nodes changed nothing else."""
    done, roots = 0, tuple(index.entries)
    before = after(workspace, roots, ())
    for path, mention, edits in renames(workspace, index, "node"):
        if not mention.entry.text.isidentifier():
            continue  # the rename mends it
        tags = {(e.location.file, e.location.span.start) for e in edits}
        for was, now in zip(before, after(workspace, roots, edits), strict=True):
            if any(isinstance(problem.kind, DuplicateNode) for problem in was.problems):
                continue  # the rename mends it
            spans = [(n, n.tag.span_of(attribute)) for n in was.nodes for attribute in ("name", "test-name")]
            own = [n for n, span in spans if span is not None and (n.location.file, span.start) in tags]
            own = [n for n in own if names.leaf(n.name) == mention.entry.text and names.is_legal(n.name)]
            new = {node.name: names.parent(node.name) + NEW for node in own}
            assert started(now, {}) == started(was, new), (case, path, mention, edits)
            done += bool(own)
    return done


def renamed_back(tree: LaunchTree, leaf: str) -> dict[str, Any]:
    """What a launch comes to, with parameters under the name from before."""
    found = started(tree, {})
    params = sorted((name.replace(NEW, leaf), value) for name, value in found["params"])
    nodes = [
        (*node[:3], [(name.replace(NEW, leaf), value) for name, value in node[3]], *node[4:]) for node in found["nodes"]
    ]
    return {**found, "params": params, "nodes": nodes}


def params_renamed(workspace: Workspace, index: WorkspaceIndex, case: str) -> int:
    """How many renames of parameters changed nothing else."""
    done, roots = 0, tuple(index.entries)
    before = after(workspace, roots, ())
    for path, mention, edits in renames(workspace, index, "parameter"):
        leaf = re.split(r"[/~.]", mention.entry.text)[-1]
        for was, now in zip(before, after(workspace, roots, edits), strict=True):
            assert renamed_back(now, leaf) == renamed_back(was, leaf), (case, path, mention, edits)
            done += 1
    return done


def test_parameters(tmp_path: Path) -> None:
    done = 0
    for case in CASES:
        workspace, _ = workspace_of(case, tmp_path / case.stem)
        done += params_renamed(workspace, index_of(workspace, tmp_path / case.stem), case.name)
    assert done > 50


def test_parameters_of_ros2(tmp_path: Path) -> None:
    done = 0
    for number, case in enumerate(ROS2_INCLUDING):
        workspace = workspace_of_ros2(case, tmp_path / str(number))
        done += params_renamed(workspace, index_of(workspace, tmp_path / str(number)), str(number))
    assert done > 50
