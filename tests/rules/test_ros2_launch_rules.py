"""Rules on what ROS 2 accepts and then does not do: leaking configurations, containers, lifecycle nodes."""

from support.check import check


def test_an_argument_that_an_include_overwrites() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <arg name="name" default="robot"/>
          <include file="/camera.launch.xml">
            <arg name="name" value="front"/>
          </include>
          <node pkg="p" exec="base" name="$(var name)_base"/>
                                          ^^^^^^^^^^^ warning[ARG010] 'name' is 'front' here, no longer 'robot'
        </launch>
        //- /camera.launch.xml
        <launch>
          <arg name="name"/>
          <node pkg="p" exec="camera" name="$(var name)_camera"/>
        </launch>
    """)


def test_an_argument_that_an_included_file_sets() -> None:
    check("""
        //- /robot.launch.yaml
        launch:
          - arg: {name: mode, default: slow}
          - include: {file: /arm.launch.xml}
          - node: {pkg: p, exec: base, name: $(var mode)}
                                             ^^^^^^^^^^^ warning[ARG010] 'mode' is 'fast' here, no longer 'slow'
        //- /arm.launch.xml
        <launch>
          <let name="mode" value="fast"/>
          <log message="$(var mode)"/>
        </launch>
    """)


def test_arguments_that_stay_what_they_are() -> None:
    """In a group, with the same value, not used any more, or set by the file itself."""
    check("""
        //- /robot.launch.xml
        <launch>
          <arg name="name" default="robot"/>
          <arg name="rate" default="5"/>
          <group>
            <include file="/camera.launch.xml"><arg name="name" value="front"/></include>
          </group>
          <include file="/camera.launch.xml"><arg name="name" value="robot"/></include>
          <node pkg="p" exec="base" name="$(var name)_base"/>
          <let name="rate" value="10"/>
          <log message="$(var rate)"/>
          <include file="/camera.launch.xml"><arg name="name" value="rear"/></include>
          <let name="name" value="robot"/>
          <log message="$(var name)"/>
        </launch>
        //- /camera.launch.xml
        <launch>
          <arg name="name" default="camera"/>
          <log message="$(var name)"/>
        </launch>
    """)


def test_a_container_that_is_not_there() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <group>
            <push_ros_namespace namespace="robot"/>
            <node_container pkg="rclcpp_components" exec="component_container" name="vision" namespace=""/>
            <load_composable_node target="vision">
                                          ^^^^^^ warning[LCH034] no node '/vision'
              <composable_node pkg="p" plugin="p::Detector" name="detector"/>
            </load_composable_node>
            <load_composable_node target="/robot/vision">
              <composable_node pkg="p" plugin="p::Tracker" name="tracker"/>
            </load_composable_node>
          </group>
          <load_composable_node target="/elsewhere">
                                        ^^^^^^^^^^ hint[LCH034] no node '/elsewhere' is started by this launch
            <composable_node pkg="p" plugin="p::Mapper" name="mapper"/>
          </load_composable_node>
        </launch>
        //- /rclcpp_components/package.xml
        <package><name>rclcpp_components</name></package>
    """)


