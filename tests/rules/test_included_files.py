"""An error in an included file is shown there, once for all includes, with the includes that lead to it."""

from dataclasses import replace

import pytest
from preflight_analysis.findings.contexts import RootFindings, by_file
from preflight_analysis.findings.finding import Finding, Related
from preflight_analysis.rules.registry import all_rules, unique
from preflight_analysis.workspace.sources import Sources
from support.check import findings_of
from support.locations import location

FILES = """
        //- /inc.launch
        <launch><arg name="id"/><param name="id" value="$(arg id)"/>
          BODY
        </launch>
        //- /leaf.launch
        <launch/>
        //- /fixed.launch
        <launch><arg name="f" value="2"/><param name="a" value="$(arg f)"/></launch>
        //- /needs.launch
        <launch><arg name="f"/><param name="a" value="$(arg f)"/></launch>
        //- /bad.yaml
        a: [
"""
TWICE = """
        <launch>
          <include file="/inc.launch" ns="left"><arg name="id" value="1"/></include>
          <include file="/inc.launch" ns="right"><arg name="id" value="2"/></include>
        </launch>"""
BODIES = [
    ("ARG001", '<param name="x" value="$(arg nope)"/>'),
    ("ARG002", '<include file="/needs.launch"/>'),
    ("ARG004", '<include file="/leaf.launch"><arg name="z" value="1"/></include>'),
    ("ARG005", '<arg name="q" default="1"/><arg name="q" default="2"/><param name="x" value="$(arg q)"/>'),
    ("ARG006", '<include file="/fixed.launch"><arg name="f" value="1"/></include>'),
    ("ARG007", '<include file="/leaf.launch"><arg name="z"/></include>'),
    ("ARG008", '<arg name="idle" default="1"/>'),
    ("LCH001", "<group></grup>"),
    ("LCH004", "<nod/>"),
    ("LCH005", '<param nam="a" name="x" value="1"/>'),
    ("LCH006", '<node pkg="p" name="n"/>'),
    ("LCH007", '<param name="x" value="1" textfile="a"/>'),
    ("LCH008", '<param name="x" type="integer" value="1"/>'),
    ("LCH009", '<node pkg="p" type="t" name="a/b"/>'),
    ("LCH010", '<include file="/leaf.launch"><param name="a" value="1"/></include>'),
    ("LCH011", '<param name="x" value="$(fnd p)"/>'),
    ("LCH012", '<param name="x" value="$(env NOPE)"/>'),
    ("LCH013", '<include file="/$(arg id).launch"/>'),
    ("LCH015", '<include file="/inc.launch"><arg name="id" value="$(arg id)"/></include>'),
    ("LCH016", '<node pkg="p" type="t" name="n"/><node pkg="p" type="t" name="n"/>'),
    ("LCH017", '<node pkg="p" type="t" name="n" machine="m"/>'),
    ("LCH018", '<param name="x" value="$(eval [a for a in [1]])"/>'),
    ("LCH021", '<param name="x" value="/home/bob/a.yaml"/>'),
    ("LCH027", "<master/>"),
    ("PKG001", '<node pkg="gone" type="t" name="n"/>'),
    ("PRM002", '<rosparam file="/$(arg id).yaml"/>'),
    ("PRM004", '<rosparam file="/bad.yaml"/>'),
    ("PRM005", '<node pkg="p" type="t" name="n" args="/p/$(arg id).yaml"/>'),
]


def included_here(finding: Finding) -> int:
    return [related.message for related in finding.related].count("included here")


@pytest.mark.parametrize(("rule", "body"), BODIES)
def test_a_file_that_is_included_twice_shows_its_error_once(rule: str, body: str) -> None:
    (finding,) = findings_of(TWICE + FILES.replace("BODY", body))
    assert finding.rule == rule
    assert finding.location.file in ("/inc.launch", "/bad.yaml")
    assert included_here(finding) >= 1


@pytest.mark.parametrize(("rule", "body"), BODIES)
def test_a_file_that_two_roots_include_shows_its_error_once(rule: str, body: str) -> None:
    reports, sources = [], Sources()
    for root, identifier in (("/one.launch", "1"), ("/two.launch", "2")):
        text = f"""
        //- {root}
        <launch><include file="/inc.launch"><arg name="id" value="{identifier}"/></include></launch>"""
        found = findings_of(text + FILES.replace("BODY", body), sources=sources)
        reports.append(RootFindings(root, frozenset((root, "/inc.launch")), tuple(found)))
    files = by_file(reports, frozenset(each.id for each in all_rules() if each.every_root))
    (finding,) = [finding for found in files.values() for finding in found]
    assert (finding.rule, finding.roots) == (rule, ("/one.launch", "/two.launch"))


def test_what_differs_from_include_to_include_is_told_of() -> None:
    (finding,) = findings_of(TWICE + FILES.replace("BODY", '<include file="/$(arg id).launch"/>'))
    assert finding.message == "included file '/1.launch' does not exist"
    assert finding.related[-1].message == "in another context: included file '/2.launch' does not exist"
    assert finding.related[-1].location.file == "/main.launch"


def test_the_graver_of_two_contexts_is_shown() -> None:
    place = location("/inc.launch", 0, 1)
    finding = Finding("LCH013", "", "hint", "certain", "mild", place)
    chains = [(Related("included here", location("/main.launch", at, at), "included"),) for at in (1, 2)]
    said = [
        replace(finding, related=chains[0]),
        replace(finding, related=chains[1], severity="error", message="grave"),
        replace(finding, related=chains[1], message="more"),
    ]
    grave, more = unique(said)
    assert (grave.message, more.message) == ("grave", "more")
    assert [related.message for related in grave.related] == ["included here", "in another context: mild"]
