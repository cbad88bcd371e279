"""Rule, hover, `why` and the picture of the graph give one answer to one question about a topic or service."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

import pytest
from preflight_analysis.queries.hover import hover
from preflight_analysis.queries.parameters import parameter
from preflight_analysis.queries.why import chains
from preflight_analysis.view.model import graph_view
from preflight_analysis.workspace.workspace import Analysis
from support.query_harness import AtCursor, at_cursor

ROS1 = """
//- /main.launch
<launch>
  <node pkg="p" type="a" name="a"/>
  <node pkg="p" type="b" name="b"><remap$0 from="in" to="chatter"/></node>
</launch>
"""
SUM, OTHER_SUM = "a" * 32, "b" * 32
PUBLISHED = {"chatter": "x/Y"}


def analysed(text: str, interfaces: Mapping[str, Any]) -> AtCursor:
    return at_cursor(f"{text}\n//- interfaces\n{json.dumps(interfaces)}")


def rules_of(analysis: Analysis) -> set[str]:
    return {each.rule for each in analysis.findings}


def hovered(cursor: AtCursor) -> str:
    found = hover([cursor.analysis], cursor.file, cursor.offset)
    return found.markdown if found is not None else ""


def broken(analysis: Analysis, first: str, second: str) -> list[str]:
    assert analysis.graph is not None
    return [chain.broken.text for chain in chains(analysis, analysis.graph, first, second) if chain.broken is not None]


def in_picture(analysis: Analysis) -> dict[str, tuple[str, ...]]:
    """What the picture says of channels, by their names."""
    assert analysis.graph is not None
    view = graph_view(analysis.graph, analysis.findings, analysis.context)
    return {channel.name: channel.notes for channel in view.channels if channel.notes}


@pytest.mark.parametrize(
    ("published", "subscribed", "said"),
    [
        ({"publishers": {"chatter": "x/Y"}}, {"subscribers": {"in": "x/Z"}}, "/a uses x/Y, /b uses x/Z"),
        (
            {"publishers": {"chatter": "x/Y"}, "md5": {"chatter": SUM}},
            {"subscribers": {"in": "x/Y"}, "md5": {"in": OTHER_SUM}},
            f"/a uses x/Y, /b uses x/Y (different definitions, MD5 sums {SUM} and {OTHER_SUM})",
        ),
        ({"publishers": {"chatter": "tf/tfMessage"}}, {"subscribers": {"in": "tf2_msgs/TFMessage"}}, None),
        ({"publishers": {"chatter": "x/Y"}}, {"subscribers": {"in": "x/Y"}}, None),
    ],
    ids=["names", "definitions", "one definition in two packages", "the same"],
)
def test_whether_types_fit(published: Mapping[str, Any], subscribed: Mapping[str, Any], said: str | None) -> None:
    cursor = analysed(ROS1, {"/a": published, "/b": subscribed})
    text = f"types differ: {said}"
    assert ("TOP003" in rules_of(cursor.analysis)) == (said is not None)
    assert broken(cursor.analysis, "a", "b") == ([text] if said else [])
    assert (text in hovered(cursor).replace("\\_", "_")) == (said is not None)
    assert in_picture(cursor.analysis) == ({"/chatter": (text,)} if said else {})


def test_a_service_that_is_called_with_the_sum_of_its_server_fits_whatever_the_type_is_called() -> None:
    sums = {"md5": {"chatter": SUM, "in": SUM}}
    given = {"/a": {"services": {"chatter": "x/Y"}, **sums}, "/b": {"clients": {"in": "z/Y"}, **sums}}
    cursor = analysed(ROS1, given)
    assert "SRV002" not in rules_of(cursor.analysis)
    assert broken(cursor.analysis, "a", "b") == []
    assert "types differ" not in hovered(cursor)


def test_one_node_uses_a_topic_with_two_types() -> None:
    interfaces = {"/a": {"publishers": {"chatter": "x/Y", "/chatter": "x/Z"}}, "/b": {"subscribers": {"in": "*"}}}
    cursor = analysed(ROS1, interfaces)
    assert "TOP003" in rules_of(cursor.analysis)
    assert in_picture(cursor.analysis) == {"/chatter": ("/a publishes both x/Y and x/Z",)}
    assert "/a publishes both x/Y and x/Z" in hovered(cursor)


ROS2 = ROS1.replace("/main.launch", "/main.launch.xml").replace("type=", "exec=")


@pytest.mark.parametrize(("requested", "fits"), [("reliable", False), ("best_effort", True)])
def test_whether_qos_fits(requested: str, fits: bool) -> None:
    published = {"publishers": PUBLISHED, "qos": {"chatter": {"reliability": "best_effort"}}}
    subscribed = {"subscribers": {"in": "x/Y"}, "qos": {"in": {"reliability": requested}}}
    cursor = analysed(ROS2, {"/a": published, "/b": subscribed})
    text = "incompatible QoS: /a publishes best effort, /b requests reliable"
    assert ("QOS001" in rules_of(cursor.analysis)) != fits
    assert (text in hovered(cursor)) != fits
    assert in_picture(cursor.analysis) == ({} if fits else {"/chatter": (text,)})


def test_nobody_is_at_the_other_end() -> None:
    given = {"/a": {"publishers": {"chater": "x/Y"}}, "/b": {"subscribers": {"in": "x/Y"}}}
    cursor = analysed(ROS1, given)
    assert [each.candidates for each in cursor.analysis.findings if each.rule == "TOP001"] == [("/chater",)]
    assert "no publisher; did you mean '/chater' of /a?" in hovered(cursor)
    assert in_picture(cursor.analysis) == {
        "/chatter": ("no publisher; did you mean '/chater' of /a?",),
        "/chater": ("no subscriber; did you mean '/chatter' of /b?",),
    }


def test_the_only_one_of_its_type_has_another_name() -> None:
    given = {"/a": {"publishers": {"words": "x/Y"}}, "/b": {"subscribers": {"in": "x/Y"}}}
    cursor = analysed(ROS1, given)
    said = "no publisher; '/words' of /a has the same type and no subscriber"
    assert [each.message for each in cursor.analysis.findings if "has the same type" in each.message]
    assert said in hovered(cursor)
    assert said in in_picture(cursor.analysis)["/chatter"]


def test_the_other_end_is_in_another_domain() -> None:
    given = {"/a": {"publishers": PUBLISHED}, "/b": {"subscribers": {"in": "x/Y"}}}
    text = ROS2.replace('name="a"/>', 'name="a"><env name="ROS_DOMAIN_ID" value="5"/></node>')
    cursor = analysed(text, given)
    assert rules_of(cursor.analysis) == {"GRF001"}
    said = "ROS_DOMAIN_ID differs: /a has 5, /b has 0"
    assert f"no publisher; {said}" in hovered(cursor).replace("\\_", "_")
    assert [*in_picture(cursor.analysis).values()] == [(f"no subscriber; {said}",), (f"no publisher; {said}",)]


def test_an_image_that_is_read_in_another_transport() -> None:
    image, compressed = "sensor_msgs/Image", "sensor_msgs/CompressedImage"
    given = {
        "/a": {"publishers": {"chatter": image, "chatter/compressed": compressed}},
        "/b": {"subscribers": {"in": compressed}},
    }
    cursor = analysed(ROS1.replace('to="chatter"', 'to="chatter/compressed"'), given)
    assert "TOP002" not in rules_of(cursor.analysis)
    assert in_picture(cursor.analysis) == {"/chatter": ("no subscriber; it is read in another transport",)}


CROSSED = """
//- /main.launch
<launch>
  <group ns="one">
    <node pkg="p" type="sensor" name="sensor"/>
    <node pkg="p" type="monitor" name="monitor"><remap$0 from="level" to="/two/level"/></node>
  </group>
  <group ns="two">
    <node pkg="p" type="sensor" name="sensor"/>
    <node pkg="p" type="monitor" name="monitor"/>
  </group>