def test_the_only_container_is_meant_where_it_stays_empty() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <node_container pkg="p" exec="component_container" name="camera_container" namespace=""/>
          <load_composable_node target="cam_container">
                                        ^^^^^^^^^^^^^ warning[LCH034] did you mean '/camera_container'?
            <composable_node pkg="p" plugin="p::Mapper" name="mapper"/>
          </load_composable_node>
        </launch>
    """)


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
    check(launch.format(expected=f"{under} warning[LCH035] /map_server is a lifecycle node", x="{}"))
    change = '{"clients": {"/map_server/change_state": "lifecycle_msgs/srv/ChangeState"}}'
    check(launch.format(expected="", x=change))


def test_a_lifecycle_node_that_nobody_activates() -> None:
    check("""
        //- /map.launch.xml
        <launch>
          <node pkg="nav2_map_server" exec="map_server" name="map_server"/>
                                            ^^^^^^^^^^ info[LCH035] /map_server is a lifecycle node
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
                                        ^^^^^^^ info[LCH035] /unknown is a lifecycle node
          <node pkg="p" exec="other" name="other"/>
        </launch>
        //- interfaces
        {"/container": {"services": {"~/_container/load_node": "composition_interfaces/srv/LoadNode"}},
         "/plain": {"services": {"/reset": "std_srvs/srv/Empty"}}}
    """)


def test_a_lifecycle_manager_that_has_another_name() -> None:
    check("""
        //- /map.launch.xml
        <launch>
          <node pkg="nav2_map_server" exec="map_server" name="map_server"/>
          <node pkg="nav2_amcl" exec="amcl" name="amcl"/>
          <node pkg="nav2_lifecycle_manager" exec="lifecycle_manager" name="manager">
            <param name="node_names" value="[map_sever, amcl, planner]"/>
                         ^^^^^^^^^^ warning[LCH035] /manager waits for '/map_sever', which is no node of this launch
                         ^^^^^^^^^^ info[LCH035] /manager waits for '/planner', which is no node of this launch
          </node>
        </launch>
        //- /nav2_map_server/package.xml
        <package><name>nav2_map_server</name></package>
        //- /nav2_amcl/package.xml
        <package><name>nav2_amcl</name></package>
        //- /nav2_lifecycle_manager/package.xml
        <package><name>nav2_lifecycle_manager</name></package>
    """)


def test_what_may_be_activated() -> None:
    check("""
        //- /map.launch.xml
        <launch>
          <node pkg="nav2_map_server" exec="map_server" name="map_server"/>
          <executable cmd="ros2 lifecycle set /map_server configure"/>
        </launch>
        //- /nav2_map_server/package.xml
        <package><name>nav2_map_server</name></package>
    """)


def test_a_parameter_from_two_sources() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <set_parameter name="rate" value="1"/>
          <node pkg="p" exec="a" name="a">
            <param name="rate" value="10"/>
                         ^^^^ warning[PRM006] 'rate' of /a is set to '10' here, which does not count
            <param from="/a.yaml"/>
          </node>
          <node pkg="p" exec="b" name="b">
            <param from="/a.yaml"/>
            <param name="rate" value="10"/>
          </node>
          <node pkg="p" exec="c" name="c">
            <param name="rate" value="10"/>
                         ^^^^ warning[PRM006] which does not count: it is set again below
            <param name="rate" value="11"/>
          </node>
        </launch>
        //- /a.yaml
        /**:
          ros__parameters: {rate: 20}
    """)


def test_parameter_files_that_are_not_there() -> None:
    """launch goes on without that of a node."""
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="a" name="a"><param from="/no.yaml"/></node>
                                                       ^^^^^^^^ warning[PRM002] '/no.yaml' does not exist
          <node_container pkg="p" exec="component_container" name="box" namespace="">
            <composable_node pkg="p" plugin="p::A" name="b"><param from="/no.yaml"/></composable_node>
                                                                         ^^^^^^^^ error[PRM002] '/no.yaml'
          </node_container>
        </launch>
    """)


def test_a_parameter_file_whose_path_is_empty() -> None:
    """It is the current folder."""
    check("""
        //- /robot.launch.xml
        <launch>
          <arg name="params_file" default=""/>
          <node pkg="p" exec="a" name="a"><param from="$(var params_file)"/></node>
                                                       ^^^^^^^^^^^^^^^^^^ error[PRM003] parameter file '' cannot be read: argument 'params_file' is empty
        </launch>
    """)  # noqa: E501


def test_paths_packages_and_remaps_as_in_ros1() -> None:
    check("""
        //- /p/launch/robot.launch.yaml
        launch:
          - node:
              pkg: camera
                   ^^^^^^ hint[PKG004] package 'camera' is not among
              exec: driver
              name: $(find-pkg-share lidar)
                    ^^^^^^^^^^^^^^^^^^^^^^^ error[LCH009]
                                     ^^^^^ hint[PKG004] package 'lidar' is not among the dependencies
              remap:
                - {from: scan, to: scan}
        //- /p/package.xml
        <package><name>p</name><exec_depend>q</exec_depend></package>
        //- /camera/package.xml
        <package><name>camera</name></package>
        //- /lidar/package.xml
        <package><name>lidar</name></package>
    """)


def test_a_path_of_one_user() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="a" name="a" args="--map /home/bob/maps/lab.yaml">
                                                      ^^^^^^^^^^^^^^^^^^^^^^^ info[LCH021] in the home folder of one
            <remap from="scan" to="scan"/>
            ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ hint[LCH024] 'scan' is remapped to itself
            <remap from="image" to="/home/bob/image"/>
          </node>
        </launch>
    """)


