"""One finding for what is said of several nodes at one place."""

from __future__ import annotations

import pytest
from preflight_analysis.documents.span import Location
from preflight_analysis.findings.finding import EndpointRef, Finding, Severity
from preflight_analysis.rules.instances import regardless_of_node
from preflight_analysis.rules.registry import unique
from support.check import findings_of

PLACE = Location.of_file("/a.launch")


def said(message: str, severity: Severity = "warning", node: str = "/n", quoted: str = "", about: str = "") -> Finding:
    end, at = EndpointRef("topic", "/t", node), message.index(quoted) if quoted else None
    return Finding("ABC001", "n", severity, "certain", message, PLACE, endpoints=(end,), quoted_from=at, node=about)


def test_the_same_of_several_nodes_is_said_once_with_their_number() -> None:
    one, two, three = (said(f"/robot{n}/base ignores '/robot{n}/speed'", node=f"/robot{n}/base") for n in (1, 2, 3))
    (found,) = unique([one, two, three])
    assert found.message == "/robot1/base and 2 more ignores '/robot1/speed'"
    assert [each.message for each in found.related] == [f"also: {two.message}", f"also: {three.message}"]
    assert [end.node for end in found.endpoints] == ["/robot1/base", "/robot2/base", "/robot3/base"]


def test_the_number_stands_behind_the_name_of_the_node_alone() -> None:
    said_of = [said(f"'/{n}/base/speed' is a text, but /{n}/base reads a number", node=f"/{n}/base") for n in "ab"]
    (found,) = unique(said_of)
    assert found.message == "'/a/base/speed' is a text, but /a/base and 1 more reads a number"


def test_something_else_of_another_node_stays_a_finding() -> None:
    given = [said("/robot1/base ignores 'speed'"), said("/robot2/base ignores 'sped'")]
    assert unique(given) == given
    given = [said("/robot1/base ignores 'speed'"), said("/robot2/base ignores 'speed'", "hint")]
    assert unique(given) == given


def test_files_are_no_nodes() -> None:
    for message in ("file '/a/b.yaml' does not exist", "see /a/b.yaml"):
        assert regardless_of_node(said(message)) == message


def test_what_another_program_says_is_left_as_it_is() -> None:
    given = [said(f"command failed: cat: /data/serial_{n}: Permission denied") for n in ("front", "back")]
    assert unique(given) == given
    given = [said(f"/robot{n}/base: no permission to read /dev/serial: it is busy") for n in (1, 2)]
    (found,) = unique(given)
    assert found.message == "/robot1/base and 1 more: no permission to read /dev/serial: it is busy"


@pytest.mark.parametrize(
    "words", ["cannot open /data/{} for reading", "/data/{} is busy", "/data/{}: Permission denied", "/data/{}"]
)
def test_whatever_another_program_says_stays(words: str) -> None:
    given = [said(f"it failed: {words.format(n)}", quoted=words.format(n)) for n in "ab"]
    assert unique(given) == given
    told = [
        said(f"/{n}/base ends: {words.format('x')}", quoted=words.format("x"), about=f"/{n}/base") for n in ("r", "s")
    ]
    (found,) = unique(told)
    assert found.message == f"/r/base and 1 more ends: {words.format('x')}"
    assert found.quoted_from is not None and found.message[found.quoted_from :] == words.format("x")


def test_of_several_nodes_that_are_named_the_one_that_it_is_about_is_counted() -> None:
    given = [said(f"/map is not read by /{n}/base", about=f"/{n}/base") for n in ("r", "s")]
    (found,) = unique(given)
    assert found.message == "/map is not read by /r/base and 1 more"


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
