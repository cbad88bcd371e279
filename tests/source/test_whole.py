"""Whether the source of a node tells all that it does, and what follows from that."""

from __future__ import annotations

import textwrap
from pathlib import Path

import pytest
from preflight_analysis.findings.finding import Finding
from preflight_analysis.source.analyse import SourceInterface
from preflight_analysis.workspace.not_run import not_run
from preflight_analysis.workspace.workspace import Workspace
from support.source_harness import SourceHarness

ROSPY = """\
#!/usr/bin/env python3
import sys
import numpy
import rospy
from std_msgs.msg import String
rospy.init_node("n")
rate = rospy.get_param("~rate", 10)
"""
ROSCPP = """\
#include <ros/ros.h>
#include <std_msgs/String.h>
#include <opencv2/core.hpp>
{includes}
int main(int argc, char** argv) {{
  ros::init(argc, argv, "n");
  ros::NodeHandle nh;
  nh.advertise<std_msgs::String>("chatter", 1);
  {body}
  ros::spin();
}}
"""


@pytest.fixture
def harness(tmp_path: Path) -> SourceHarness:
    return SourceHarness(tmp_path)


def _script(harness: SourceHarness, name: str, body: str) -> None:
    harness.write(name, ROSPY + textwrap.dedent(body)).chmod(0o755)


def _read(harness: SourceHarness, body: str) -> SourceInterface:
    _script(harness, "t", body)
    found = harness.again()
    assert found is not None
    return found


def _findings(harness: SourceHarness, launch: str) -> dict[str, Finding]:
    path = harness.write("main.launch", f"<launch>{launch}</launch>")
    harness.sources.look()
    workspace = Workspace(harness.environment, harness.sources, str(harness.folder))
    analysis = workspace.static(str(path))
    interfaces = [not_run(node, workspace.executables) for node in analysis.tree.nodes]
    done = workspace.with_interfaces(analysis, interfaces, None)
    return {finding.rule: finding for finding in done.findings}


@pytest.mark.parametrize(
    "body",
    [
        'rospy.Publisher("chatter", String, queue_size=numpy.int32(1))',
        'for name in ("a", "b"):\n    rospy.Publisher(name, String)',
        "class Node:\n    def __init__(self):\n        rospy.Publisher('a', String)\nNode()",
        "class One:\n    def __new__(cls):\n        return super().__new__(cls)\nOne()",
    ],
)
def test_all_is_told(harness: SourceHarness, body: str) -> None:
    assert _read(harness, body).whole


@pytest.mark.parametrize(
    "body",
    [
        "rospy.Publisher(open('name').read(), String)",
        "rospy.get_param('~' + sys.stdin.readline())",
        "import helpers\nhelpers.set_up()",
        "def f(n):\n    rospy.Publisher(f'a{n}', String)\n" + "\n".join(f"f({n})" for n in range(50)),
        "class Later:\n    def __new__(cls, *args):\n        return Maker(cls, args)\nLater(1)",
    ],
    ids=[
        "a name that is computed",
        "a parameter that is computed",
        "an unknown library",
        "more than is gone through",
        "a class that makes something else",
    ],
)
def test_there_may_be_more(harness: SourceHarness, body: str) -> None:
    assert not _read(harness, body).whole


@pytest.mark.parametrize(
    ("includes", "body", "whole"),
    [
        ("", 'double rate; nh.param("rate", rate, 1.0);', True),
        ("#include <arm_msgs/Pose.h>", "tf::TransformListener listener(nh);", True),
        ("#include <arm_driver/driver.h>", "arm::Driver driver;", False),
        ("", "make_more(nh);", False),
        ("", "nh.advertise<std_msgs::String>(argv[1], 1);", False),
    ],
)
def test_all_that_cpp_tells(harness: SourceHarness, includes: str, body: str, whole: bool) -> None:
    harness.write("CMakeLists.txt", "project(p)\nadd_executable(t src/t.cpp)\n")
    harness.write("src/t.cpp", ROSCPP.format(includes=includes, body=body))
    found = harness.again()
    assert found is not None and found.whole is whole


