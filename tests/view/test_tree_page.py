"""The page of what a launch starts."""

from __future__ import annotations

from dataclasses import replace
from html.parser import HTMLParser
from typing import Any

from preflight_analysis.queries.node_tree import Item, NodeTree, node_tree
from preflight_analysis.rules.registry import run_rules
from preflight_analysis.view.tree_page import tree_page
from preflight_analysis.workspace.workspace import Analysis
from support import sample_graphs
from support.check import analyse, read_fixture


def robot() -> tuple[NodeTree, Any]:
    context = analyse(read_fixture(sample_graphs.ROBOT))
    analysis = Analysis(
        context.root,
        (),
        context.tree,
        context.documents,
        context.launch_files,
        context.environment,
        context,
    )
    found: dict[str, list[Any]] = {}
    for finding in run_rules(context):
        found.setdefault(finding.location.file, []).append(finding)
    return node_tree(analysis, found), context.documents


class Page(HTMLParser):
    def __init__(self, text: str) -> None:
        super().__init__()
        self.tags: list[tuple[str, tuple[str, ...]]] = []
        self.text = ""
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, tuple(name for name, _ in attrs)))

    def handle_data(self, data: str) -> None:
        self.text += data


def test_the_page_has_nodes_by_namespace_with_their_lines_and_files() -> None:
    tree, documents = robot()
    text = tree_page(tree, documents, "/")
    said = " ".join(Page(text).text.split())
    assert "robot.launchbase.launchnavigation.launch9 nodes" in said, "the legend"
    assert "driver p/camera.py · robot.launch:5:5" in said
    assert "slam p/slam.py · navigation.launch:2:3" in said
    assert "scan → scann" in said
    assert '<span class="count error" aria-label="2 findings, the worst is: error">2</span>' in text


def hostile(item: Item, text: str) -> Item:
    inside = tuple(hostile(child, text) for child in item.children)
    return replace(item, label=text, detail=text, name=text, children=inside)


def test_names_stay_texts() -> None:
    tree, documents = robot()
    harmless = Page(tree_page(tree, documents, None)).tags
    for text in sample_graphs.HOSTILE:
        files = tuple(f"{text}{i}" for i, _ in enumerate(tree.files))
        page = replace(tree, files=files, items=tuple(hostile(item, text) for item in tree.items))
        assert [tag for tag in Page(tree_page(page, documents, None)).tags if tag[0] not in ("svg", "rect")] == [
            tag for tag in harmless if tag[0] not in ("svg", "rect")
        ]


def test_a_launch_of_nothing() -> None:
    assert "0 nodes" in tree_page(NodeTree(("/empty.launch",), 0, ()), {}, None)
