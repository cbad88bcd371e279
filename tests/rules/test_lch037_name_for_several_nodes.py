"""LCH037: a name for a process that has several nodes (ROS 2)."""

import pytest
from support.check import check


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