def test_a_parameter_that_the_source_does_not_read(harness: SourceHarness) -> None:
    _script(harness, "t", "rospy.Publisher('chatter', String)")
    node = '<node pkg="p" type="t" name="n"><param name="{}" value="5"/></node>'
    found = _findings(harness, node.format("raet"))["PRM001"]
    assert (found.severity, found.confidence) == ("warning", "likely")
    assert "did you mean '/n/rate'" in found.message
    found = _findings(harness, node.format("other"))["PRM001"]
    assert (found.severity, found.message) == (
        "hint", "unused parameter '/n/other': not read by /n in its source, nor by any other node",
    )  # fmt: skip
    _script(harness, "t", "import helpers\nhelpers.set_up()")
    found = _findings(harness, node.format("raet"))["PRM001"]
    assert (found.severity, found.confidence) == ("warning", "possible")
    assert "PRM001" not in _findings(harness, node.format("other"))


def test_a_remap_of_a_name_that_the_source_does_not_use(harness: SourceHarness) -> None:
    _script(harness, "talk", "rospy.Publisher('chatter', String)")
    _script(harness, "hear", "rospy.Subscriber('input', String, print)")
    nodes = (
        '<node pkg="p" type="talk" name="talk"/>'
        '<node pkg="p" type="hear" name="hear"><remap from="inputs" to="chatter"/></node>'
    )
    found = _findings(harness, nodes)["TOP004"]
    assert (found.severity, found.confidence) == ("warning", "likely")
    assert "did you mean 'input'" in found.message
    _script(harness, "hear", "import helpers\nhelpers.set_up()\nrospy.Subscriber('input', String, print)")
    assert "TOP004" not in _findings(harness, nodes)


def test_what_a_condition_decides_is_not_sure(harness: SourceHarness) -> None:
    """Two ends that nobody else uses speak for each other; where another node has the provider, a guess is a guess."""
    _script(harness, "talk", "rospy.Publisher('chatter', String)")
    nodes = '<node pkg="p" type="talk" name="talk"/><node pkg="p" type="hear" name="hear"/>'
    _script(harness, "hear", "rospy.Subscriber('chater', String, print)")
    assert _findings(harness, nodes)["TOP001"].severity == "warning"
    _script(harness, "hear", "if len(sys.stdin.read()) > 3:\n    rospy.Subscriber('chater', String, print)")
    found = _findings(harness, nodes)["TOP001"]
    assert (found.severity, found.confidence) == ("warning", "possible")
    _script(harness, "other", "rospy.Subscriber('chatter', String, print)")
    assert _findings(harness, nodes + '<node pkg="p" type="other" name="other"/>')["TOP001"].severity == "info"


@pytest.mark.parametrize(
    ("talk", "hear", "severity"),
    [
        ("rospy.Publisher(sys.stdin.readline(), String)", "", "info"),
        ("rospy.Publisher(sys.stdin.readline(), rospy.AnyMsg)", "", "info"),
        ("", "rospy.Subscriber(sys.stdin.readline(), String, print)", "info"),
        ("rospy.Subscriber(sys.stdin.readline(), String, print)", "", "warning"),
        ("rospy.get_param(sys.stdin.readline())", "", "warning"),
    ],
)
def test_another_end_whose_name_is_computed_may_be_the_right_one(
    harness: SourceHarness, talk: str, hear: str, severity: str
) -> None:
    _script(harness, "talk", f"rospy.Publisher('chatter', String)\n{talk}")
    _script(harness, "hear", f"rospy.Subscriber('chater', String, print)\n{hear}")
    nodes = '<node pkg="p" type="talk" name="talk"/><node pkg="p" type="hear" name="hear"/>'
    found = _findings(harness, nodes)["TOP001"]
    assert (found.severity, found.confidence) == (severity, "possible")
