"""Rules on ROS 2's XML and YAML launch files."""

import json

from support.check import check


def test_a_value_that_is_not_among_the_choices() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <include file="/lidar.launch.yaml">
            <arg name="model" value="s1"/>
                                     ^^ error[ARG009] 'model' cannot be 's1'; it has the choices 'a1', 's2'
          </include>
          <include file="/lidar.launch.yaml">
            <arg name="model" value="s2"/>
          </include>
        </launch>
        //- /lidar.launch.yaml
        launch:
          - arg:
              name: model
              default: a1
              choice:
                - value: a1
                - value: s2
    """)


def test_what_launch_does_not_know_stops_it() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="talker" name="talker" nmae="x">
                                                    ^^^^ error[LCH005] <node> has no attribute 'nmae'
            <parm name="rate" value="1"/>
             ^^^^ error[LCH004] <parm> is not known in <node>; did you mean 'param'?
          </node>
          <let name="a" value="$(var b)"/>
                               ^^^^^^^^ error[ARG001] argument 'b' is not declared
        </launch>
    """)


def test_what_is_made_to_be_included_may_use_what_is_configured_there() -> None:
    check("""
        //- /part.launch.xml
        <launch>
          <arg name="robot"/>
          ^^^^^^^^^^^^^^^^^^^ info[ARG003] argument 'robot' has no default
          <node pkg="p" exec="x" name="a" namespace="$(var site)"/>
                                                     ^^^^^^^^^^^ info[ARG001] another launch file that includes this one
          <node pkg="p" exec="x" name="b" namespace="$(var robto)"/>
                                                     ^^^^^^^^^^^^ error[ARG001] did you mean 'robot'?
        </launch>
    """)


def test_yaml_in_the_middle_of_typing() -> None:
    check("""
        //- /robot.launch.yaml
        launch:
          - node:
              pkg: p
              exec: talker
              name: $(var nmae)
                    ^^^^^^^^^^^ error[ARG001] argument 'nmae' is not declared
          - node:
              pkg: p
              exec: [
                    ^ error[LCH001] while parsing a flow sequence
              nam
    """)


def test_a_condition_that_is_no_boolean() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <arg name="joystick" default="enabled"/>
          <group if="$(var joystick)">
                     ^^^^^^^^^^^^^^^ error[LCH008] if='enabled' of <group> is not true, false, 1 or 0
            <node pkg="p" exec="joy"/>
          </group>
          <group unless="$(equals $(var joystick) enabled)">
            <node pkg="nowhere" exec="$(var never)"/>
          </group>
        </launch>
    """)


def test_a_required_argument_counts_only_where_the_include_passes_it() -> None:
    """launch looks at what the include itself passes, whatever is set already."""
    check("""
        //- /robot.launch.xml
        <launch>
          <let name="serial" value="7"/>
          <include file="/camera.launch.xml"/>
                         ^^^^^^^^^^^^^^^^^^ error[ARG002] '/camera.launch.xml' requires argument 'serial'
          <include file="/camera.launch.xml"><arg name="serial" value="8"/></include>
        </launch>
        //- /camera.launch.xml
        <launch>
          <arg name="serial"/>
          <node pkg="p" exec="camera" name="camera_$(var serial)"/>
        </launch>
    """)


def test_an_argument_that_nobody_below_uses() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <arg name="deep" default="1"/>
          <include file="/arm.launch.xml">
            <arg name="robot_address" value="10.0.0.2"/>
                       ^^^^^^^^^^^^^ warning[ARG004] neither '/arm.launch.xml' nor what it includes declares or uses
            <arg name="speed" value="1"/>
            <arg name="deeper" value="2"/>
            <arg name="late" value="2"/>
          </include>
          <log message="$(var late)"/>
          <include file="/open.launch.xml"><arg name="any" value="1"/></include>
        </launch>
        //- /arm.launch.xml
        <launch>
          <arg name="robot_ip" default="10.0.0.1"/>
          <include file="/drive.launch.yaml"/>
          <group if="false"><log message="$(var speed)"/></group>
        </launch>
        //- /drive.launch.yaml
        launch:
          - arg: {name: deeper, default: '0'}
        //- /open.launch.xml
        <launch>
          <arg name="extra" default="false"/>
          <include file="$(find-pkg-share p)/extra.launch.py" if="$(var extra)"/>
        </launch>
    """)


