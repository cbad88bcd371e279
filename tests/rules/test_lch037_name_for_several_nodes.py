"""LCH037: a name for a process that has several nodes (ROS 2)."""

import pytest
from support.check import apply, check, findings_of


def test_a_name_for_a_process_with_several_nodes() -> None:
    """As real rclpy has it: `tests/tracing/test_rclpy.py`."""
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="both" name="scanner"/>
                                          ^^^^^^^ warning[LCH037] 'name' renames all nodes of this process ('front'
          <node pkg="p" exec="both" name="spaced"/>
                                          ^^^^^^ info[LCH037] 'name' renames all nodes of this process ('front' and
          <node pkg="p" exec="both" name="put" namespace="together"/>
                                          ^^^ warning[LCH037] 'name' renames all nodes of this process ('front' and
          <node pkg="p" exec="one" name="main"/>
          <node pkg="p" exec="both"/>
        </launch>
        //- interfaces
        {"/scanner": {"nodes": [{"name": "scanner", "given": "front", "renamed": true},
                                {"name": "scanner", "given": "rear", "renamed": true}]},
         "/spaced": {"nodes": [{"name": "spaced", "given": "front", "space": "a", "renamed": true},
                               {"name": "spaced", "given": "rear", "space": "b", "renamed": true}]},
         "/together/put": {"nodes": [{"name": "put", "given": "front", "space": "a", "renamed": true},
                                     {"name": "put", "given": "rear", "space": "b", "renamed": true}]},
         "/main": {"nodes": [{"name": "main", "given": "one", "renamed": true}, {"name": "tf", "given": "_"}]},
         "/both": {"nodes": [{"name": "front", "given": "front"}, {"name": "rear", "given": "rear"}]}}
    """)


@pytest.mark.silent
def test_one_node_or_no_name() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="one" name="main"/>
          <node pkg="p" exec="both"/>
        </launch>
        //- interfaces
        {"/main": {"nodes": [{"name": "main", "given": "one", "renamed": true}, {"name": "tf", "given": "_"}]},
         "/both": {"nodes": [{"name": "front", "given": "front"}, {"name": "rear", "given": "rear"}]}}
    """)


_INTERFACES = """//- interfaces
{"/scanner": {"nodes": [{"name": "scanner", "given": "front", "renamed": true},
                        {"name": "scanner", "given": "rear", "renamed": true}]}}
"""


@pytest.mark.parametrize(
    ("file", "node", "after"),
    [
        (
            "robot.launch.xml",
            '<launch><node pkg="p" exec="both" name="scanner"/></launch>',
            ['<launch><node pkg="p" exec="both">', '<remap from="front:__node" to="scanner"/>', "</node></launch>"],
        ),
        (
            "robot.launch.xml",
            '<launch><let name="n" value="scanner"/><node pkg="p" exec="both" name="$(var n)"/></launch>',
            None,
        ),
        (
            "robot.launch.yaml",
            "launch: [{node: {pkg: p, exec: both, name: scanner}}]",
            ["launch: [{node: {pkg: p, exec: both, remap: [{from: front:__node, to: scanner}]}}]"],
        ),
        (
            "robot.launch.py",
            "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n"
            "def generate_launch_description():\n"
            "    return LaunchDescription([Node(package='p', executable='both', name='scanner', output='log')])",
            [
                "return LaunchDescription([Node(package='p', executable='both', output='log', "
                "remappings=[('front:__node', 'scanner')])])"
            ],
        ),
    ],
)
def test_one_of_the_nodes_is_renamed(file: str, node: str, after: list[str] | None) -> None:
    launch = f"//- /{file}\n{node}\n{_INTERFACES}"
    (finding,) = [each for each in findings_of(launch) if each.rule == "LCH037"]
    assert [fix.title for fix in finding.fixes] == (
        ["Rename 'front' only", "Rename 'rear' only"] if after is not None else []
    )
    for fix in finding.fixes[:1]:
        lines = apply(launch, fix.edits)[f"/{file}"].splitlines()
        assert [line.strip() for line in lines if line.strip()][-len(after or ()) :] == after
