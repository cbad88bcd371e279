"""One finding for what is said of several nodes at one place."""

from __future__ import annotations

from preflight_analysis.documents.span import Location
from preflight_analysis.findings.claim import say
from preflight_analysis.findings.finding import EndpointRef, Finding, Severity
from preflight_analysis.rules.registry import unique
from support.check import findings_of

PLACE = Location.of_file("/a.launch")


def claimed(template: str, severity: Severity = "warning", **values: str) -> Finding:
    text, end = say(template, **values), EndpointRef("topic", "/t", values["node"])
    return Finding("ABC001", "n", severity, "certain", str(text), PLACE, endpoints=(end,), text=text)


def test_the_same_of_several_nodes_is_said_once_with_their_number() -> None:
    bases = [(f"/robot{n}/base", f"/robot{n}/speed") for n in (1, 2, 3)]
    one, two, three = (claimed("{node} ignores '{name}'", node=node, name=name) for node, name in bases)
    (found,) = unique([one, two, three])
    assert found.message == "/robot1/base and 2 more ignores '/robot1/speed'"
    assert [each.message for each in found.related] == [f"also: {two.message}", f"also: {three.message}"]
    assert [end.node for end in found.endpoints] == ["/robot1/base", "/robot2/base", "/robot3/base"]


def test_the_number_stands_behind_the_name_of_the_node_alone() -> None:
    said = "'{name}' is a text, but {node} reads a number"
    (found,) = unique([claimed(said, name=f"/{n}/base/speed", node=f"/{n}/base") for n in "ab"])
    assert found.message == "'/a/base/speed' is a text, but /a/base and 1 more reads a number"


def test_something_else_of_another_node_stays_a_finding() -> None:
    said = "{node} ignores '{name}'"
    given = [claimed(said, node="/robot1/base", name="speed"), claimed(said, node="/robot2/base", name="sped")]
    assert unique(given) == given
    given = [claimed(said, node="/robot1/base", name="x"), claimed(said, "hint", node="/robot2/base", name="x")]
    assert unique(given) == given


def test_what_another_program_says_is_left_as_it_is() -> None:
    said = "it failed: {quoted}"
    given = [claimed(said, node="", quoted=f"cat: /data/{n}: Permission denied") for n in "ab"]
    assert unique(given) == given
    (found,) = unique([claimed("{node}: {quoted}", node=f"/r{n}/base", quoted="/r1/base is busy") for n in (1, 2)])
    assert found.message == "/r1/base and 1 more: /r1/base is busy"


def test_a_file_that_is_included_for_each_robot() -> None:
    findings = findings_of("""
        <launch>
          <group ns="robot1"><include file="/robot.launch"/></group>
          <group ns="robot2"><include file="/robot.launch"/></group>
        </launch>
        //- /robot.launch
        <launch><node pkg="p" type="t" name="base"/></launch>
        //- interfaces
        {"/robot1/base": {"status": "crashed", "exit_code": 1}, "/robot2/base": {"status": "crashed", "exit_code": 1}}
    """)
    (crashed,) = [each for each in findings if each.rule == "TRC001"]
    assert crashed.message == "/robot1/base and 1 more crashes on start: exit code 1"
    assert crashed.related[-1].message == "in another context: /robot2/base crashes on start: exit code 1"
