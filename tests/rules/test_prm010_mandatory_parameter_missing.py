"""PRM010: a node reads a parameter without a default, and nothing sets it."""

from pathlib import Path

import pytest
from support.check import apply, check, findings_of


def test_a_node_that_died_of_a_missing_parameter() -> None:
    (finding, _) = check("""
        <launch>
          <node pkg="p" type="t" name="n"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[PRM010] required parameter '/n/rate' is not set; /n reads it
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ info[TRC001]
        </launch>
        //- interfaces
        {"/n": {"params": {"~rate": null}, "status": "crashed", "exit_code": 1, "stderr": ["KeyError: '~rate'"]}}
    """)
    assert finding.confidence == "likely"


@pytest.mark.parametrize(("name", "severity"), [("rate", "info"), ("~rate", "warning")])
def test_what_a_launch_file_nearby_sets(tmp_path: Path, name: str, severity: str) -> None:
    (tmp_path / "main.launch").touch()
    (tmp_path / "params.launch").write_text('<launch><param name="rate" value="1"/></launch>')
    found = findings_of(f"""
        //- {tmp_path}/main.launch
        <launch><node pkg="p" type="t" name="n"/></launch>
        //- interfaces
        {{"/n": {{"params": {{"{name}": null}}, "status": "crashed", "exit_code": 1, "stderr": ["KeyError: 'rate'"]}}}}
        //- {tmp_path}/package.xml
        <package><name>p</name></package>
    """)
    assert [each.severity for each in found if each.rule == "PRM010"] == [severity]


def test_a_node_that_goes_on_gets_one_hint() -> None:
    check("""
        <launch>
          <param name="other/rate" value="1"/>
          <node pkg="p" type="t" name="talker"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ hint[PRM010] parameters '/talker/rate' and '/talker/size' are not
          <node pkg="p" type="t" name="other"/>
        </launch>
        //- interfaces
        {"/talker": {"params": {"~rate": null, "~size": null}}, "/other": {"params": {"~rate": 1}}}
    """)


@pytest.mark.silent
def test_what_is_set_or_asked_for_first_is_not_missing() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="n">
            <param name="rate" value="10"/>
            <rosparam param="gains">{p: 1}</rosparam>
          </node>
          <node pkg="p" type="t" name="m"/>
        </launch>
        //- interfaces
        {"/n": {"params": {"~rate": null, "~gains": null, "/shared": null, "/robot_description": null}},
         "/m": {"params": {"/shared": {"access": "set"}}}}
    """)


@pytest.mark.silent
def test_private_parameters_among_the_arguments_are_set() -> None:
    check("""
        <launch><node pkg="p" type="t" name="n" args="_rate:=3"/></launch>
        //- interfaces
        {"/n": {"params": {"~rate": null}}}
    """)


@pytest.mark.parametrize("access", ["null", '{"access": "has"}'])
def test_a_node_that_ends_with_its_own_words_on_a_parameter(access: str) -> None:
    text = """
        <launch><node pkg="p" type="t" name="n"/></launch>
        //- interfaces
        {"/n": {"params": {"~rate": ACCESS}, "status": "exited", "exit_code": 1, "stderr": ["LINE", "bye"]}}
    """.replace("ACCESS", access)
    (finding,) = [f for f in findings_of(text.replace("LINE", "param rate is not set")) if f.rule == "PRM010"]
    assert (finding.severity, finding.confidence) == ("warning", "likely")
    assert finding.message.endswith("and exits: param rate is not set")
    others = [f for f in findings_of(text.replace("LINE", "no device at 9600 baud, rates vary")) if f.rule == "PRM010"]
    assert {f.severity for f in others} <= {"hint"}


def test_a_node_that_died_of_a_misspelt_parameter_is_told_where_it_is_written() -> None:
    text = """
        <launch>
          <node pkg="p" type="t" name="n"><param name="sampel_rate" value="3"/></node>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ info[TRC001]
                                                       ^^^^^^^^^^^ warning[PRM010] unused parameter '/n/sampel_rate';
        </launch>
        //- interfaces
        {"/n": {"params": {"~sample_rate": null}, "status": "crashed", "exit_code": 1,
                "stderr": ["KeyError: '~sample_rate'"]}}
    """
    finding = next(f for f in check(text) if f.rule == "PRM010")
    assert '<param name="sample_rate"' in apply(text, finding.fixes[0].edits)["/main.launch"]


def test_a_type_alone_in_the_source_of_a_node_of_ros_2() -> None:
    (finding,) = check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="guide" name="guide"><param name="gain" value="1.5"/></node>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[PRM010] required parameters 'file' and 'step' are not set;
        </launch>
        //- interfaces
        {"/guide": {"source": "source", "params": {"~gain": null, "~step": null, "~file": null, "~rate": 1.0}}}
    """)
    assert finding.confidence == "likely"


@pytest.mark.silent
@pytest.mark.parametrize(
    "node",
    [
        '<node pkg="p" exec="guide" name="guide"><param name="step" value="1.5"/></node>',
        '<node pkg="p" exec="guide" name="guide" args="--params-file /somewhere"/>',
        '<node pkg="p" exec="guide" name="guide"><param from="$(env NOT_SET)"/></node>',
    ],
)
def test_nothing_is_missing_where_something_may_set_it(node: str) -> None:
    found = findings_of(f"""
        //- /robot.launch.xml
        <launch>
          {node}
        </launch>
        //- interfaces
        {{"/guide": {{"source": "source", "params": {{"~step": null}}}}}}
    """)
    assert not [each for each in found if each.rule == "PRM010"]
