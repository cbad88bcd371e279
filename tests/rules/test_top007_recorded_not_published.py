"""TOP007: a recorder is given the name of a topic that nobody publishes."""

import pytest
from support.check import apply, check, findings_of


def test_a_slip_in_a_topic_that_rosbag_records() -> None:
    fixture = """
        <launch>
          <node pkg="p" type="laser" name="laser"/>
          <group ns="robot">
            <node pkg="rosbag" type="record" name="record" args="-o run /odom /scann pose"/>
                                                                 ^^^^^^^^^^^^^^^^^^^^^^^^ warning[TOP007] '/scann'
          </group>
        </launch>
        //- /rosbag/package.xml
        <package/>
        //- interfaces
        {"/laser": {"publishers": {"scan": "sensor_msgs/LaserScan", "/robot/pose": "geometry_msgs/Pose"},
                    "subscribers": {"scan": null, "/robot/pose": null}},
         "/robot/record": {}}
    """
    (finding,) = check(fixture)
    assert 'run /odom /scan pose"' in apply(fixture, finding.fixes[0].edits)["/main.launch"]


def test_a_slip_in_a_topic_that_ros2_bag_records() -> None:
    check("""
        //- /main.launch.xml
        <launch>
          <node pkg="p" exec="laser" name="laser"/>
          <executable cmd="ros2 bag record -s mcap -o run --topics /odom /scann"/>
                           ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[TOP007] '/scann' has no
        </launch>
        //- interfaces
        {"/laser": {"publishers": {"scan": "sensor_msgs/msg/LaserScan"}, "subscribers": {"scan": null}}}
    """)


def test_a_node_of_which_nothing_is_known_may_publish_it() -> None:
    check("""
        <launch>
          <node pkg="p" type="laser" name="laser"/>
          <node pkg="p" type="other" name="other"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ info[TRC004] not run: /other
          <node pkg="rosbag" type="record" name="record" args="/scann"/>
                                                               ^^^^^^ info[TOP007] '/scann' has no publisher
        </launch>
        //- /rosbag/package.xml
        <package/>
        //- interfaces
        {"/laser": {"publishers": {"scan": "sensor_msgs/LaserScan"}, "subscribers": {"scan": null}}}
    """)


def test_a_topic_below_a_node_of_which_nothing_is_known() -> None:
    found = findings_of("""
        <launch>
          <node pkg="p" type="laser" name="laser"/>
          <node pkg="p" type="other" name="scann"/>
          <node pkg="rosbag" type="record" name="record" args="/scann/points"/>
        </launch>
        //- /rosbag/package.xml
        <package/>
        //- interfaces
        {"/laser": {"publishers": {"/scan/points": "sensor_msgs/LaserScan"}, "subscribers": {"/scan/points": null}},
         "/record": {}}
    """)
    assert [each.rule for each in found] == ["TRC004"]


def test_a_slip_in_what_libraries_call_so() -> None:
    fixture = """
        <launch>
          <arg name="f"/>
                     ^ info[ARG003] argument 'f' has no default
          <node pkg="rosbag" type="record" name="record" args="-O $(arg f) /head/compressdDepth"/>
                                                               ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[TOP007] mean
        </launch>
        //- /rosbag/package.xml
        <package/>
        //- interfaces
        {"/record": {}}
    """
    (finding,) = [each for each in check(fixture) if each.rule == "TOP007"]
    assert '/head/compressedDepth"' in apply(fixture, finding.fixes[0].edits)["/main.launch"]


@pytest.mark.silent
def test_topics_that_are_published_or_are_not_named() -> None:
    check("""
        <launch>
          <node pkg="p" type="laser" name="laser"/>
          <node pkg="rosbag" type="record" name="one" args="/scan /camera/image -O /scann --exclude /scann"/>
          <node pkg="rosbag" type="record" name="two" args="-e /scann"/>
          <node pkg="rosbag" type="record" name="three" args="laser_scan"><remap from="laser_scan" to="scan"/></node>
          <node pkg="rosbag" type="play" name="four" args="record --topics /scann"/>
        </launch>
        //- /rosbag/package.xml
        <package/>
        //- interfaces
        {"/laser": {"publishers": {"scan": "sensor_msgs/LaserScan"}, "subscribers": {"scan": null}},
         "/one": {}, "/two": {}, "/three": {}, "/four": {}}
    """)