def test_a_parameter_file_for_another_node() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="localizer" name="localizer">
            <param from="/amcl.yaml"/>
                         ^^^^^^^^^^ warning[PRM011] the file has nothing for /localizer
          </node>
          <group>
            <push_ros_namespace namespace="robot"/>
            <node pkg="p" exec="camera" name="camera"><param from="/nodes.yaml"/></node>
                                                                   ^^^^^^^^^^^ warning[PRM011] nothing for /robot/camera
            <node pkg="p" exec="arm" name="arm"><param from="/nodes.yaml"/></node>
            <node pkg="p" exec="lidar" name="lidar"><param from="/nodes.yaml"/></node>
          </group>
          <node pkg="p" exec="any" name="any"><param from="/any.yaml"/></node>
          <node pkg="p" exec="driver" name="driver"><param from="/shared.yaml"/></node>
          <node pkg="p" exec="free"><param from="/shared.yaml"/></node>
        </launch>
        //- /amcl.yaml
        amcl:
        ^^^^ warning[PRM011] '/amcl' is no node that gets this file: /localizer does, and ignores it
          ros__parameters: {max_particles: 800}
        //- /nodes.yaml
        /robot/arm:
          ros__parameters: {speed: 1}
        robot:
          camra:
          ^^^^^ warning[PRM011] '/robot/camra' is no node that gets this file
            ros__parameters: {rate: 1}
        //- /shared.yaml
        costmap:
          ros__parameters: {rate: 1}
        //- /any.yaml
        /**:
          ros__parameters: {rate: 1}
    """)


def test_a_key_without_the_namespace_of_its_node() -> None:
    """As real rclpy has it: `tests/evaluation/test_params_against_rclpy.py`."""
    findings = check("""
        //- /robot.launch.xml
        <launch>
          <group>
            <push_ros_namespace namespace="front"/>
            <node pkg="p" exec="camera" name="camera"><param from="/cameras.yaml"/></node>
            <node pkg="p" exec="lidar" name="lidar"><param from="/lidars.yaml"/></node>
                                                                 ^^^^^^^^^^^^ warning[PRM011] the file has nothing for /front/lidar
            <node pkg="p" exec="arm" name="arm"><param from="/all.yaml"/></node>
            <node pkg="p" exec="hand" name="hand"><param from="/all.yaml"/></node>
          </group>
          <node pkg="p" exec="camera" name="camera" namespace="rear"><param from="/cameras.yaml"/></node>
        </launch>
        //- /cameras.yaml
        /**:
          ros__parameters: {frame: map}
        camera:
        ^^^^^^ warning[PRM011] '/camera' is no node that gets this file: /front/camera and /rear/camera do, and ignore it
          ros__parameters: {rate: 30}
        //- /lidars.yaml
        lidar:
        ^^^^^ warning[PRM011] '/lidar' is no node that gets this file: /front/lidar does, and ignores it
          ros__parameters: {rate: 10}
        //- /all.yaml
        /**:
          ros__parameters: {frame: map}
        arm:
          ros__parameters: {speed: 1}
        /front/arm:
          ros__parameters: {speed: 2}
        /*/hand:
          ros__parameters: {speed: 2}
        hand:
          ros__parameters: {speed: 1}
        gripper:
          ros__parameters: {speed: 1}
    """)  # noqa: E501
    assert [fix.title for finding in findings if "rear" in finding.message for fix in finding.fixes] == [
        "Write '/**/camera' as the key"
    ]


def test_values_above_the_mark() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="a" name="a"><param from="/a.yaml"/></node>
        </launch>
        //- /a.yaml
        a:
          rate: 30
          ^^^^ error[PRM012] 'rate' does not stand below 'ros__parameters'
          name: front
    """)


