"""TOP009: the name of one side for both."""

import pytest
from support.check import check, findings_of


def test_a_remap() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="stereo">
            <remap from="left/image" to="/cam/left/image_raw"/>
            <remap from="right/image" to="/cam/left/image_raw"/>
                                          ^^^^^^^^^^^^^^^^^^^ warning[TOP009] 'right/image' has the name
          </node>
        </launch>
    """)


@pytest.mark.parametrize(
    ("first", "second", "value", "said"),
    [
        ("cam0_topic", "cam1_topic", "/cam0/image", True),
        ("cam1_topic", "cam0_topic", "/cam0/image", True),
        ("left_wheel", "right_wheel", "left_wheel_joint", True),
        ("cam0_topic", "cam1_topic", "/camera/image", False),
        ("odom0", "odom1", "wheel0/odom", False),
        ("left_wheel", "right_wheel", "left_and_right", False),
        ("left_wheel", "left_caster", "left_wheel", False),
        ("cam0_topic", "cam1_info", "/cam0/image", False),
    ],
)
def test_parameters(first: str, second: str, value: str, *, said: bool) -> None:
    params = "".join(f'<param name="{name}" value="{value}"/>' for name in (first, second))
    found = findings_of(f'<launch><node pkg="p" type="t" name="n">{params}</node></launch>')
    assert [each.rule for each in found if each.rule == "TOP009"] == ["TOP009"] * said


def test_parameters_of_ros_2() -> None:
    params = "".join(f'<param name="{name}_topic" value="/front/scan"/>' for name in ("front", "rear"))
    (found,) = findings_of(f"""
        //- /a.launch.xml
        <launch><node pkg="p" exec="t" name="n">{params}</node></launch>
    """)
    assert found.message == "'rear_topic' has the name of the other side: '/front/scan', which 'front_topic' has too"


@pytest.mark.silent
def test_each_has_its_own() -> None:
    assert (
        findings_of("""
        <launch>
          <node pkg="p" type="t" name="stereo">
            <remap from="left/image" to="/cam/left/image_raw"/>
            <remap from="right/image" to="/cam/right/image_raw"/>
          </node>
        </launch>
    """)
        == []
    )
