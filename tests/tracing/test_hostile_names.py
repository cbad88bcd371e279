"""Names that a node of rclpy makes up: parameters may have any, and what it lies about its topics any as well."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from pathlib import Path

import pytest
from fuzzing.targets import check_json, check_printable, check_report
from markdown_it import MarkdownIt
from preflight_analysis.findings.report import Report
from preflight_analysis.graph.graph_json import graph_json
from preflight_analysis.queries.hover import hover
from preflight_analysis.snapshot.files import from_yaml, to_yaml
from preflight_analysis.snapshot.make import snapshot_of
from preflight_analysis.view.dot import dot
from preflight_analysis.view.layout import lay_out
from preflight_analysis.view.mermaid import mermaid
from preflight_analysis.view.model import graph_view
from preflight_analysis.view.svg import standalone_svg
from support.ros2_harness import Ros2Harness, node_of

pytestmark = pytest.mark.ros

NAMES = (
    "clipboard\x1b]52;c;eA==\x07",
    "![x](http://example.org/x.png)",
    "[x](command:workbench.action.quit)",
    "<img src=x onerror=alert(1)>",
    "`` ` ``` \n# heading",
    "turned\u202efdp",
    "]]>--> */ %0A::error::x",
    "half\ud800",
    "x" * 100_000,
)
BODY = f"""
for name in {NAMES!r}:
    try:
        self.declare_parameter(name, name)
    except Exception as error:
        print(error)
events = os.open(os.environ["PREFLIGHT_EVENTS"], os.O_WRONLY)
for name in {NAMES!r}:
    for role in ("publisher", "subscriber", "service", "action_client"):
        record = {{"ev": "endpoint", "role": role, "name": name, "type": name, "node": name}}
        os.write(events, json.dumps(record).encode() + b"\\n")
self.create_publisher(String, "good", 10)
"""
MANY = """
for number in range(30000):
    self.declare_parameter("p%d" % number, number)
"""


def test_names_of_a_node_that_lies_drive_nothing(tmp_path: Path) -> None:
    harness = Ros2Harness(tmp_path, node=node_of(BODY, "import json, os"))
    analysis = harness.check("<node pkg='pkg' exec='node' name='n'/>")
    path = analysis.root
    assert analysis.graph is not None
    (interface, *_) = analysis.graph.interfaces
    assert "good" in {end.name for end in interface.endpoints}
    shown = {end.name for end in interface.endpoints} | {use.name for use in interface.params}
    assert "![x](http://example.org/x.png)" in shown, "it is what it is, and is shown as text"
    assert not any("\x1b" in name or "\ud800" in name or len(name) > 300 for name in shown)
    assert any("left out" in note for note in interface.notes), "and what is not shown is said"

    check_report(Report(analysis.findings, analysis.documents), str(tmp_path))
    check_json(graph_json(analysis.graph))
    text = analysis.documents[path].text
    found = hover([analysis], path, text.index("exec"), 0)
    assert found is not None
    _plain_markdown(found.markdown)
    view = graph_view(analysis.graph, analysis.findings, analysis.context)
    ET.fromstring(standalone_svg(view, lay_out(view), None))
    for picture in (dot(view), mermaid(view)):
        check_printable(picture)
    from_yaml(to_yaml(snapshot_of(analysis, analysis.graph)))


def _plain_markdown(markdown: str) -> None:
    """No picture, no HTML, no heading, and no link but to files."""
    for token in MarkdownIt().parse(markdown):
        assert token.type not in ("heading_open", "html_block"), token
        for child in token.children or ():
            assert child.type not in ("image", "html_inline"), child
            if child.type == "link_open":
                assert str(child.attrs["href"]).startswith("file:///"), child


def test_more_parameters_than_anybody_reads_are_bounded(tmp_path: Path) -> None:
    interface = Ros2Harness(tmp_path, node=node_of(MANY)).trace("node")
    assert 0 < len(interface.params) <= 5000
    assert any("left out" in note for note in interface.notes)
