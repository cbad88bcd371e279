"""LCH040: a substitution or a condition that Python is asked for its value."""

import pytest
from support.check import apply, check, findings_of

_START = """//- /robot.launch.py
        from launch import LaunchDescription, conditions
        from launch.actions import DeclareLaunchArgument, OpaqueFunction
        from launch.conditions import IfCondition, UnlessCondition
        from launch.substitutions import EqualsSubstitution, LaunchConfiguration
        from launch_ros.actions import Node
"""


@pytest.mark.parametrize(
    ("asked", "said"),
    [
        ("IfCondition(sim) and UnlessCondition(sim)", "Python's 'and' drops 'IfCondition(sim)': 'IfCondition' is"),
        ("conditions.IfCondition(sim) or UnlessCondition(sim)", "Python's 'or' drops 'UnlessCondition(sim)'"),
        ("not sim", "'not' is always False: 'LaunchConfiguration' is always true"),
        ("sim == 'true'", "comparison is always False: 'LaunchConfiguration' has no value"),
        ("'true' != sim", "comparison is always True: 'LaunchConfiguration' has no value"),
        ("f'world_{sim}.sdf'", "the text contains a Python object"),
        ("str(sim)", "the text contains a Python object"),
    ],
)
def test_what_is_known_only_later(asked: str, said: str) -> None:
    check(f"""
        {_START}
        def generate_launch_description():
            sim = LaunchConfiguration("sim")
            asked = {asked}
                    {"^" * len(asked)} warning[LCH040] {said}
            return LaunchDescription([DeclareLaunchArgument("sim", default_value="true")])
    """)


def test_in_a_statement() -> None:
    check(f"""
        {_START}
        def generate_launch_description():
            if LaunchConfiguration("sim"):
               ^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[LCH040] 'LaunchConfiguration' is always true before the launch runs
                return LaunchDescription([])
            return LaunchDescription([])
    """)


@pytest.mark.silent
def test_what_may_be_something_else() -> None:
    check(f"""
        {_START}
        def setup(context, given=None):
            rate = given or LaunchConfiguration("rate")
            sim = LaunchConfiguration("sim").perform(context)
            if sim == "true" and not given:
                rate = "1"
            return [Node(package="p", executable="e", parameters=[{{"rate": f"{{rate}}"}}])]

        def generate_launch_description():
            shown = LaunchConfiguration("shown")
            only = UnlessCondition(shown) if shown is not None else None
            return LaunchDescription([
                DeclareLaunchArgument("sim", default_value="true"),
                DeclareLaunchArgument("rate", default_value="1"),
                DeclareLaunchArgument("shown", default_value="1"),
                OpaqueFunction(function=setup),
                Node(package="p", executable="e", condition=IfCondition(EqualsSubstitution(shown, "1"))),
                Node(package="p", executable="f", condition=only),
            ])
    """)


@pytest.mark.parametrize(
    ("asked", "after"),
    [
        ("IfCondition(sim) and UnlessCondition(gui)", "IfCondition(AndSubstitution(sim, NotSubstitution(gui)))"),
        ("IfCondition(sim) or IfCondition(gui)", "IfCondition(OrSubstitution(sim, gui))"),
        ("IfCondition(sim and gui)", "IfCondition(AndSubstitution(sim, gui))"),
        ("IfCondition(sim == '{a}')", "IfCondition(EqualsSubstitution(sim, '{a}'))"),
        ("UnlessCondition('x' != sim)", "UnlessCondition(NotEqualsSubstitution('x', sim))"),
        ("IfCondition(not sim)", "IfCondition(NotSubstitution(sim))"),
        ("UnlessCondition(sim) and UnlessCondition(gui)", None),
        ("sim and IfCondition(gui)", None),
        ("1 if sim and gui else 2", None),
        ("not sim", None),
        ("sim == 'a'", None),
        ("f'a{sim}'", None),
    ],
)
def test_what_launch_evaluates_instead(asked: str, after: str | None) -> None:
    launch = f"""
        {_START}
        def generate_launch_description():
            sim = LaunchConfiguration("sim")
            gui = LaunchConfiguration("gui")
            asked = {asked}
            return LaunchDescription([DeclareLaunchArgument("sim", default_value="true")])
    """
    found = [each for each in findings_of(launch) if each.rule == "LCH040"]
    texts = [apply(launch, fix.edits)["/robot.launch.py"] for each in found for fix in each.fixes]
    assert [f"asked = {after}\n" in text for text in texts] == ([True] if after is not None else [])
