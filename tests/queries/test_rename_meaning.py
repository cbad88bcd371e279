"""A rename changes nothing but the name: the same is started before and after, in each of the cases of meaning."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from preflight_analysis.documents.span import Span
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.problems import DuplicateNode
from preflight_analysis.evaluation.tree import LaunchTree
from preflight_analysis.findings.finding import Edit
from preflight_analysis.queries.query_context import QueryContext
from preflight_analysis.queries.rename import RenameRefusedError, rename
from preflight_analysis.workspace.indexing import build_index
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace
from support.editor_harness import ROOT
from support.meaning_harness import write_case

CASES = sorted((ROOT / "fixtures/ros1/meaning").glob("*.txt"))
NEW = "zz_renamed"


def workspace_of(case: Path, folder: Path) -> tuple[Workspace, str]:
    job = write_case(case.read_bytes().decode(), folder)
    environment = detect_environment(None, dict(job.env), package_path=job.package_path)
    return Workspace(environment, Sources(), "/"), job.file


def renames(workspace: Workspace, folder: Path, kind: str) -> Iterator[tuple[str, str, Span, tuple[Edit, ...]]]:
    """Each declaration of an argument, or each node: its file, name and place, and what renames it."""
    index = build_index(workspace, str(folder))
    assert index is not None
    for path, facts in index.files.items():
        analyses = tuple(workspace.static(root.path) for root in index.roots_of(path))
        for mention in (m for m in facts.mentions if m.kind == kind):
            try:
                edits = rename(QueryContext(path, analyses, index, workspace), mention.span.start, NEW)
            except RenameRefusedError:
                continue
            yield path, mention.name, mention.span, edits


def after(workspace: Workspace, root: str, edits: tuple[Edit, ...]) -> LaunchTree:
    """What is started with the edits made in the editor."""
    texts: dict[str, str] = {}
    for edit in sorted(edits, key=lambda e: e.location.span, reverse=True):
        path, span = edit.location.file, edit.location.span
        found = workspace.sources.text(path)
        text = texts.get(path) or getattr(found, "text")  # noqa: B009 - it is there, or the test fails
        texts[path] = text[: span.start] + edit.text + text[span.end :]
    for path, text in texts.items():
        workspace.sources.open(path, text)
    tree = workspace.tree(root, {})
    for path in texts:
        workspace.sources.close(path)
    return tree


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


def test_arguments(tmp_path: Path) -> None:
    done = 0
    for case in CASES:
        folder = tmp_path / case.stem
        workspace, root = workspace_of(case, folder)
        before = started(workspace.tree(root, {}), {})
        for path, name, _, edits in renames(workspace, folder, "arg-declaration"):
            # A value that is not known keeps the text of its substitutions.
            now = repr(started(after(workspace, root, edits), {})).replace(NEW, name)
            assert now.replace(name, "_") == repr(before).replace(name, "_"), (case.name, path, name)
            done += 1
    assert done > 20


def test_nodes(tmp_path: Path) -> None:
    done = 0
    for case in CASES:
        folder = tmp_path / case.stem
        workspace, root = workspace_of(case, folder)
        before = workspace.tree(root, {})
        for path, name, span, edits in renames(workspace, folder, "node"):
            own = [n for n in before.nodes if n.location.file == path and n.action.span.contains(span.start)]
            if not own or any(not names.is_legal(node.name) for node in own):
                continue
            if any(isinstance(problem.kind, DuplicateNode) for problem in before.problems):
                continue  # the rename mends it
            new = {node.name: names.parent(node.name) + NEW for node in own}
            now = after(workspace, root, edits)
            assert started(now, {}) == started(before, new), (case.name, path, name)
            done += 1
    assert done > 20
