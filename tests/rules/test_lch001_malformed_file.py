"""LCH001: the file is not well-formed XML or YAML, or no Python."""

import pytest
from support.check import check, findings_of


def test_malformed_xml_is_shown_at_its_cause() -> None:
    (finding,) = findings_of('<launch>\n  <node pkg="p" type="t" name="n">\n</launch>')
    assert (finding.rule, finding.severity, finding.stops_launch) == ("LCH001", "error", True)


def test_malformed_xml_in_an_included_file_is_shown_there_once() -> None:
    findings = findings_of("""
        <launch>
          <include file="/inc.launch"/>
          <group ns="b"><include file="/inc.launch"/></group>
        </launch>
        //- /inc.launch
        <launch><node pkg="p" type="t" name="n"</launch>
    """)
    assert [(f.rule, f.location.file) for f in findings if f.rule == "LCH001"] == [("LCH001", "/inc.launch")]


def test_a_start_tag_for_the_end_tag_is_told_once() -> None:
    check("""
        <launch>
          <group ns="a">
            <node pkg="p" type="t" name="b"/>
          </group>
        <launch>
         ^^^^^^ error[LCH001] '/' is missing: </launch> is expected
    """)


def test_yaml_in_the_middle_of_typing() -> None:
    check("""
        //- /robot.launch.yaml
        launch:
          - node:
              pkg: p
              exec: talker
              name: $(var nmae)
                    ^^^^^^^^^^^ error[ARG001] argument 'nmae' is not declared
          - node:
              pkg: p
              exec: [
                    ^ error[LCH001] while parsing a flow sequence
              nam
    """)


@pytest.mark.silent
def test_references_comments_and_declarations() -> None:
    check("""
        <?xml version="1.0"?>
        <!-- a < b & c -->
        <launch>
          <param name="a" value="&lt;&#65;&amp;"/>
          <rosparam><![CDATA[b: "<"]]></rosparam>
        </launch>
    """)
