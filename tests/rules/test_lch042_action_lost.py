"""LCH042: an action whose variable gets another one before it is used."""

import pytest
from preflight_analysis.findings.report import by_cause
from support.check import check, findings_of


def test_the_name_of_the_one_that_was_copied() -> None:
    check("""
        //- /robot.launch.py
        from launch import LaunchDescription
        from launch_ros.actions import Node

        def generate_launch_description():
            broadcaster = Node(package="p", executable="b")
            drive = Node(package="p", executable="drive")
            ^^^^^ warning[LCH042] 'drive' is assigned again before its first use: this Node is never launched
            drive = Node(package="p", executable="imu")
            return LaunchDescription([broadcaster, drive])
    """)


@pytest.mark.silent
def test_what_is_used_or_chosen() -> None:
    check("""
        //- /robot.launch.py
        from launch import LaunchDescription
        from launch.actions import GroupAction
        from launch_ros.actions import Node

        def generate_launch_description():
            made = []
            node = Node(package="p", executable="a")
            made.append(node)
            node = Node(package="p", executable="b")
            node = GroupAction([node])
            made.append(node)
            if len(made) > 2:
                node = Node(package="p", executable="c")
            else:
                node = Node(package="p", executable="d")
            unused = Node(package="p", executable="e")
            return LaunchDescription([
                *made,
                node,
                # unused,
            ])
    """)


def test_the_same_action_again() -> None:
    check("""
        //- /robot.launch.py
        from launch import LaunchDescription
        from launch_ros.actions import Node

        def generate_launch_description():
            drive = Node(package="p", executable="drive")
            ^^^^^ hint[LCH042] the next one is the same
            drive = Node(
                package="p", executable="drive"
            )
            return LaunchDescription([drive])
    """)


def test_what_no_list_has() -> None:
    check("""
        //- /robot.launch.py
        from launch import LaunchDescription
        from launch_ros.actions import Node

        def generate_launch_description():
            drive = Node(package="p", executable="drive")
            camera = Node(package="p", executable="camera")
            ^^^^^^ info[LCH042] 'camera' is not used: this Node is never launched
            Node(package="p", executable="monitor")
            ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[LCH042] 'Node' is not part of the launch description
            return LaunchDescription([drive])
    """)


def test_a_menu_of_which_one_is_launched_is_one_finding() -> None:
    """https://github.com/501Ranger/rdkrobot_ws: ten lidars."""
    nodes = "".join(f'            {name} = Node(package="p", executable="lidar")\n' for name in "abcde")
    (found,) = by_cause(
        findings_of(f"""
        //- /robot.launch.py
        from launch import LaunchDescription
        from launch_ros.actions import Node

        def generate_launch_description():
{nodes}            return LaunchDescription([a])
    """)
    )
    assert found.message == "4 actions of this file are never launched: 'b', 'c', 'd', 'e'"


@pytest.mark.silent
def test_what_is_asked_for_by_its_name() -> None:
    check("""
        //- /robot.launch.py
        from launch import LaunchDescription
        from launch_ros.actions import Node

        def generate_launch_description():
            camera = Node(package="p", executable="camera")
            return LaunchDescription([locals()["camera"]])
    """)
