"""LCH043: a name that nothing in a Python launch file defines."""

import pytest
from support.check import check, findings_of

_START = """//- /robot.launch.py
        from launch import LaunchDescription
        from launch.actions import DeclareLaunchArgument, OpaqueFunction
        from launch.substitutions import LaunchConfiguration
        from launch_ros.actions import Node
"""


def test_in_a_function_that_the_launch_may_come_to() -> None:
    check(f"""
        {_START}
        def setup(context):
            gz_paused = LaunchConfiguration("paused").perform(context)
            if gz_paused == "maybe":
                return [Node(package="p", executable=gz_pausd)]
                                                     ^^^^^^^^ error[LCH043] undefined name 'gz_pausd'; this line
            return [robot(context) for robot in ()]

        def generate_launch_description():
            return LaunchDescription([
                DeclareLaunchArgument("paused", default_value="false"), OpaqueFunction(function=setup),
            ])
    """)


def test_what_another_function_gets() -> None:
    check(f"""
        {_START}
        def setup(context, *args):
            return [args, context]

        def not_called():
            return context
                   ^^^^^^^ info[LCH043] undefined name 'context'; this line raises a NameError

        def generate_launch_description():
            return LaunchDescription([OpaqueFunction(function=setup)])
    """)


@pytest.mark.silent
@pytest.mark.parametrize(
    "body",
    [
        "return [each for each in context] + [(lambda x: x)(context), __file__, print]",
        "global made\n            made = 1\n            return made",
        "try:\n                return later\n            except NameError:\n                return []",
        "from os import path as there\n            import os.path\n            return there, os",
        "def inner() -> NotThere:\n                return context\n            return inner",
        "for k, (v, w) in {}.items():\n                pass\n            return k, v, w",
        "class A:\n                x = 1\n                y = x\n            return A, defined_below",
        "with open('f') as f:\n                return [y := f, y, made_by_exec, exec('made_by_exec = 1')]",
    ],
)
def test_what_is_defined(body: str) -> None:
    found = findings_of(f"""
        {_START}
        def setup(context):
            {body}

        defined_below = 1

        def generate_launch_description():
            return LaunchDescription([])
    """)
    assert not [each for each in found if each.rule == "LCH043"]


@pytest.mark.silent
def test_a_file_that_imports_all_names_of_another() -> None:
    findings_of("""
        //- /robot.launch.py
        from launch import *

        def generate_launch_description():
            return LaunchDescription([Something()])
    """)


def test_what_only_a_program_does() -> None:
    check(f"""
        {_START}
        def generate_launch_description():
            return LaunchDescription([])

        if __name__ == "__main__":
            main()
            ^^^^ info[LCH043] undefined name 'main'
    """)
