"""LCH039: two strings of a list between which the comma is missing."""

import pytest
from support.check import apply, check

_START = """//- /robot.launch.py
        from launch import LaunchDescription
        from launch.actions import DeclareLaunchArgument
        from launch_ros.actions import Node

        def generate_launch_description():
            return LaunchDescription(["""


def test_two_choices_without_a_comma() -> None:
    text = f"""
        {_START}
                DeclareLaunchArgument("drive", default_value="c", choices=["a" "b", "c"]),
                                                                           ^^^^^^^ warning[LCH039] 'a' and 'b' are one
            ])
    """
    (found,) = check(text)
    assert 'choices=["a", "b", "c"]' in apply(text, found.fixes[0].edits)["/robot.launch.py"]


def test_two_lines_without_a_comma() -> None:
    text = f"""
        {_START}
                Node(package="p", executable="e", arguments=[
                    "--one"
                    ^^^^^^^ warning[LCH039] '--one' and 'two' are one string
                    "two",
                    "three",
                ]),
            ])
    """
    found = check(text)
    assert '"--one",\n' in apply(text, found[0].fixes[0].edits)["/robot.launch.py"]


def test_beside_what_is_no_text() -> None:
    check(f"""
        {_START}
                Node(package="p", executable="e", arguments=["one" "two", "--file", str(3)]),
                                                             ^^^^^^^^^^^ warning[LCH039] 'one' and 'two' are one string
            ])
    """)


@pytest.mark.silent
def test_what_is_broken_on_purpose() -> None:
    check(f"""
        {_START}
                Node(package="p", executable="e", arguments=[
                    "a" "b",
                    "a long text that "
                    "goes on",
                ]),
                Node(package="p", executable="e", arguments=["--file", "a/long/path/"
                    "that/goes/on"]),
                Node(package="p", executable="e", arguments=["/clock@rosgraph_msgs/msg/Clock["
                    "gz.msgs.Clock", "/tf@"
                    "tf2_msgs/msg/TFMessage"]),
                Node(package="p", executable="e", arguments=["--file", ("a"
                    "b")]),
            ])
    """)


def test_values_of_a_parameter_without_a_comma() -> None:
    check("""
        <launch><rosparam command="load" file="/ekf.yaml"/></launch>
        //- /ekf.yaml
        odom0_config: [true, false, true
        ^^^^^^^^^^^^ warning[LCH039] 'true' and 'false' are one text in '/odom0_config': the comma between them is
                       false, false]
        gains: [1.0, 2 3e-1, 4]
        ^^^^^ warning[LCH039] '2' and '3e-1' are one text
        names: [a, b c]
        mixed: [1, 2, "1 a"]
        one: [1, "2 3"]
        words: [true, false, "2 3"]
    """)
