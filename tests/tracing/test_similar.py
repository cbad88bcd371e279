"""Similar traces: what an executable does where it runs tells of a node that cannot be run."""

from __future__ import annotations

import json
import os
import shutil
import threading
import time
from dataclasses import replace
from pathlib import Path

import pytest
from preflight_analysis.environment.model import Package
from preflight_analysis.graph.graph_json import graph_json
from preflight_analysis.queries.hover import hover
from preflight_analysis.tracing.cache import TraceCache
from preflight_analysis.tracing.interface import Interface
from preflight_analysis.tracing.request import TraceRequest
from preflight_analysis.tracing.similar import SimilarTraces, asked
from preflight_analysis.tracing.trace import Tracer
from preflight_analysis.workspace.not_run import not_run
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Analysis, Workspace
from support.tracing_harness import environment, write_node

pytestmark = pytest.mark.ros

NODE = """
import sys, rospy
from std_msgs.msg import String
rospy.init_node("n")
rospy.Publisher("status", String, queue_size=1)
rospy.Publisher("~debug", String, queue_size=1)
rospy.Subscriber(sys.argv[1], String, print)
rospy.Subscriber(rospy.get_param("~input", "nothing"), String, print)
rospy.get_param("~model")
rospy.spin()
"""
WORKS = """
<launch>
  <node pkg="pkg" type="node.py" name="works" args="scan">
    <param name="model" value="m"/>
    <param name="input" value="/odom/raw"/>
  </node>
</launch>
"""
CRASHES = """
<launch>
  <group ns="robot"><node pkg="pkg" type="node.py" name="crashes" args="scan"/></group>
</launch>
"""


class Harness:
    """A package with one executable and a few launch files, with a cache of traces."""

    def __init__(self, folder: Path) -> None:
        self.package = folder / "pkg"
        (self.package / "launch").mkdir(parents=True)
        (self.package / "package.xml").write_text("<package><name>pkg</name></package>")
        self.script = write_node(self.package, NODE)
        os.utime(self.script, (1, 1))
        self.cache = TraceCache(folder / "cache")
        found = {"pkg": Package("pkg", str(self.package), str(self.package / "package.xml"))}
        self.environment = replace(
            environment(self.package), packages=found, workspace=str(folder), workspace_folders=(str(folder),)
        )
        self.tracer = Tracer(self.environment, self.cache)
        self.runs = 0

    def analyse(self, name: str, text: str, *, run: bool = True) -> Analysis:
        path = self.package / "launch" / name
        path.write_text(text.lstrip())
        similar = SimilarTraces(self.cache, self.environment)
        workspace = Workspace(self.environment, Sources(), str(self.package), similar=similar)
        static = workspace.static(str(path))
        interfaces = [
            self._trace(request) if run and request else not_run(node, workspace.executables, "not trusted")
            for node, request in zip(static.tree.nodes, workspace.requests(static), strict=True)
        ]
        return workspace.with_interfaces(static, interfaces, None if run else "not trusted")

    def _trace(self, request: TraceRequest) -> Interface:
        found = self.tracer.trace(request, threading.Event())
        self.runs += not found.cached
        return found


@pytest.fixture
def harness(tmp_path: Path) -> Harness:
    harness = Harness(tmp_path)
    first = interface(harness.analyse("works.launch", WORKS))
    assert (first.source, first.outcome.status) == ("trace", "spinning")
    return harness


def interface(analysis: Analysis) -> Interface:
    assert analysis.graph is not None
    return analysis.graph.interfaces[0]


def told(found: Interface) -> set[tuple[str, str]]:
    return {(e.role, e.name) for e in found.endpoints if not e.builtin}


def test_a_node_that_cannot_be_run_has_what_its_executable_does_elsewhere(harness: Harness) -> None:
    analysis = harness.analyse("crashes.launch", CRASHES, run=False)
    found = interface(analysis)
    assert found.source == "similar"
    assert not found.complete
    assert found.elsewhere is not None
    assert (found.elsewhere.node, found.elsewhere.changed) == ("/works", False)
    assert told(found) == {("publisher", "status"), ("publisher", "~debug"), ("subscriber", "scan")}
    assert all(e.evidence.source == "similar" and e.uncertain for e in found.endpoints)
    assert {p.name for p in found.params if not p.builtin} == {"~input", "~model"}
    assert analysis.graph is not None
    assert "/robot/status" in analysis.graph.topics
    assert "/robot/crashes/debug" in analysis.graph.topics
    (node,) = graph_json(analysis.graph)["nodes"]
    assert node["interface_source"] == "similar"
    assert next(p for p in node["publishers"] if p["name"] == "/robot/status")["similar"] is True


