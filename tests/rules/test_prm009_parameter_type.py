"""PRM009: a parameter's value is of another kind than the node's own default."""

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
                         ^^^^ warning[PRM009] type mismatch of parameter '/n/rate': '1e3' is a text, /n expects a
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
        ("off", "true"),
        ("no", "false"),
        ("[1, 2]", "[0.0, 0.0]"),
        ("3", "[1]"),
    ],
)
def test_values_of_another_kind(value: str, default: str) -> None:
    assert _kinds(value, default) == [("warning", "likely")]


@pytest.mark.silent
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
    assert _kinds("/dev/ttyUSB0", "0") == [("hint", "likely")]


def test_an_empty_text_for_a_number_is_information() -> None:
    """`$(optenv PORT)` without the variable."""
    assert _kinds("", "1883") == [("info", "likely")]


def test_lists_from_yaml() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="n">
            <rosparam>
              frames: [a, b]
              frame: [a, b]
              ^^^^^ warning[PRM009] type mismatch of parameter '/n/frame': ['a', 'b'] is a list, /n expects a text
            </rosparam>
          </node>
        </launch>
        //- interfaces
        {"/n": {"params": {"~frames": ["c"], "~frame": "map"}}}
    """)


@pytest.mark.parametrize(("default", "severity"), [("{}", "info"), ('{"a": 1}', "warning")])
def test_an_empty_default_says_little_of_the_kind(default: str, severity: str) -> None:
    found = findings_of(f"""
        <launch><node pkg="p" type="t" name="n"><rosparam>tools: [a]</rosparam></node></launch>
        //- interfaces
        {{"/n": {{"params": {{"~tools": {default}}}}}}}
    """)
    assert [each.severity for each in found if each.rule == "PRM009"] == [severity]


@pytest.mark.parametrize(
    ("tag", "after"),
    [
        ('<param name="rate" value="1e3"/>', '<param name="rate" value="1000"/>'),
        ('<param name="rate" value="-5e-1"/>', '<param name="rate" value="-0.5"/>'),
        ('<param name="rate" value="0x10"/>', '<param name="rate" value="16"/>'),
        ('<param name="rate" value="1_000"/>', '<param name="rate" value="1000"/>'),
        ('<param name="rate" value="1e3" type="str"/>', None),
        ('<param name="rate" value="1e-30"/>', None),
        ('<param name="rate" value="1e999"/>', None),
        ('<param name="rate" value="$(arg rate)"/>', None),
        ('<param name="rate" value="fast"/>', None),
    ],
)
def test_a_number_is_written_plainly(tag: str, after: str | None) -> None:
    launch = f"""
        <launch>
          <arg name="rate" value="1e3"/>
          <node pkg="p" type="t" name="n">
            {tag}
          </node>
        </launch>
        //- interfaces
        {{"/n": {{"params": {{"~rate": 10}}}}}}
    """
    (finding,) = [each for each in findings_of(launch) if each.rule == "PRM009"]
    assert [apply(launch, fix.edits)["/main.launch"].splitlines()[3].strip() for fix in finding.fixes] == (
        [after] if after is not None else []
    )


def test_a_number_is_written_plainly_in_a_file() -> None:
    launch = """
        <launch><node pkg="p" type="t" name="n"><rosparam command="load" file="/c.yaml"/></node></launch>
        //- /c.yaml
        rate: 1e3
        //- interfaces
        {"/n": {"params": {"~rate": 10}}}
    """
    (finding,) = [each for each in findings_of(launch) if each.rule == "PRM009"]
    assert [apply(launch, fix.edits)["/c.yaml"].strip() for fix in finding.fixes] == ["rate: 1000"]