def test_a_wildcard_after_the_name_and_a_value_after_both() -> None:
    """As real rclpy has it: `tests/evaluation/test_params_against_rclpy.py`."""
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="a" name="a">
            <param from="/wild_last.yaml"/>
          </node>
          <node pkg="p" exec="b" name="b">
            <param from="/wild_first.yaml"/>
            <param name="rate" value="10"/>
                         ^^^^ warning[PRM006] '/b' of the file before it counts more than '/**'
          </node>
          <node pkg="p" exec="b" name="b" namespace="own">
            <param from="/wild_first.yaml"/>
            <param name="rate" value="10"/>
          </node>
          <node_container pkg="p" exec="c" name="c" namespace="">
            <composable_node pkg="p" plugin="p::D" name="d" namespace="">
              <param from="/composable.yaml"/>
            </composable_node>
          </node_container>
        </launch>
        //- /wild_last.yaml
        /a:
          ros__parameters: {rate: 1}
                            ^^^^ warning[PRM006] to '1' here, which does not count: '/**' stands below it
        /**:
          ros__parameters: {rate: 2}
        //- /composable.yaml
        /d:
          ros__parameters: {rate: 1}
        /**:
          ros__parameters: {rate: 2}
        //- /wild_first.yaml
        /**:
          ros__parameters: {rate: 1}
        /b:
          ros__parameters: {rate: 2}
        /own/b:
          ros__parameters: {rate: 3}
    """)


def test_a_name_for_a_process_with_several_nodes() -> None:
    """As real rclpy has it: `tests/tracing/test_rclpy.py`."""
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="both" name="scanner"/>
                                          ^^^^^^^ warning[LCH037] the nodes 'front' and 'rear', and 'name' is for each
          <node pkg="p" exec="both" name="spaced"/>
                                          ^^^^^^ info[LCH037] for each of them: all are called 'spaced'
          <node pkg="p" exec="both" name="put" namespace="together"/>
                                          ^^^ warning[LCH037] all of them have the name '/together/put'
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


def test_an_argument_that_no_file_of_the_launch_uses() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <arg name="rate" default="10"/>
          <arg name="speed" default="1.0"/>
                     ^^^^^ hint[ARG008] argument 'speed' is declared and never used in this launch
          <arg name="in_file" default="1.0"/>
          <node pkg="p" exec="x" name="x"><param name="rate" value="$(var rate)"/></node>
          <node pkg="p" exec="y" name="y"><param from="/p.yaml" allow_substs="true"/></node>
        </launch>
        //- /p.yaml
        y:
          ros__parameters: {rate: $(var in_file)}
    """)
    check("""
        //- /robot.launch.xml
        <launch>
          <arg name="rate" default="10"/>
          <node pkg="p" exec="y" name="y"/>
          <include file="/inner.launch.xml"/>
        </launch>
        //- /inner.launch.xml
        <launch><node pkg="p" exec="x" name="x"><param name="rate" value="$(var rate)"/></node></launch>
    """)
    check("""
        //- /robot.launch.xml
        <launch>
          <arg name="a_b" default="10"/>
          <arg name="which" default="a_b"/>
          <log message="$(var $(var which))"/>
        </launch>
    """)


def test_the_first_remap_of_a_name_counts() -> None:
    remaps = '<remap from="scan" to="front"/><remap from="{}" to="{}"/>'
    under = "^" * len('<remap from="scan" to="rear"/>')
    before = " " * len('<node pkg="p" exec="x" name="x"><remap from="scan" to="front"/>')
    told = f"\n{before}{under} warning[LCH023] this remap has no effect on /x: 'scan' is remapped to 'front' before it"
    for source, target, expected in (("scan", "rear", told), ("scan", "front", ""), ("odom", "rear", "")):
        node = f'<node pkg="p" exec="x" name="x">{remaps.format(source, target)}</node>'
        check(f"//- /r.launch.xml\n<launch>\n{node}{expected}\n</launch>")
    check("""
        //- /robot.launch.xml
        <launch>
          <set_remap from="scan" to="/scan"/>
          <node pkg="p" exec="x" name="x" namespace="r"><remap from="/r/scan" to="rear"/></node>
                                                        ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[LCH023] 'scan' is
        </launch>
    """)
