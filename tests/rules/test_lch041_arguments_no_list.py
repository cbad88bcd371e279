"""LCH041: arguments that are a text or a set."""

import pytest
from support.check import check

_START = """//- /robot.launch.py
        import launch_ros.actions
        from launch import LaunchDescription
        from launch.actions import ExecuteProcess
        from launch_ros.actions import Node

        def generate_launch_description():
            return LaunchDescription(["""


def test_one_text() -> None:
    check(f"""
        {_START}
                Node(package="p", executable="e", arguments="0 0 map scan"),
                                                            ^^^^^^^^^^^^^^ error[LCH041] 'arguments' requires a list:
                ExecuteProcess(cmd=f"echo {{3}}"),
                                   ^^^^^^^^^^^ error[LCH041] 'cmd' requires a list: each character of a text becomes
            ])
    """)


def test_a_set() -> None:
    check(f"""
        {_START}
                launch_ros.actions.Node(package="p", executable="e", arguments={{"-p", "8888"}}),
                                                                               ^^^^^^^^^^^^^^ error[LCH041] 'arguments'
            ])
    """)


@pytest.mark.silent
def test_lists_and_what_is_not_launched() -> None:
    check(f"""
        {_START}
                Node(package="p", executable="e", arguments=["-p", "8888"]),
                Node(package="p", executable="f", arguments=("-p", "8888")),
                Node(package="p", executable="g", arguments={{"--once"}}),
                Node(package="p", executable="h", arguments=""),
                ExecuteProcess(cmd=["echo", "3"]),
            ])

        def Other(arguments):
            return None

        Other(arguments="0 0")
    """)