</launch>
"""


def test_a_subscriber_that_is_taken_to_the_topic_of_a_sibling() -> None:
    sensor, monitor = {"publishers": {"level": "x/Y"}}, {"subscribers": {"level": "x/Y"}}
    given = {
        f"/{each}/{name}": it for each in ("one", "two") for name, it in (("sensor", sensor), ("monitor", monitor))
    }
    cursor = analysed(CROSSED, given)
    assert [each.kind for each in cursor.analysis.findings if each.rule == "TOP002"] == ["near"]
    said = "nobody subscribes to '/one/level' of /one/sensor, the name of /one/monitor without its remap"
    assert said in hovered(cursor)
    assert in_picture(cursor.analysis) == {
        "/one/level": ("no subscriber; /one/monitor is remapped to '/two/level' of /two/sensor",),
        "/two/level": (said,),
    }
    assert broken(cursor.analysis, "/one/sensor", "/one/monitor") == [
        "'/one/level' and '/two/level' are different topic names"
    ]


LEAKED = """
//- /robot.launch.xml
<launch>
  <let name="x" value="1"/>
  <include file="/base.launch.xml"><arg name="params" value="/base.yaml"/></include>
  <include file="/nav.launch.xml"/>
</launch>
//- /base.launch.xml
<launch><arg name="params"/><node pkg="p" exec="base" name="base"><param from="$(var params)"/></node></launch>
//- /nav.launch.xml
<launch>
  <arg name="params" default="/nav.yaml"/>
  <node$0 pkg="p" exec="pilot" name="pilot"><param from="$(var params)"/></node>
