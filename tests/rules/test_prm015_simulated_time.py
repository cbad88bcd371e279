"""PRM015: nodes on simulated time without a clock, or beside nodes that are not (ROS 2)."""

import pytest
from support.check import check


def test_simulated_time() -> None:
    launch = """
        //- /robot.launch.xml
        <launch>
          <set_parameter name="use_sim_time" value="true"/>
          {expected}
          <node pkg="p" exec="a" name="a"/>
          {clock}
        </launch>
        //- interfaces
        {interfaces}
    """
    told = '{"/a": {}, "/clock": {"publishers": {"/clock": "rosgraph_msgs/msg/Clock"}}}'
    # A <set_parameter> has no name location of its own: the whole tag is underlined.
    under = "^" * len('<set_parameter name="use_sim_time" value="true"/>')
    check(
        launch.format(
            expected=f"{under} info[PRM015] 'use_sim_time' is true, but '/clock' has no publisher",
            clock="",
            interfaces='{"/a": {}}',
        )
    )
    check(launch.format(expected="", clock='<node pkg="p" exec="clock" name="clock"/>', interfaces=told))


def test_simulated_time_is_shown_where_it_is_given() -> None:
    (finding,) = check("""
        //- /robot.launch.xml
        <launch>
          <arg name="time" default="true"/>
                                    ^^^^ info[PRM015] 'use_sim_time' is true, but '/clock' has no publisher in this
          <include file="/arm.launch.xml"><arg name="sim" value="$(var time)"/></include>
        </launch>
        //- /arm.launch.xml
        <launch>
          <arg name="sim" default="false"/>
          <arg name="other" default="true"/>
          <node pkg="p" exec="a" name="a"><param name="use_sim_time" value="$(var sim)"/></node>
          <node pkg="p" exec="b" name="b"><param name="c" value="$(var other)"/></node>
        </launch>
        //- interfaces
        {"/a": {}, "/b": {"params": {"c": false}}}
    """)
    assert finding.related[0].message == "set for /a here"
    assert finding.related[0].location.file == "/arm.launch.xml"


def test_a_plain_value_is_shown_where_it_is() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <arg name="c" default="true"/>
          <node pkg="p" exec="a" name="a">
            <param name="use_sim_time" value="true"/><param name="c" value="$(var c)"/>
                         ^^^^^^^^^^^^ info[PRM015] 'use_sim_time' is true, but '/clock' has no publisher in this
          </node>
        </launch>
        //- interfaces
        {"/a": {"params": {"c": false}}}
    """)


def test_nodes_on_two_clocks() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="clock" name="clock"/>
          <node pkg="p" exec="a" name="a"><param name="use_sim_time" value="true"/></node>
          <node pkg="p" exec="b" name="b"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ info[PRM015] 'use_sim_time' is not true for /b, but for 1 node of this
        </launch>
        //- interfaces
        {"/clock": {"publishers": {"/clock": "rosgraph_msgs/msg/Clock"}}}
    """)


@pytest.mark.silent
def test_the_clock_of_what_has_no_times_does_not_matter() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="clock" name="clock"/>
          <node pkg="p" exec="a" name="a"><param name="use_sim_time" value="true"/></node>
          <node pkg="p" exec="static_transform_publisher" name="fixed"/>
          <node pkg="ros_gz_sim" exec="create" name="create"/>
          <node pkg="ros_gz_bridge" exec="parameter_bridge" name="bridge"/>
          <node pkg="controller_manager" exec="spawner" name="spawner"/>
          <node_container pkg="p" exec="component_container" name="box" namespace="">
            <composable_node pkg="p" plugin="p::B" name="b" namespace=""><param name="use_sim_time" value="true"/>
            </composable_node>
          </node_container>
        </launch>
        //- /ros_gz_sim/package.xml
        <package><name>ros_gz_sim</name></package>
        //- /ros_gz_bridge/package.xml
        <package><name>ros_gz_bridge</name></package>
        //- /controller_manager/package.xml
        <package><name>controller_manager</name></package>
        //- interfaces
        {"/clock": {"publishers": {"/clock": "rosgraph_msgs/msg/Clock"}}}
    """)


_CLASSIC = """
    //- /sim.launch.xml
    <launch>
      <executable cmd="gzserver --verbose -s libgazebo_ros_factory.so beach.world {more}" name="server"/>
      {expected}
      <node pkg="p" exec="a" name="a"><param name="use_sim_time" value="true"/></node>
      <node pkg="gazebo_ros" exec="spawn_entity.py" name="spawn" args="-entity cart -topic robot_description"/>
    </launch>
    //- /gazebo_ros/package.xml
    <package format="3"><name>gazebo_ros</name></package>
    //- /workspace/.ros-preflight.yaml
    external: {{topics: [/robot_description]}}
    //- interfaces
    {{"/a": {{}}}}
"""


def test_gazebo_classic_without_the_plugin_that_has_the_clock() -> None:
    under = "^" * len('<executable cmd="gzserver --verbose -s libgazebo_ros_factory.so beach.world " name="server"/>')
    said = "'use_sim_time' is true for /a, but Gazebo starts without 'libgazebo_ros_init.so'"
    check(_CLASSIC.format(more="", expected=f"{under} warning[PRM015] {said}"))
    check(_CLASSIC.format(more="-s libgazebo_ros_init.so", expected=""))


_BRIDGED = """
    //- /sim.launch.xml
    <launch>
      <executable cmd="gz sim -r empty.sdf" name="gazebo"/>
      <node pkg="ros_gz_bridge" exec="parameter_bridge" name="bridge" args="{bridged}"/>
      {expected}
      <node pkg="p" exec="a" name="a"><param name="use_sim_time" value="true"/></node>
      <node pkg="p" exec="b" name="b"><param name="use_sim_time" value="true"/></node>
    </launch>
    //- /ros_gz_bridge/package.xml
    <package format="3"><name>ros_gz_bridge</name></package>
    //- interfaces
    {{"/a": {{}}, "/b": {{}}, "/bridge": {bridge}}}
"""


def test_no_bridge_has_the_clock_of_gazebo() -> None:
    info = "/stats@ros_gz_interfaces/msg/WorldStatistics[gz.msgs.WorldStatistics"
    clock = "/clock@rosgraph_msgs/msg/Clock[gz.msgs.Clock"
    under = "^" * len(f'<node pkg="ros_gz_bridge" exec="parameter_bridge" name="bridge" args="{info}"/>')
    said = "'use_sim_time' is true for /a and 1 more, but no bridge has Gazebo's '/clock'; time does not advance"
    check(_BRIDGED.format(bridged=info, expected=f"{under} warning[PRM015] {said}", bridge="{}"))
    published = '{"publishers": {"/clock": "rosgraph_msgs/msg/Clock"}}'
    check(_BRIDGED.format(bridged=f"{info} {clock}", expected="", bridge=published))
