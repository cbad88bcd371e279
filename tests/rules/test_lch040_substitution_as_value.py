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


@pytest.mark.parametrize(
    ("asked", "said", "instead"),
    [
        ("not sim.perform(context)", "'not' is always False: argument 'sim'", "sim.perform(context).lower() != 'true'"),
        ("bool(text)", "condition is always true: argument 'sim'", "text.lower() == 'true'"),
        ("text == True", "comparison is always False: the value of argument 'sim'", "text.lower() == 'true'"),
        ("text.lower() != True", "comparison is always True: the value of argument 'sim'", "text.lower() != 'true'"),
        ("False == text", "comparison is always False: the value of argument 'sim'", "text.lower() != 'true'"),
        ("not context.launch_configurations['sim']", "'not' is always False: argument 'sim'", None),
        ("not context.launch_configurations.get('sim')", "'not' is always False: argument 'sim'", None),
    ],
)
def test_the_truth_of_a_text(asked: str, said: str, instead: str | None) -> None:
    text = f"""
        {_START}
        def start(context):
            sim = LaunchConfiguration("sim")
            text = sim.perform(context)
            asked = {asked}
                    {"^" * len(asked)} warning[LCH040] {said}
            return []


        def generate_launch_description():
            declared = DeclareLaunchArgument("sim", default_value="False")
            return LaunchDescription([declared, OpaqueFunction(function=start)])
    """
    (found,) = check(text)
    after = apply(text, found.fixes[0].edits)["/robot.launch.py"]
    assert instead is None or f"asked = {instead}\n" in after


def test_the_truth_of_a_text_in_a_statement() -> None:
    check(f"""
        {_START}
        def start(context):
            sim = LaunchConfiguration("sim").perform(context)
            if sim and context.launch_configurations["name"]:
               ^^^ warning[LCH040] condition is always true: argument 'sim' has the text 'true' or 'false'
                return []
            return [None] if sim.lower() else []
                             ^^^^^^^^^^^ warning[LCH040] condition is always true: argument


        def generate_launch_description():
            declared = DeclareLaunchArgument("sim", default_value="true")
            return LaunchDescription([declared, OpaqueFunction(function=start)])
    """)


@pytest.mark.silent
def test_a_text_that_may_be_empty_has_a_truth() -> None:
    check(f"""
        {_START}
        def start(context):
            name = LaunchConfiguration("name").perform(context)
            other = LaunchConfiguration("other").perform(context)
            sim = LaunchConfiguration("sim").perform(context)
            both = LaunchConfiguration("both").perform(context)
            if name or not other or both or sim == "true" or sim in ("true", "1") or name == 1:
                return []
            return []


        def generate_launch_description():
            names = [DeclareLaunchArgument("name", default_value=""), DeclareLaunchArgument("other")]
            both = [DeclareLaunchArgument("both", default_value=each) for each in ("true", "")]
            sim = DeclareLaunchArgument("simulated", default_value="true")
            return LaunchDescription([*names, *both, sim, OpaqueFunction(function=start)])
    """)