def test_what_a_crashed_node_made_itself_comes_first(harness: Harness) -> None:
    found = interface(harness.analyse("crashes.launch", CRASHES))
    assert (found.source, found.outcome.status) == ("similar", "crashed")
    assert ("subscriber", "nothing") in told(found), "made by itself, with the default"
    assert not any(
        e.evidence.source == "similar" for e in found.endpoints if e.name in ("status", "~debug", "scan", "nothing")
    )


WAITS = """
import rospy
from std_msgs.msg import String
rospy.init_node("n")
rospy.wait_for_service("start")
rospy.Publisher("status", String, queue_size=1)
rospy.spin()
"""


def test_a_run_that_is_not_complete_is_not_similar_to_itself(harness: Harness) -> None:
    write_node(harness.package, WAITS)
    for runs in (2, 2):
        found = interface(harness.analyse("waits.launch", WORKS))
        assert (found.source, found.elsewhere) == ("trace", None)
        assert found.outcome.answers
        assert harness.runs == runs


def test_names_of_the_other_configuration_are_left_out(harness: Harness) -> None:
    other = CRASHES.replace('args="scan"', 'args="points"')
    assert told(interface(harness.analyse("a.launch", other, run=False))) == {
        ("publisher", "status"),
        ("publisher", "~debug"),
    }
    same = CRASHES.replace("<group", '<param name="topic" value="/odom/raw"/><group')
    assert ("subscriber", "/odom/raw") in told(interface(harness.analyse("b.launch", same, run=False)))


def test_the_finding_is_weaker_than_that_of_a_run(harness: Harness) -> None:
    other = '<node pkg="pkg" type="node.py" name="unable" args="scann"/>'
    analysis = harness.analyse("crashes.launch", f"<launch>{other}</launch>", run=False)
    assert analysis.findings
    for finding in analysis.findings:
        assert finding.severity in ("info", "hint"), finding
        assert finding.rule == "TRC004" or finding.confidence != "certain"


def test_annotations_come_first_and_the_source_last(harness: Harness) -> None:
    annotated = CRASHES.replace("/></group>", '><topics><topic name="a" class="pub"/></topics></node></group>')
    assert interface(harness.analyse("a.launch", annotated, run=False)).source == "annotation"
    empty = TraceCache(harness.package / "other_cache")
    harness.cache = empty
    assert interface(harness.analyse("b.launch", CRASHES, run=False)).source == "source"


def test_an_older_build_is_similar_and_said_to_be_one(harness: Harness) -> None:
    harness.script.write_text(NODE.replace("status", "state"))
    found = interface(harness.analyse("crashes.launch", CRASHES, run=False))
    assert ("publisher", "status") in told(found)
    assert found.elsewhere is not None
    assert found.elsewhere.changed


def test_the_present_build_is_more_similar(harness: Harness) -> None:
    harness.script.write_text("#!/usr/bin/env python3\n" + NODE.replace("status", "state"))
    past = time.time() - 100
    os.utime(harness.script, (past, past))
    assert interface(harness.analyse("works.launch", WORKS)).source == "trace"
    found = interface(harness.analyse("crashes.launch", CRASHES, run=False))
    assert ("publisher", "state") in told(found)
    assert ("publisher", "status") not in told(found)


def test_an_executable_that_is_gone_has_what_it_did_when_it_was_there(harness: Harness) -> None:
    harness.script.unlink()
    found = interface(harness.analyse("crashes.launch", CRASHES, run=False))
    assert found.source == "similar"
    assert found.outcome.status == "not-run"


def test_another_executable_of_the_same_name_is_none(harness: Harness) -> None:
    other = harness.package / "scripts"
    other.mkdir()
    harness.script.rename(other / "node.py")
    write_node(other, "import rospy\n")
    assert interface(harness.analyse("crashes.launch", CRASHES, run=False)).source != "similar"


def test_an_entry_of_the_wrong_shape_is_none(harness: Harness) -> None:
    import hashlib

    (path,) = harness.cache.folder.glob("*/*/*.json")
    entry = json.loads(path.read_bytes().partition(b"\n")[2])
    made = entry["made"]
    for changed in (
        {"made": None},
        {"made": made | {"args": 1}},
        {"made": made | {"executable": "/other"}},
        {"interface": {}},
        {"dependencies": {}},
        {"schema": "ros-preflight/trace-cache/2"},
    ):
        data = json.dumps(entry | changed).encode()
        path.write_bytes(hashlib.sha256(data).hexdigest().encode() + b"\n" + data)
        assert interface(harness.analyse("crashes.launch", CRASHES, run=False)).source == "source", changed