def test_a_component_takes_a_file_without_the_mark() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <node_container pkg="p" exec="x" name="c" namespace="">
            <composable_node pkg="p" plugin="p::A" name="a"><param from="/a.yaml"/></composable_node>
          </node_container>
        </launch>
        //- /a.yaml
        rate: 30
        //- interfaces
        {"/a": {"params": {"~rate": 1}}}
    """)


def test_two_nodes_of_one_name() -> None:
    check("""
        //- /robot.launch.yaml
        launch:
          - node: {pkg: p, exec: laser, name: laser}
          - node: {pkg: p, exec: laser, name: laser}
                                              ^^^^^ warning[LCH016] there is another node with the name '/laser'
          - node: {pkg: p, exec: laser, name: laser, namespace: rear}
          - node: {pkg: p, exec: laser}
          - node: {pkg: p, exec: laser}
          - node: {pkg: p, exec: laser, name: laser, if: "false"}
    """)


def test_a_parameter_that_is_not_declared() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="pump" name="pump">
            <param name="max_presure" value="4.5"/>
                         ^^^^^^^^^^^ warning[PRM013] /pump declares no parameter 'max_presure'
            <param name="use_sim_time" value="false"/>
            <param name="gains.p" value="4.5"/>
          </node>
          <node pkg="p" exec="any" name="any"><param from="/any.yaml"/></node>
          <node pkg="p" exec="takes_all" name="takes_all"><param name="b" value="1"/></node>
          <node pkg="p" exec="unknown" name="unknown"><param name="b" value="1"/></node>
        </launch>
        //- /any.yaml
        any:
          ros__parameters:
            gains:
              q: 1.0
              ^ warning[PRM013] /any declares no parameter 'gains.q'
            speed: 2.0
        //- interfaces
        {"/pump": {"params": {"~max_pressure": 6.0, "~gains.p": 1.0}},
         "/any": {"params": {"~gains.p": 1.0, "~speed": 1.0}},
         "/takes_all": {"params": {"~a": 1, "/": {"access": "list"}}}}
    """)


