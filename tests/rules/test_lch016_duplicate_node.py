"""LCH016: two nodes of one name."""

import pytest
from support.check import check, findings_of
from support.fixes import fixed


def test_the_second_node_of_a_name_gets_a_free_one() -> None:
    node = '<node pkg="p" type="t" name="n"/>'
    assert fixed(f'{node}<node pkg="p" type="t" name="n_2"/>{node}', "LCH016").endswith('name="n_3"/>')


def test_a_node_whose_file_is_included_twice_is_said_to_be_so() -> None:
    (finding,) = findings_of("""
        <launch><include file="/inc.launch"/><include file="/inc.launch"/></launch>
        //- /inc.launch
        <launch><node pkg="p" type="t" name="n"/></launch>
    """)
    assert "this file is included twice; give each include its own namespace" in finding.message
    assert finding.fixes == ()


def test_the_name_of_roslaunch_itself() -> None:
    (finding,) = findings_of('<launch><node pkg="p" type="t" name="rosout"/></launch>')
    assert (finding.rule, finding.message) == (
        "LCH016",
        "duplicate node name '/rosout': roslaunch's own node has this name",
    )


def test_a_spawner_with_the_name_of_its_controller_ends() -> None:
    """The process of the manager makes the controller's node, too."""
    made = """
        //- /robot.launch.xml
        <launch>
          <node pkg="controller_manager" exec="ros2_control_node" name="manager"/>
          <node pkg="controller_manager" exec="{}" name="base"/>
        </launch>
        //- interfaces
        {{"/manager": {{"nodes": [{{"name": "manager", "given": "manager", "full": "/manager"}},
                                {{"name": "base", "given": "base", "full": "/base"}}]}}}}
    """
    for executable, severity in (("spawner", "info"), ("other", "warning")):
        (found,) = [each for each in findings_of(made.format(executable)) if each.rule == "LCH016"]
        assert (found.severity, found.message) == (
            severity,
            "duplicate node name '/base': the process of /manager creates it",
        )


def test_two_nodes_of_one_name() -> None:
    findings = findings_of("""
        <launch>
          <node pkg="p" type="t" name="n"/>
          <group ns="a"><node pkg="p" type="t" name="n"/></group>
          <node pkg="p" type="t" name="n"/>
        </launch>
    """)
    (finding,) = findings
    assert finding.rule == "LCH016"
    assert "'/n'" in finding.message
    assert finding.related[0].location.span < finding.location.span


def test_two_nodes_of_one_name_in_ros_2() -> None:
    check("""
        //- /robot.launch.yaml
        launch:
          - node: {pkg: p, exec: laser, name: laser}
          - node: {pkg: p, exec: laser, name: laser}
                                              ^^^^^ warning[LCH016] duplicate node name '/laser'
          - node: {pkg: p, exec: laser, name: laser, namespace: rear}
          - node: {pkg: p, exec: laser}
          - node: {pkg: p, exec: laser}
          - node: {pkg: p, exec: laser, name: laser, if: "false"}
    """)


@pytest.mark.silent
def test_one_name_in_two_namespaces_or_under_two_conditions() -> None:
    check("""
        <launch>
          <arg name="sim" default="true"/>
          <node pkg="p" type="t" name="n"/>
          <node pkg="p" type="t" name="n" ns="a"/>
          <node pkg="p" type="simulated" name="base" if="$(arg sim)"/>
          <node pkg="p" type="real" name="base" unless="$(arg sim)"/>
        </launch>
    """)


_SETUP = """
        //- /robot.launch.py
        from launch import LaunchDescription
        from launch_ros.actions import Node

        def generate_launch_description():
            name = "planner"
            grip = False
"""


def test_a_branch_of_a_python_launch_file_that_is_not_taken() -> None:
    check(f"""{_SETUP}
            planner = Node(package="p", executable="planner", name=name)
            nodes = [planner]
            if grip:
                gripper = Node(package="p", executable="gripper", name=name)
                                                                       ^^^^ info[LCH016] duplicate node name if `grip`
                nodes.append(gripper)
            return LaunchDescription(nodes)
    """)