def test_hover_says_where_it_comes_from(harness: Harness) -> None:
    analysis = harness.analyse("crashes.launch", CRASHES, run=False)
    text = analysis.documents[analysis.root].text
    found = hover([analysis], analysis.root, text.index("<node"))
    assert found is not None
    assert "from a run of the same executable elsewhere, that of `/works` in `pkg/launch/works.launch`" in (
        found.markdown
    )
    assert "not trusted" in found.markdown


def test_a_configuration_with_a_secret_leaves_no_more_than_names(harness: Harness) -> None:
    secret = WORKS.replace('value="m"', 'value="hunter2"')
    harness.analyse("works.launch", secret)
    for path in harness.cache.folder.glob("*/*/*.json"):
        assert b"hunter2" not in path.read_bytes()


def test_a_run_that_ended_without_doing_anything_says_nothing(harness: Harness) -> None:
    usage = "import sys, rospy\nrospy.init_node('n')\nif 'help' in sys.argv: sys.exit(0)\n"
    harness.script.write_text("#!/usr/bin/env python3\n" + usage + NODE)
    past = time.time() - 100
    os.utime(harness.script, (past, past))
    helped = harness.analyse("help.launch", CRASHES.replace('args="scan"', 'args="help"'))
    assert interface(helped).outcome.status == "exited"
    found = interface(harness.analyse("crashes.launch", CRASHES, run=False))
    assert (found.source, found.elsewhere and found.elsewhere.node) == ("similar", "/works"), "the older build's"


def test_what_ros_1_has_by_that_name_tells_nothing_of_ros_2(harness: Harness) -> None:
    harness.analyse("works.launch", WORKS)
    harness.script.unlink()
    (node,) = harness.analyse("works.launch", WORKS, run=False).tree.nodes
    similar = SimilarTraces(harness.cache, harness.environment)
    assert similar.each([asked(node, 1)], {})[0] is not None
    assert similar.each([asked(node, 2)], {})[0] is None


def test_what_is_remembered_of_runs_is_as_the_cache_has_it(harness: Harness) -> None:
    (node,) = harness.analyse("works.launch", WORKS).tree.nodes
    similar = SimilarTraces(harness.cache, harness.environment, Sources())
    first = similar.each([asked(node, 1)], {})[0]
    assert first is not None
    assert similar.each([asked(node, 1)], {})[0] is first
    shutil.rmtree(harness.cache.folder)
    similar.look()
    assert similar.each([asked(node, 1)], {})[0] is None
    harness.tracer = Tracer(harness.environment, harness.cache)
    harness.analyse("works.launch", WORKS)
    similar.look()
    again = similar.each([asked(node, 1)], {})[0]
    assert again is not None
    assert told(again) == told(first)


@pytest.mark.parametrize("built", [True, False])
def test_another_workspace_tells_nothing(harness: Harness, tmp_path: Path, built: bool) -> None:
    """Its package has the same name, its executable the same content, and beside it a module that lies."""
    hostile = Harness(tmp_path / "hostile")
    hostile.cache = harness.cache = TraceCache(tmp_path / "shared")
    hostile.tracer = Tracer(hostile.environment, hostile.cache)
    (hostile.package / "rospy").mkdir()
    (hostile.package / "rospy/__init__.py").write_text(
        "import sys; sys.path.remove(sys.path[0]); del sys.modules['rospy']; import rospy\n"
        "from std_msgs.msg import String\nmade = rospy.init_node\n"
        "def init_node(*a, **k):\n    made(*a, **k)\n    rospy.Publisher('/lies', String, queue_size=1)\n"
        "rospy.init_node = init_node\nsys.modules['rospy'] = rospy\n"
    )
    lied = interface(hostile.analyse("works.launch", WORKS))
    assert ("publisher", "/lies") in told(lied)
    again = interface(hostile.analyse("crashes.launch", CRASHES, run=False))
    assert ("publisher", "/lies") in told(again), "where it was made it is similar"
    assert hostile.script.read_bytes() == harness.script.read_bytes()
    if not built:
        harness.script.unlink()
    found = interface(harness.analyse("crashes.launch", CRASHES, run=False))
    assert (found.source, found.elsewhere) == ("source" if built else "none", None)


def test_a_run_for_another_workspace_is_another(harness: Harness) -> None:
    """A launch file can give a node of the system all variables that it has elsewhere. What it lacks in a sandbox that
    shows other files must not count there."""
    elsewhere = replace(harness.environment, workspace_folders=("/elsewhere",))
    asked = TraceRequest("/n", "pkg", str(harness.script))
    first = Tracer(elsewhere, harness.cache).trace(asked, threading.Event())
    assert Tracer(elsewhere, harness.cache).lookup(asked) is not None, first
    assert Tracer(harness.environment, harness.cache).lookup(asked) is None
