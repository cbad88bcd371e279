"""The formats that the graph is drawn in. Whatever the names are, they stay texts."""

from __future__ import annotations

import re
import subprocess
from collections import Counter
from html.parser import HTMLParser
from typing import Any

import pytest
from lxml import etree
from preflight_analysis.view.dot import dot
from preflight_analysis.view.graph_page import graph_page
from preflight_analysis.view.layout import lay_out
from preflight_analysis.view.mermaid import mermaid
from preflight_analysis.view.model import GraphView
from preflight_analysis.view.svg import outline, standalone_svg, svg
from support import sample_graphs

SVG = "{http://www.w3.org/2000/svg}"
VIEWS = {"robot": sample_graphs.robot(), "hostile": sample_graphs.hostile()}
views = pytest.mark.parametrize("view", VIEWS.values(), ids=VIEWS)


def parsed(view: GraphView) -> Any:
    return etree.fromstring(standalone_svg(view, lay_out(view), None).encode())


@views
def test_svg_is_well_formed_and_holds_nothing_that_runs(view: GraphView) -> None:
    root = parsed(view)
    found = list(root.iter())
    assert {element.tag for element in found} <= {
        f"{SVG}{name}" for name in ("svg", "style", "g", "rect", "path", "circle", "text")
    }
    for element in found:
        assert set(element.attrib) <= {
            *("class", "role", "aria-label", "width", "height", "viewBox", "transform", "data-node", "data-channel"),
            *("data-box", "data-route", "data-frame", "x", "y", "rx", "cx", "cy", "r", "d", "text-anchor"),
        }


@views
def test_svg_has_each_part_once(view: GraphView) -> None:
    root = parsed(view)
    for name, parts in (("data-node", view.nodes), ("data-channel", view.channels)):
        assert sorted(int(e.get(name)) for e in root.iter() if e.get(name)) == list(range(len(parts)))


def test_svg_tells_what_is_wrong() -> None:
    root = parsed(sample_graphs.robot())
    said = {e.get("aria-label"): e.get("class") for e in root.iter(f"{SVG}g") if e.get("aria-label")}
    assert "error" in said["topic /odom, error"].split()
    assert {"dangling", "warning"} <= set(said["topic /scann, warning"].split())
    assert {"unknown", "info"} <= set(said["node /recorder, info"].split())
    wrong = Counter(e.get("class") for e in root.iter(f"{SVG}g") if "error" in (e.get("class") or "").split())
    assert wrong == {"route topic error": 2, "channel topic error state-normal": 1, "route error": 1}


def test_a_page_draws_the_same_picture_with_a_style_of_its_own() -> None:
    view = sample_graphs.robot()
    assert "<style>" not in svg(view, lay_out(view))


def test_lines_have_round_corners_and_arrows() -> None:
    line, arrow = outline([(0, 0), (20, 0), (20, 40)])
    assert line == "M0 0L14 0Q20 0 20 6L20 33"
    assert arrow == "M20 40L16.5 33L23.5 33z"


@pytest.mark.ros
@views
def test_dot_is_what_graphviz_reads(view: GraphView) -> None:
    done = subprocess.run(
        ["dot", "-Tplain-ext"],
        input=dot(view),
        capture_output=True,
        text=True,
        encoding="utf-8",
        timeout=60,
        check=True,
    )
    assert done.stderr == ""
    kinds = Counter(line.split(" ", 1)[0] for line in done.stdout.splitlines())
    assert kinds["node"] == len(view.nodes) + len(view.channels)
    assert kinds["edge"] == len(view.edges)


def test_dot_shows_names_and_findings() -> None:
    text = dot(sample_graphs.robot())
    assert '[shape=box, style="rounded", label="/base", color="#667085"];' in text
    assert re.search(r'n0 -> c\d+ \[edgetooltip="nav_msgs/Odometry", color="#d1242f", tooltip="TOP003 ', text)


@views
def test_mermaid_keeps_to_its_syntax(view: GraphView) -> None:
    first, *lines = mermaid(view).splitlines()
    assert first == "flowchart LR"
    quoted = r'"(?:[\w /.:~,()\'-]|#\d+;)*"'
    node = rf"  n\d+\[{quoted}\]"
    channel = rf"  c\d+(?:\(\[{quoted}\]\)|\{{\{{{quoted}\}}\}}|\[/{quoted}/\])"
    edge = r"  (?:n\d+ -\.?-> c\d+|c\d+ -\.?-> n\d+)"
    style = r"  linkStyle \d+(?:,\d+)* stroke:#[0-9a-f]{6},stroke-width:2px"
    style += r"|  linkStyle \d+(?:,\d+)* stroke:#[0-9a-f]{6}"
    assert [line for line in lines if not re.fullmatch("|".join((node, channel, edge, style)), line)] == []
    assert sum(" --> " in line or " -.-> " in line for line in lines) == len(view.edges)


class _Page(HTMLParser):
    def __init__(self, text: str) -> None:
        super().__init__()
        self.found: Counter[str] = Counter()
        self.attributes: set[str] = set()
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.found[tag] += 1
        self.attributes |= {name for name, _ in attrs}


def test_the_page_is_the_same_whatever_the_names_are() -> None:
    harmless, hostile = (_Page(graph_page(view, None)) for view in VIEWS.values())
    assert hostile.found == harmless.found
    assert hostile.attributes == harmless.attributes
    assert not any(name.startswith("on") for name in hostile.attributes)


def test_the_page_fetches_nothing() -> None:
    text = graph_page(sample_graphs.robot(), None)
    policy = re.search(r'Content-Security-Policy" content="([^"]*)"', text)
    assert policy is not None
    assert policy[1].startswith("default-src 'none'; style-src 'sha256-")
    assert "unsafe" not in policy[1]
    assert not re.search(r'(?:src|href)\s*=\s*"', text)
    assert set(re.findall(r"https?://[^\s\"'\\]+", text)) == {"http://www.w3.org/2000/svg"}
