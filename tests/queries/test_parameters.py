"""All places that set a parameter, the one that applies first."""

from __future__ import annotations

from typing import Any

import pytest
from preflight_analysis.findings.report import place
from preflight_analysis.queries.parameters import NoSuchParameterError, Parameter, parameters, section
from preflight_analysis.workspace.workspace import Analysis
from support.query_harness import at_cursor


def analysis_of(text: str) -> Analysis:
    return at_cursor(text).analysis


def shown(analysis: Analysis, found: Parameter) -> list[tuple[Any, str, str]]:
    return [
        (param.value, place(param.place, analysis.all_documents), section(analysis.tree, param))
        for param in found.settings
    ]


ROS1 = """//- /main.launch
<launch>
  <param name="/talker/rate" value="1"/>
  <node pkg="p" type="a" name="talker"><param name="rate" value="2"/></node>
  <include file="/more.launch"/>
</launch>
//- /more.launch
<launch><rosparam>{talker: {rate: 3}}</rosparam></launch>"""


@pytest.mark.parametrize("name", ["/talker/rate", "talker/rate", "rate"])
def test_the_last_setting_of_ros_1_applies(name: str) -> None:
    analysis = analysis_of(ROS1)
    (found,) = parameters(analysis, name)
    assert (found.name, found.node, found.own) == ("/talker/rate", "", "/talker/rate")
    assert [value for value, _, _ in shown(analysis, found)] == [3, 2, 1]
    assert [where.split(":")[0] for _, where, _ in shown(analysis, found)] == [
        "/more.launch",
        "/main.launch",
        "/main.launch",
    ]


ROS2 = """//- /main.launch.xml
<launch>
  <node pkg="p" exec="a" name="talker" namespace="robot">
    <param from="/params.yaml"/>
    <param name="rate" value="30"/>
  </node>
  <node pkg="p" exec="b" name="other" namespace="robot"><param name="rate" value="7"/></node>
</launch>
//- /params.yaml
/**:
  ros__parameters: {rate: 10}
/robot/talker:
  ros__parameters: {rate: 20}"""


@pytest.mark.parametrize("name", ["/robot/talker:rate", "talker:rate", "/robot/talker/rate", "talker/rate"])
def test_sections_of_a_parameter_file_of_ros_2(name: str) -> None:
    analysis = analysis_of(ROS2)
    (found,) = parameters(analysis, name)
    assert (found.node, found.own) == ("/robot/talker", "rate")
    values = {value: key for value, _, key in shown(analysis, found)}
    assert values[10] == "/**"
    assert values[20] == "/robot/talker"
    applied = next(param.value for param in analysis.tree.nodes[0].params if param.name == "rate")
    assert shown(analysis, found)[0][0] == applied


def test_the_last_part_of_a_name_means_all_nodes_that_have_it() -> None:
    assert [each.name for each in parameters(analysis_of(ROS2), "rate")] == ["/robot/other:rate", "/robot/talker:rate"]


UNKNOWN = """//- /main.launch.xml
<launch>
  <node pkg="p" exec="a" name="talker"><param from="$(command 'which params')"/></node>
  <node pkg="p" exec="b" name="other"><param name="rate" value="7"/></node>
</launch>"""


def test_a_parameter_file_that_is_not_known_may_set_it() -> None:
    analysis = analysis_of(UNKNOWN)
    talker, other = parameters(analysis, "use_sim_time")[::-1]
    assert talker.name == "/talker:use_sim_time"
    assert [place(each.location, analysis.all_documents) for each in talker.unknowns] == ["/main.launch.xml:2:53"]
    assert other.unknowns == ()


def test_a_section_with_the_name_of_a_node_that_has_none_here_may_set_it() -> None:
    unnamed = ROS2.replace('exec="a" name="talker" namespace="robot"', 'exec="a"')
    (found,) = parameters(analysis_of(unnamed), "/a:rate")
    assert [each.what for each in found.unknowns] == ["sections with the name of the node"]


ROS1_UNKNOWN = """//- /main.launch
<launch>
  <rosparam ns="talker" command="load" file="/not_here.yaml"/>
  <param name="/talker/rate" value="1"/>
  <param name="/other/rate" value="1"/>
</launch>"""


def test_a_file_of_ros_1_that_is_not_known_may_set_what_is_below_its_namespace() -> None:
    other, talker = parameters(analysis_of(ROS1_UNKNOWN), "rate")
    assert (len(talker.unknowns), len(other.unknowns)) == (1, 0)


@pytest.mark.parametrize(("text", "name"), [(ROS1, "/use_sim_time"), (ROS2, "/robot/talker:use_sim_time")])
def test_every_node_reads_whether_time_is_simulated(text: str, name: str) -> None:
    (found,) = parameters(analysis_of(text), name)
    assert [node for node, _ in found.uses] == [name.rpartition(":")[0] or "/talker"]
    assert (found.settings, found.declared and found.declared.default) == ((), False)


def test_near_names() -> None:
    with pytest.raises(NoSuchParameterError) as error:
        parameters(analysis_of(ROS2), "talker:rat")
    assert error.value.near == ("/robot/other:rate", "/robot/talker:rate")
    with pytest.raises(NoSuchParameterError) as error:
        parameters(analysis_of(ROS1), "/nothing/like/it")
    assert error.value.near == ()