@pytest.mark.silent
def test_branches_of_a_python_launch_file_of_which_one_is_taken() -> None:
    check(f"""{_SETUP}
            if grip:
                return LaunchDescription([Node(package="p", executable="a", name=name)])
            one = Node(package="p", executable="a", name=name)
            if name:
                one = Node(package="p", executable="b", name=name)
            if grip:
                two = Node(package="p", executable="a", name="two")
            else:
                two = Node(package="p", executable="b", name="two")
            nodes = [Node(package="p", executable="c", name="three")]
            if grip:
                nodes.append(Node(package="p", executable="c", name="three", namespace="left"))
                nodes.append(Node(package="p", executable="c", name="three", condition=grip))
                nodes.append(Node(package="p", executable="c", name=grip))
            for side in "ab":
                nodes.append(Node(package="p", executable="c", name="three"))
            return LaunchDescription([one, two, *nodes])
    """)


_HEAD = """
        //- /robot.launch.py
        from launch import LaunchDescription
        from launch.actions import DeclareLaunchArgument, GroupAction, IncludeLaunchDescription
        from launch.conditions import IfCondition
        from launch_ros.actions import Node, PushRosNamespace
        from mine import more, x
"""


@pytest.mark.parametrize(
    "body",
    [
        """
        def generate_launch_description():
            return LaunchDescription([
                Node(package="p", executable="a", name="one"),
                DeclareLaunchArgument("speed"),
                Node(package="p", executable="b", name="one"),
                                                        ^^^ warning[LCH016] duplicate node name '/one'
            ])
        """,
        """
        NAME = "one"

        def generate_launch_description():
            ld = LaunchDescription()
            first = Node(package="p", executable="a", name=NAME, namespace="left")
            nodes = [first]
            nodes.append(Node(package="p", executable="c", name="two"))
            ld.add_action(DeclareLaunchArgument("speed"))
            ld.add_action(first)
            ld.add_action(Node(package="p", executable="b", name="one", namespace="left"))
                                                                  ^^^ warning[LCH016] duplicate node name '/left/one'
            return ld
        """,
        """
        def generate_launch_description():
            drivers = [Node(package="p", executable="a", name="one")]
            others = [Node(package="p", executable="b", name="one")]
                                                              ^^^ warning[LCH016] duplicate node name '/one'
            return LaunchDescription(drivers + [*others])
        """,
    ],
)
def test_a_python_launch_file_that_was_not_run(body: str) -> None:
    check(_HEAD + body)


@pytest.mark.silent
@pytest.mark.parametrize(
    "statements",
    [
        'return LaunchDescription([a("one"), a("one", condition=IfCondition(x)), a("one", namespace="left")])',
        'return LaunchDescription([a("one"), PushRosNamespace("left"), a("one")])',
        'return LaunchDescription([a("one"), GroupAction([a("one")])])',
        'return LaunchDescription([a("one"), IncludeLaunchDescription("x.launch.py"), a("one")])',
        'return LaunchDescription([a("one"), a("one", **more)])',
        'return LaunchDescription([a("one") if x else a("one")])',
        'return LaunchDescription([a("one"), *(a("one") for side in x)])',
        'b = a("one"); return LaunchDescription([b, b])',
        'b = a("one"); c = a("one"); return LaunchDescription([c])  # or b',
        "b = a(x); return LaunchDescription([b, a(x)])",
        'ld = LaunchDescription([a("one")]); ld.add_action(more(x)); ld.add_action(a("one")); return ld',
        'ld = LaunchDescription([a("one")]); more(ld); ld.add_action(a("one")); return ld',
        'ld = LaunchDescription([a("one")]); ld.entities.pop(); ld.add_action(a("one")); return ld',
        'ld = LaunchDescription([a("one")]); ld = LaunchDescription([a("one")]); return ld',
    ],
)
def test_nodes_of_one_name_in_a_python_launch_file_that_need_not_meet(statements: str) -> None:
    made = statements.replace("a(", 'Node(package="p", executable="a", name=')
    body = "".join(f"            {each}\n" for each in made.split("; "))
    check(f"{_HEAD}\n        def generate_launch_description():\n{body}")


@pytest.mark.silent
def test_nodes_of_one_name_of_which_a_branch_returns_one() -> None:
    check(f"""{_HEAD}
        def generate_launch_description():
            if x:
                return LaunchDescription([Node(package="p", executable="a", name="one")])
            return LaunchDescription([Node(package="p", executable="b", name="one")])
    """)
