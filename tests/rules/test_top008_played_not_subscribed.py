"""TOP008: a player of a recording is given the name of a topic that nobody subscribes to."""

import pytest
from support.check import apply, check, findings_of


def test_a_slip_in_what_a_topic_of_the_recording_is_called() -> None:
    fixture = """
        <launch>
          <node pkg="p" type="mapper" name="mapper"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ hint[TOP001] '/scan'
          <node pkg="rosbag" type="play" name="play" args="--clock run.bag laser:=/scann"/>
                                                           ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[TOP008] '/scann' has no
        </launch>
        //- /rosbag/package.xml
        <package/>
        //- interfaces
        {"/mapper": {"subscribers": {"scan": "sensor_msgs/LaserScan"}}, "/play": {}}
    """
    (finding,) = [each for each in check(fixture) if each.rule == "TOP008"]
    assert 'laser:=/scan"' in apply(fixture, finding.fixes[0].edits)["/main.launch"]


def test_a_slip_in_a_topic_that_ros2_bag_plays() -> None:
    check("""
        //- /main.launch.xml
        <launch>
          <node pkg="p" exec="mapper" name="mapper"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ hint[TOP001] '/scan'
          <executable cmd="ros2 bag play run --topics /odom /scann -m /odom:=/x"/>
                           ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[TOP008] '/scann'
        </launch>
        //- interfaces
        {"/mapper": {"subscribers": {"scan": "sensor_msgs/msg/LaserScan"}}}
    """)


@pytest.mark.silent
def test_a_topic_that_is_subscribed_to() -> None:
    check("""
        <launch>
          <node pkg="p" type="mapper" name="mapper"/>
          <node pkg="p" type="laser" name="laser"/>
          <node pkg="rosbag" type="play" name="play" args="run.bag --topics /scan /scann"/>
        </launch>
        //- /rosbag/package.xml
        <package/>
        //- interfaces
        {"/mapper": {"subscribers": {"scan": "sensor_msgs/LaserScan"}},
         "/laser": {"publishers": {"scan": "sensor_msgs/LaserScan"}}, "/play": {}}
    """)


def test_topics_that_somebody_subscribes_to_or_that_are_like_none() -> None:
    check("""
        <launch>
          <node pkg="p" type="mapper" name="mapper"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ hint[TOP001] '/scan'
          <node pkg="p" type="laser" name="laser"/>
          <node pkg="rosbag" type="play" name="one" args="run.bag /laser:=/scan --topics /laser /image /odom"/>
          <node pkg="rosbag" type="play" name="two" args="run.bag --prefix=/old --topics /scann"/>
          <node pkg="rosbag" type="play" name="three" args="run.bag _a:=scann --topics /laser_scan">
            <remap from="/laser_scan" to="/scan"/>
          </node>
          <node pkg="rosbag" type="play" name="four" args="run.bag --topics /posee"/>
        </launch>
        //- /rosbag/package.xml
        <package/>
        //- interfaces
        {"/mapper": {"subscribers": {"scan": "sensor_msgs/LaserScan", "pose": "geometry_msgs/Pose"}},
         "/laser": {"publishers": {"pose": "geometry_msgs/Pose"}},
         "/one": {}, "/two": {}, "/three": {}, "/four": {}}
    """)


@pytest.mark.parametrize(("name", "state"), [("crashed", "crashed"), ("scann", "not-run")])
def test_a_node_that_may_subscribe_to_it_unseen(name: str, state: str) -> None:
    found = findings_of(f"""
        <launch>
          <node pkg="p" type="mapper" name="mapper"/>
          <node pkg="p" type="other" name="{name}"/>
          <node pkg="rosbag" type="play" name="play" args="run.bag laser:=/scann/points"/>
        </launch>
        //- /rosbag/package.xml
        <package/>
        //- interfaces
        {{"/mapper": {{"subscribers": {{"/scan/points": "sensor_msgs/LaserScan"}}}}, "/play": {{}},
          "/{name}": {{"status": "{state}"}}}}
    """)
    assert found
    assert "TOP008" not in {each.rule for each in found}