def test_parameters_that_are_written_once_for_several_nodes() -> None:
    """Each takes what it declares: `speed` is one node's, `gain` perhaps the unknown one's, `limt` nobody's."""
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="left" name="left"><param from="/all.yaml"/></node>
          <node pkg="p" exec="right" name="right"><param from="/all.yaml"/></node>
          <node pkg="p" exec="unknown" name="unknown"><param from="/some.yaml"/></node>
          <node pkg="p" exec="left" name="other"><param from="/some.yaml"/></node>
        </launch>
        //- /all.yaml
        /**:
          ros__parameters:
            speed: 1.0
            limt: 2.0
            ^^^^ warning[PRM013] /left declares no parameter 'limt'
            ^^^^ warning[PRM013] /right declares no parameter 'limt'
        //- /some.yaml
        /**:
          ros__parameters:
            gain: 1.0
        //- interfaces
        {"/left": {"params": {"~speed": 6.0, "~limit": 1.0}},
         "/right": {"params": {"~limit": 1.0}},
         "/other": {"params": {"~limit": 1.0}}}
    """)


def test_a_parameter_of_another_type() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="pump" name="pump">
            <param name="rate" value="5"/>
                         ^^^^ error[PRM014] 'rate' is an integer, and /pump declares it as a double: the node stops
            <param name="speed" value="5.0"/>
            <param name="names" value="[a, b]"/>
            <param name="count" value="'5'"/>
                         ^^^^^ error[PRM014] 'count' is a string, and /pump declares it as an integer
            <param name="free" value="1"/>
            <param name="empty" value="[1, 2]"/>
          </node>
        </launch>
        //- interfaces
        {"/pump": {"params": {"~rate": 10.0, "~speed": 1.0, "~names": ["x"], "~count": 1, "~free": null, "~empty": []}}}
    """)


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
            expected=f"{under} info[PRM015] use_sim_time is true, and no node of this launch publishes /clock",
            clock="",
            interfaces='{"/a": {}}',
        )
    )
    check(launch.format(expected="", clock='<node pkg="p" exec="clock" name="clock"/>', interfaces=told))


def test_nodes_on_two_clocks() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="clock" name="clock"/>
          <node pkg="p" exec="a" name="a"><param name="use_sim_time" value="true"/></node>
          <node pkg="p" exec="b" name="b"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ info[PRM015] true for 1 node of this launch and not for /b
        </launch>
        //- interfaces
        {"/clock": {"publishers": {"/clock": "rosgraph_msgs/msg/Clock"}}}
    """)


def test_the_clock_of_what_has_no_times_does_not_matter() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="clock" name="clock"/>
          <node pkg="p" exec="a" name="a"><param name="use_sim_time" value="true"/></node>
          <node pkg="p" exec="static_transform_publisher" name="fixed"/>
          <node_container pkg="p" exec="component_container" name="box" namespace="">
            <composable_node pkg="p" plugin="p::B" name="b" namespace=""><param name="use_sim_time" value="true"/>
            </composable_node>
          </node_container>
        </launch>
        //- interfaces
        {"/clock": {"publishers": {"/clock": "rosgraph_msgs/msg/Clock"}}}
    """)


def test_qos_that_does_not_fit() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="laser" name="laser"/>
          <node pkg="p" exec="filter" name="filter"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ error[QOS001] /filter gets nothing of '/scan' from /laser
          <node pkg="p" exec="map" name="map"/>
          <node pkg="p" exec="nav" name="nav"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ error[QOS001] its durability is volatile
        </launch>
        //- interfaces
        {"/laser": {"publishers": {"scan": "sensor_msgs/msg/LaserScan"},
                    "qos": {"scan": {"reliability": "best_effort"}}},
         "/filter": {"subscribers": {"scan": "sensor_msgs/msg/LaserScan"},
                     "qos": {"scan": {"reliability": "reliable"}}},
         "/map": {"publishers": {"map": "nav_msgs/msg/OccupancyGrid"},
                  "qos": {"map": {"reliability": "reliable", "durability": "volatile"}}},
         "/nav": {"subscribers": {"map": "nav_msgs/msg/OccupancyGrid", "scan": "sensor_msgs/msg/LaserScan"},
                  "qos": {"map": {"reliability": "reliable", "durability": "transient_local"},
                          "scan": {"reliability": "best_effort"}}}}
    """)


def test_what_a_publisher_does_not_promise() -> None:
    for offered, asked, said in (
        ({}, {"deadline": 0.5}, "it promises no deadline, and the subscription asks for 0.5 s"),
        ({"deadline": 0.5}, {"deadline": 0.1}, "its deadline is 0.5 s"),
        ({}, {"liveliness": "manual_by_topic"}, "its liveliness is automatic"),
        ({}, {"lease_duration": 2.0}, "it promises no lease duration"),
        ({"lease_duration": 1.0, "deadline": 0.1}, {"lease_duration": 2.0, "deadline": 0.1}, None),
    ):
        plain = {"reliability": "reliable", "durability": "volatile"}
        interfaces = {
            "/a": {"publishers": {"x": "std_msgs/msg/String"}, "qos": {"x": {**plain, **offered}}},
            "/b": {"subscribers": {"x": "std_msgs/msg/String"}, "qos": {"x": {**plain, **asked}}},
        }
        expected = "" if said is None else f"\n{'^' * len('<node pkg=.p. exec=.b. name=.b./>')} error[QOS001] {said}"
        check(
            "//- /r.launch.xml\n<launch>\n<node pkg='p' exec='a' name='a'/>\n<node pkg='p' exec='b' name='b'/>"
            f"{expected}\n</launch>\n//- interfaces\n{json.dumps(interfaces)}"
        )
    unknown = {"/a": {"publishers": {"x": "T"}}, "/b": {"subscribers": {"x": "T"}, "qos": {"x": {"deadline": 1.0}}}}
    check(
        "//- /r.launch.xml\n<launch>\n<node pkg='p' exec='a' name='a'/>\n<node pkg='p' exec='b' name='b'/>\n"
        f"</launch>\n//- interfaces\n{json.dumps(unknown)}"
    )


def test_comments_of_ours_in_yaml() -> None:
    check("""
        //- /robot.launch.yaml
        launch:
          # preflight: <topics><topic name="chatter" type="std_msgs/msg/String" class="pub"/></topics>
          - node: {pkg: p, exec: talker, name: talker}
          # preflight: <topics>
          #   <topic name="chater" type="std_msgs/msg/String" class="sub"/>
          # </topics>
          - node:
            ^^^^ warning[TOP001] publishes '/chater', to which /listener subscribes; did you mean '/chatter'
              pkg: p
              exec: listener
              name: listener
          # preflight: ignore[LCH016] two of them, on purpose
          - node: {pkg: p, exec: talker, name: talker}
          - log: {message: $(var nothing)}  # preflight: ignore[ARG001] never reached
          - log: {message: hello}  # preflight: ignore[ARG001] not needed
                                                       ^^^^^^ warning[LCH019]
    """)


def test_an_attribute_that_ros2_needs() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <load_composable_node target="/box">
                                        ^^^^ hint[LCH034] no node '/box' is started by this launch
            <composable_node pkg="p" plugin="p::A" nam="a"/>
             ^^^^^^^^^^^^^^^ error[LCH006] <composable_node> needs 'name'; is 'nam' meant to be it?
          </load_composable_node>
        </launch>
    """)


def test_a_process_has_no_package() -> None:
    check("""
        //- /a.launch.xml
        <launch><executable cmd="echo hello"/></launch>
    """)


def test_substitutions_of_python() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
        <log message="$(FindPackage p)"/>
                      ^^^^^^^^^^^^^^^^ error[LCH011] 'FindPackage' is not a substitution; did you mean 'find-pkg-share'?
        <log message="$(PythonExpression 1)"/>
                      ^^^^^^^^^^^^^^^^^^^^^ error[LCH011] 'PythonExpression' is not a substitution; did you mean 'eval'?
        </launch>
    """)


def test_substitutions_of_ros1() -> None:
    check("""
        //- /robot.launch.yaml
        launch:
          - include: {file: $(find p)/base.launch.xml}
                            ^^^^^^^^^ error[LCH011] 'find' is not a substitution; did you mean 'find-pkg-share'?
    """)


def test_an_argument_that_a_file_which_cannot_be_read_may_set() -> None:
    """Real launch files rely on that: Autoware's take half of their arguments from included ones."""
    check("""
        //- /robot.launch.xml
        <launch>
          <arg name="camera" default="front"/>
          <group>
            <include file="/gone.launch.xml"/>
                           ^^^^^^^^^^^^^^^^ error[LCH013]
            <log message="$(var lidar)"/>
                          ^^^^^^^^^^^^ hint[ARG001] nothing that could be read declares argument 'lidar'
            <log message="$(var camra)"/>
                          ^^^^^^^^^^^^ warning[ARG001] declares argument 'camra'; did you mean 'camera'?
          </group>
          <log message="$(var lidar)"/>
                        ^^^^^^^^^^^^ error[ARG001] argument 'lidar' is not declared
        </launch>
    """)


def test_a_parameter_of_another_type_than_it_arrives_with() -> None:
    """As real rclpy has it: `tests/evaluation/test_types_against_rclpy.py`."""
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="a" name="a">
            <param name="rate" value="5"/>
                         ^^^^ error[PRM014] 'rate' is an integer, and /a declares it as a double: the node stops
            <param name="gains" value="[1, 2]"/>
                         ^^^^^ error[PRM014] 'gains' is a list of integers, and /a declares it as a list of doubles
            <param name="axis" value="y" type="str"/>
                         ^^^^ error[PRM014] launch hands over 'y' without quotes, which rcl reads as a bool
            <param name="any" value="5"/>
            <param name="kind" value="5"/>
                         ^^^^ error[PRM014] 'kind' is an integer, and /a declares it as a string
            <param name="frames" value="[a, b]"/>
                         ^^^^^^ error[PRM014] and /a declares it as bytes (which an empty list means)
            <param from="/a.yaml"/>
          </node>
        </launch>
        //- /a.yaml
        a:
          ros__parameters:
            side: y
            ^^^^ error[PRM014] 'side' is a bool, and /a declares it as a string: the node stops
            name: "y"
            none: []
            ^^^^ error[PRM014] 'none' is an empty list, which has no type
        //- interfaces
        {"/a": {"params": {"~rate": 10.0, "~gains": [1.0], "~axis": "x", "~any": 1.0, "~side": "x", "~name": "x",
                           "~none": [1.0], "~kind": null, "~frames": []},
                "described": {"~any": {"dynamic": true}, "~kind": {"type": "string"},
                              "~frames": {"type": "byte array"}}}}
    """)


def test_simulated_time_that_is_no_bool() -> None:
    """As real rclpy has it: `tests/evaluation/test_types_against_rclpy.py`."""
    check("""
        //- /robot.launch.yaml
        launch:
          - set_parameter: {name: use_sim_time, value: "'true'"}
            ^^^^^^^^^^^^^ error[PRM014] 'use_sim_time' is a string, and /a declares it as a bool: the node stops when it declares it (InvalidParameterTypeException); write it without quotes
          - node: {pkg: p, exec: a, name: a}
          - node: {pkg: p, exec: b, name: b}
          - node:
              pkg: p
              exec: c
              name: c
              param:
                - {name: use_sim_time, value: 1}
                         ^^^^^^^^^^^^ error[PRM014] 'use_sim_time' is an integer, and /c declares it as a bool
          - node:
              pkg: p
              exec: d
              name: d
              param:
                - {from: /d.yaml}
          - node:
              pkg: p
              exec: e
              name: e
              param:
                - {name: use_sim_time, value: false}
        //- /d.yaml
        d:
          ros__parameters:
            use_sim_time: yes please
            ^^^^^^^^^^^^ error[PRM014] 'use_sim_time' is a string, and /d declares it as a bool
        //- interfaces
        {"/a": {}}
    """)  # noqa: E501


def test_a_parameter_out_of_its_range() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="a" name="a">
            <param name="rate" value="11"/>
                         ^^^^ error[PRM017] 'rate' is 11, which is out of range: /a declares it for 0 to 10, and stops
            <param name="even" value="3"/>
                         ^^^^ error[PRM017] which is none of the steps: /a declares it for 0 to 10 in steps of 2
            <param name="last" value="10"/>
            <param name="part" value="0.3"/>
            <param name="over" value="1.01"/>
                         ^^^^ error[PRM017] 'over' is 1.01, which is out of range
            <param name="fixed" value="3"/>
            <param name="any" value="3"/>
            <param name="dense" value="3.3"/>
          </node>
        </launch>
        //- interfaces
        {"/a": {"params": {"~rate": 5, "~even": 2, "~last": 0, "~part": 0.1, "~over": 1.0, "~fixed": 1, "~any": 1,
                           "~dense": 1.0},
                "described": {"~rate": {"range": [0, 10]}, "~even": {"range": [0, 10, 2]},
                              "~last": {"range": [0, 10, 3]},
                              "~part": {"range": [0.0, 1.0, 0.1], "type": "double"}, "~fixed": {"read_only": true},
                              "~over": {"range": [0.0, 1.0]}, "~any": {"dynamic": true, "range": [0, 1]},
                              "~dense": {"range": [0.0, 10.0, 1e-320]}}}}
    """)


def test_what_a_parameter_file_cannot_have() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="a" name="a"><param from="/a.yaml"/></node>
          <node_container pkg="p" exec="c" name="c" namespace="">
            <composable_node pkg="p" plugin="p::D" name="d" namespace="/b"><param from="/d.yaml"/></composable_node>
          </node_container>
        </launch>
        //- /d.yaml
        /b:
          /d:
            ros__parameters: {x: 1}
        //- /a.yaml
        a:
          ros__parameters:
            gains: [1, 2.5]
                   ^^^^^^^^ error[PRM016] a list with doubles and integers in it: 'gains'; the client libraries refuse
            grid: [[1, 2], [3, 4]]
                  ^^^^^^^^^^^^^^^^ error[PRM016] a list of lists: 'grid'
            tilde: ~
            fine: [1.0, 2.5]
        /b:
        ^^ error[PRM016] a node's name with two slashes: '/b//c'
          /c:
            ros__parameters: {x: 1}
    """)


def test_one_bad_value_stops_each_node_that_gets_the_file() -> None:
    """As real rclpy has it: `tests/evaluation/test_types_against_rclpy.py`."""
    findings = check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="a" name="a"><param from="/a.yaml"/></node>
          <node pkg="p" exec="b" name="b"><param from="/a.yaml"/></node>
          <node pkg="p" exec="c" name="c"><param name="axes" value="[x, y, z]"/></node>
                                                       ^^^^ error[PRM016] 'axes' arrives as a list with bools and texts in it, as launch hands it over without quotes: /c does not start
          <node pkg="p" exec="d" name="d"><param name="axes" value="[a, b]"/></node>
        </launch>
        //- /a.yaml
        a:
          ros__parameters:
            axes: [x, y, z]
                  ^^^^^^^^^ error[PRM016] a list with bools and texts in it: 'axes'; the client libraries refuse the whole file for it, and none of the 2 nodes that get it starts
            quoted: [x, "y", z]
        b:
          ros__parameters: {rate: 1}
    """)  # noqa: E501
    (of_file,) = (finding for finding in findings if finding.location.file == "/a.yaml")
    assert [each.message for each in of_file.related] == ["/a gets the file here", "/b gets the file here"]


def test_a_parameter_file_whose_substitutions_launch_makes() -> None:
    """What they come to is not in the text: `[$(var a), 2.5]` is a list of doubles, and a key may become any name."""
    check("""
        //- /robot.launch.xml
        <launch>
          <arg name="gain" default="1.5"/>
          <arg name="name" default="arm"/>
          <node pkg="p" exec="arm" name="$(var name)">
            <param from="/named.yaml" allow_substs="true"/>
            <param from="/gains.yaml" allow_substs="true"/>
          </node>
        </launch>
        //- /named.yaml
        $(var name):
          ros__parameters:
            gains: [$(var gain), 2.5]
        //- /gains.yaml
        arm:
          ros__parameters:
            offsets: [1, 2.5]
                     ^^^^^^^^ error[PRM016] a list with doubles and integers in it: 'offsets'
    """)


def test_a_substitution_in_a_parameter_file_that_nobody_makes() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="arm" name="arm"><param from="/gains.yaml"/></node>
        </launch>
        //- /gains.yaml
        arm:
          ros__parameters:
            gains: [$(var gain), 2.5]
                   ^^^^^^^^^^^^^^^^^^ error[PRM016] a list with doubles and texts in it: 'gains'
    """)


def test_arguments_that_launch_itself_reads_are_used() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <arg name="launch-prefix" default=""/>
          <arg name="emulate_tty" default="true"/>
          <arg name="rate" default="5"/>
                     ^^^^ hint[ARG008] argument 'rate' is declared and never used
          <node pkg="p" exec="e" name="n"/>
        </launch>
    """)
