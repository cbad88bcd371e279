"""LCH035: a lifecycle node that nothing activates (ROS 2)."""

from pathlib import Path

import pytest
from support import package_elsewhere
from support.check import check, findings_of


def test_a_lifecycle_node_beside_nodes_that_cannot_activate_it() -> None:
    launch = """
        //- /map.launch.xml
        <launch>
          <node pkg="nav2_map_server" exec="map_server" name="map_server"/>
          {expected}
          <node pkg="p" exec="x" name="x"/>
        </launch>
        //- /nav2_map_server/package.xml
        <package><name>nav2_map_server</name></package>
        //- interfaces
        {{"/map_server": {{"services": {{"~/change_state": "lifecycle_msgs/srv/ChangeState"}}}}, "/x": {x}}}
    """
    under = " " * len('<node pkg="nav2_map_server" exec="') + "^" * len("map_server")
    check(launch.format(expected=f"{under} warning[LCH035] lifecycle node /map_server is never", x="{}"))
    change = '{"clients": {"/map_server/change_state": "lifecycle_msgs/srv/ChangeState"}}'
    check(launch.format(expected="", x=change))


def test_a_lifecycle_node_that_nobody_activates() -> None:
    check("""
        //- /map.launch.xml
        <launch>
          <node pkg="nav2_map_server" exec="map_server" name="map_server"/>
                                            ^^^^^^^^^^ info[LCH035] lifecycle node /map_server is never activated by
        </launch>
        //- /nav2_map_server/package.xml
        <package><name>nav2_map_server</name></package>
    """)


def test_a_manager_of_components_has_no_lifecycle() -> None:
    """`LifecycleNode` starts whatever is given to it."""
    check("""
        //- /bus.launch.xml
        <launch>
          <lifecycle_node pkg="p" exec="container" name="container" namespace=""/>
          <lifecycle_node pkg="p" exec="plain" name="plain" namespace=""/>
          <lifecycle_node pkg="p" exec="unknown" name="unknown" namespace=""/>
                                        ^^^^^^^ info[LCH035] lifecycle node /unknown is never activated by this launch
          <node pkg="p" exec="other" name="other"/>
        </launch>
        //- interfaces
        {"/container": {"services": {"~/_container/load_node": "composition_interfaces/srv/LoadNode"}},
         "/plain": {"services": {"/reset": "std_srvs/srv/Empty"}}}
    """)


@pytest.mark.silent
def test_the_near_name_of_one_that_is_managed() -> None:
    """LCH044 says it at the name."""
    check("""
        //- /map.launch.xml
        <launch>
          <node pkg="nav2_map_server" exec="map_server" name="map_server"/>
          <node pkg="nav2_lifecycle_manager" exec="lifecycle_manager" name="manager">
            <param name="node_names" value="[map_sever]"/>
                         ^^^^^^^^^^ warning[LCH044] '/map_sever' is not a node of this launch; /manager waits
          </node>
        </launch>
        //- /nav2_map_server/package.xml
        <package><name>nav2_map_server</name></package>
        //- /nav2_lifecycle_manager/package.xml
        <package><name>nav2_lifecycle_manager</name></package>
    """)


@pytest.mark.silent
def test_a_command_line_that_activates_it() -> None:
    check("""
        //- /map.launch.xml
        <launch>
          <node pkg="nav2_map_server" exec="map_server" name="map_server"/>
          <node pkg="nav2_util" exec="lifecycle_bringup" args="map_server"/>
        </launch>
        //- /nav2_map_server/package.xml
        <package><name>nav2_map_server</name></package>
        //- /nav2_util/package.xml
        <package><name>nav2_util</name></package>
    """)


@pytest.mark.silent
def test_what_may_be_activated() -> None:
    check("""
        //- /map.launch.xml
        <launch>
          <node pkg="nav2_map_server" exec="map_server" name="map_server"/>
          <executable cmd="ros2 lifecycle set /map_server configure"/>
          <executable cmd="bash -c 'sleep 2; ros2 lifecycle set map_server activate'"/>
        </launch>
        //- /nav2_map_server/package.xml
        <package><name>nav2_map_server</name></package>
    """)


_CHANGES = '{"~/change_state": "lifecycle_msgs/srv/ChangeState"}'
_SERVES = '"services": {"~/change_state": "lifecycle_msgs/srv/ChangeState"}'


@pytest.mark.parametrize(
    ("driver", "other", "said"),
    [
        ("", "", "warning"),
        (', "transitions": ["configure"]', "", "warning"),
        (', "transitions": ["activate", "configure"]', "", None),
        ("", '"source": "source", "status": "not-run", "publishers": {"out": "std_msgs/msg/Empty"}', "info"),
        ("", '"source": "catalogue", "status": "not-run", "publishers": {"out": "std_msgs/msg/Empty"}', "warning"),
        (
            "",
            '"source": "source", "status": "not-run", "unnamed_calls": ["lifecycle_msgs/srv/ChangeState"]',
            None,
        ),
        ("", '"source": "source", "status": "not-run", "unnamed_calls": ["std_srvs/srv/Empty"]', "info"),
    ],
)
def test_a_node_whose_run_or_source_shows_that_it_is_one(driver: str, other: str, said: str | None) -> None:
    """A manager may have the names from a parameter."""
    found = findings_of(f"""
        //- /a.launch.xml
        <launch>
          <node pkg="p" exec="driver" name="driver"/>
          <node pkg="p" exec="other" name="other"/>
        </launch>
        //- interfaces
        {{"/driver": {{{_SERVES}{driver}}}, "/other": {{{other}}}}}
    """)
    assert [each.severity for each in found if each.rule == "LCH035"] == ([said] if said else [])


@pytest.mark.parametrize(
    ("source", "nodes", "services", "said"),
    [
        ("source", '[{"name": "driver", "given": "driver", "inferred": true}]', "{}", False),
        ("source", '[{"name": "driver", "given": "driver", "inferred": true}]', _CHANGES, True),
        ("source", '[{"name": "_tf", "given": "_tf", "inferred": true}]', "{}", True),
        ("source", "[]", "{}", True),
        ("catalogue", '[{"name": "driver", "given": "driver", "inferred": true}]', "{}", True),
    ],
)
def test_a_plain_node_that_the_launch_file_calls_a_lifecycle_node(
    source: str, nodes: str, services: str, *, said: bool
) -> None:
    """The catalogue has no services of lifecycles."""
    found = findings_of(f"""
        //- /a.launch.xml
        <launch>
          <lifecycle_node pkg="p" exec="driver" name="driver" namespace=""/>
          <node pkg="p" exec="other" name="other"/>
        </launch>
        //- interfaces
        {{"/driver": {{"source": "{source}", "status": "not-run", "nodes": {nodes}, "services": {services},
                       "publishers": {{"out": "std_msgs/msg/Empty"}}}}, "/other": {{}}}}
    """)
    assert [each.rule for each in found if each.rule == "LCH035"] == (["LCH035"] if said else [])


def test_a_launch_file_of_another_project_knows_no_nodes_but_its_own(tmp_path: Path) -> None:
    """That of the catalogue has an OpaqueFunction."""
    text = (
        '<launch><include file="$(find-pkg-share realsense2_camera)/launch/rs_launch.py"/>'
        '<node pkg="nav2_map_server" exec="map_server" name="map_server"/></launch>'
    )
    analysis = package_elsewhere.analysed(tmp_path, text, "a.launch.xml", "jazzy")
    (found,) = [each for each in analysis.findings if each.rule == "LCH035"]
    assert found.message.startswith("lifecycle node /map_server is never activated")
