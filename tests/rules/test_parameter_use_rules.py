"""PRM009, PRM010: what nodes expect of parameters."""

import pytest
from support.check import apply, check, findings_of


def _kinds(value: str, default: str, type_: str = "") -> list[tuple[str, str]]:
    launch = f"""
        <launch>
          <node pkg="p" type="t" name="n"><param name="rate" value="{value}"{type_}/></node>
        </launch>
        //- interfaces
        {{"/n": {{"params": {{"~rate": {default}}}}}}}
    """
    return [(f.severity, f.confidence) for f in findings_of(launch) if f.rule == "PRM009"]


def test_a_number_that_roslaunch_takes_for_a_text() -> None:
    (finding,) = check("""
        <launch>
          <node pkg="p" type="t" name="n">
            <param name="rate" value="1e3"/>
                         ^^^^ warning[PRM009] '/n/rate' is '1e3', a text, but /n reads it with the default 10, a number
          </node>
        </launch>
        //- interfaces
        {"/n": {"params": {"~rate": 10}}}
    """)
    assert [related.message for related in finding.related] == ["/n reads /n/rate"]


@pytest.mark.parametrize(
    ("value", "default"),
    [
        ("fast", "10"),
        ("", "2.5"),
        ("off", "true"),
        ("no", "false"),
        ("[1, 2]", "[0.0, 0.0]"),
        ("3", "[1]"),
    ],
)
def test_values_of_another_kind(value: str, default: str) -> None:
    assert _kinds(value, default) == [("warning", "likely")]


@pytest.mark.parametrize(
    ("value", "default"),
    [
        ("3", "2.5"),
        ("2.5", "3"),
        ("1", "true"),
        ("true", "0"),
        ("model.json", "false"),  # False stands for "none given"
        ("42", '"serial"'),
        ("text", '"other"'),
        ("3", '""'),
        ("true", "false"),
    ],
)
def test_values_that_will_do(value: str, default: str) -> None:
    assert _kinds(value, default) == []


def test_a_text_where_zero_may_stand_for_not_set_is_a_hint() -> None:
    assert _kinds("/dev/ttyUSB0", "0") == [("hint", "possible")]


def test_lists_from_yaml() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="n">
            <rosparam>
              frames: [a, b]
              frame: [a, b]
              ^^^^^ warning[PRM009] a list, but /n reads it with the default 'map', a text
            </rosparam>
          </node>
        </launch>
        //- interfaces
        {"/n": {"params": {"~frames": ["c"], "~frame": "map"}}}
    """)


def test_a_node_that_died_of_a_missing_parameter() -> None:
    (finding, _) = check("""
        <launch>
          <node pkg="p" type="t" name="n"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[PRM010] /n reads parameter '/n/rate' without a default
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ info[TRC001]
        </launch>
        //- interfaces
        {"/n": {"params": {"~rate": null}, "status": "crashed", "exit_code": 1, "stderr": ["KeyError: '~rate'"]}}
    """)
    assert finding.confidence == "likely"


def test_the_right_name_in_the_wrong_namespace() -> None:
    text = """
        <launch>
          <param name="rate" value="10"/>
                       ^^^^ warning[PRM001] /talker reads '/talker/rate', which is not set and has no default
          <node pkg="p" type="t" name="talker"/>
        </launch>
        //- interfaces
        {"/talker": {"params": {"~rate": null}}}
    """
    (finding,) = check(text)
    mended = apply(text, finding.fixes[0].edits)["/main.launch"]
    assert '<param name="talker/rate" value="10"/>' in mended
    assert findings_of(mended + "\n//- interfaces" + text.partition("//- interfaces")[2]) == []


def test_a_node_that_goes_on_gets_one_hint() -> None:
    check("""
        <launch>
          <param name="other/rate" value="1"/>
          <node pkg="p" type="t" name="talker"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ hint[PRM010] reads parameters '/talker/rate' and '/talker/size' without
          <node pkg="p" type="t" name="other"/>
        </launch>
        //- interfaces
        {"/talker": {"params": {"~rate": null, "~size": null}}, "/other": {"params": {"~rate": 1}}}
    """)


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
    assert finding.message.endswith("and nothing sets it; it ended with: param rate is not set")
    others = [f for f in findings_of(text.replace("LINE", "no device at 9600 baud, rates vary")) if f.rule == "PRM010"]
    assert {f.severity for f in others} <= {"hint"}


def test_a_misspelt_mandatory_parameter_is_told_once_where_it_is_written() -> None:
    (finding,) = check("""
        <launch>
          <node pkg="p" type="t" name="n"><param name="sampel_rate" value="3"/></node>
                                                       ^^^^^^^^^^^ warning[PRM001] did you mean '/n/sample_rate'
        </launch>
        //- interfaces
        {"/n": {"params": {"~sample_rate": null}}}
    """)
    assert "which is not set and has no default?" in finding.message
    assert [related.message for related in finding.related] == ["/n reads /n/sample_rate"]


def test_a_node_that_died_of_a_misspelt_parameter_is_told_where_it_is_written() -> None:
    text = """
        <launch>
          <node pkg="p" type="t" name="n"><param name="sampel_rate" value="3"/></node>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ info[TRC001]
                                                       ^^^^^^^^^^^ warning[PRM010] did you mean '/n/sample_rate' there?
        </launch>
        //- interfaces
        {"/n": {"params": {"~sample_rate": null}, "status": "crashed", "exit_code": 1,
                "stderr": ["KeyError: '~sample_rate'"]}}
    """
    finding = next(f for f in check(text) if f.rule == "PRM010")
    assert '<param name="sample_rate"' in apply(text, finding.fixes[0].edits)["/main.launch"]