</launch>
//- /base.yaml
base: {ros__parameters: {port: 1}}
//- /nav.yaml
pilot: {ros__parameters: {rate: 1}}
"""


def test_a_file_of_another_include() -> None:
    cursor = analysed(LEAKED, {"/pilot": {"params": {"rate": 5}}, "/base": {"params": {"port": 1}}})
    said = (
        "no section of this file applies to /pilot; it has sections for '/base'; the file is from 'params', which "
        "another include was passed and which stays set"
    )
    (finding,) = (each for each in cursor.analysis.findings if each.rule == "PRM011")
    assert finding.message.startswith(said)
    found = parameter(cursor.analysis, "/pilot:rate")
    assert found is not None
    assert [(each.used.path, each.reason) for each in found.lost] == [("/base.yaml", said)]
    assert f"`base.yaml`: {said}" in hovered(cursor)
    other = parameter(cursor.analysis, "/base:port")
    assert other is not None
    assert other.lost == ()


@pytest.mark.parametrize(
    ("lines", "rule", "what"),
    [
        ("pilot:\n  rate: 2", "PRM012", "parameter 'rate' is not below 'ros__parameters'"),
        (
            "pilot:\n  ros__parameters:\n    gains: [1, 2.5]",
            "PRM016",
            "a list with doubles and integers in it: 'gains'",
        ),
    ],
)
def test_a_file_that_rcl_refuses(lines: str, rule: str, what: str) -> None:
    text = f"""
//- /main.launch.xml
<launch><node pkg="p" exec="pilot" name="pilot"><param from="/pilot.yaml"/></node></launch>
//- /pilot.yaml
/**:
  ros__parameters:
    sp$0eed: 1
{lines}
"""
    cursor = analysed(text, {"/pilot": {"params": {"speed": 5}}})
    (finding,) = (each for each in cursor.analysis.findings if each.rule == rule)
    assert finding.message.startswith(what)
    found = parameter(cursor.analysis, "/pilot:speed")
    assert found is not None
    assert [each.what for each in found.refusals] == [what]
    assert f"rcl refuses the whole file: {what} ([" in hovered(cursor).replace("\\_", "_")


@pytest.mark.parametrize(
    ("interface", "name", "said"),
    [
        ({"params": {"rate": 1}}, "speed", " does not declare it"),
        ({"params": {"rate": 1}}, "ratee", " does not declare it; did you mean 'rate'?"),
        ({"params": {"rate": 1}}, "rate", None),
        ({"params": {"rate": 1}}, "use_sim_time", None),
        ({"params": {"rate": 1}}, "qos_overrides./tf.publisher.depth", None),
        ({"params": {"rate": 1, "/": {"access": "list"}}}, "speed", None),
        ({"params": {"rate": 1}, "status": "crashed"}, "speed", None),
        ({"publishers": {"a": "x/Y"}, "source": "catalogue", "status": "not-run"}, "speed", None),
        (
            {"params": {"rate": 1}, "source": "source", "status": "not-run"},
            "speed",
            " does not declare it (not sure: nodes of this launch were not analysed as a whole)",
        ),
    ],
)
def test_whether_a_node_declares_a_parameter(interface: Mapping[str, Any], name: str, said: str | None) -> None:
    text = f"""
//- /main.launch.xml
<launch><node pkg="p" exec="pilot" name="pilot"><param from="/pilot.yaml"/></node></launch>
//- /pilot.yaml
pilot:
  ros__parameters:
    {name[:2]}$0{name[2:]}: 1
"""
    cursor = analysed(text, {"/pilot": interface})
    assert ("PRM013" in rules_of(cursor.analysis)) == (said is not None)
    markdown = hovered(cursor)
    assert name in markdown.replace("\\_", "_")
    assert (" does not declare it" in markdown) == (said is not None)
    assert said is None or markdown.endswith(f"`/pilot`{said}")
