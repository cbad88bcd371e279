"""TOP005: two nodes publish a topic that is meant for one."""

from pathlib import Path

import pytest
from support.check import check, findings_of


def test_two_nodes_that_latch_a_map() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="map_server"/>
          <node pkg="p" type="t" name="slam"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[TOP005] '/map' has 2 publishers (/map_server and /slam): each
          <node pkg="p" type="t" name="planner"/>
        </launch>
        //- interfaces
        {"/map_server": {"publishers": {"map": "nav_msgs/OccupancyGrid"}, "latched": ["map"]},
         "/slam": {"publishers": {"map": "nav_msgs/OccupancyGrid"}, "latched": ["map"]},
         "/planner": {"subscribers": {"map": "nav_msgs/OccupancyGrid"}}}
    """)


def test_other_latched_topics_are_an_info_and_clock_a_warning() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="a"/>
          <node pkg="p" type="t" name="b"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[TOP005] '/clock' has 2 publishers (/a and /b): time jumps between
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ info[TOP005] '/mode' has 2 publishers (/a and /b): each latches its last
          <node pkg="p" type="t" name="c"/>
        </launch>
        //- interfaces
        {"/a": {"publishers": {"mode": "std_msgs/String", "/clock": "rosgraph_msgs/Clock"}, "latched": ["mode"]},
         "/b": {"publishers": {"mode": "std_msgs/String", "/clock": "rosgraph_msgs/Clock"}, "latched": ["mode"]},
         "/c": {"subscribers": {"mode": "std_msgs/String"}}}
    """)


@pytest.mark.silent
def test_several_publishers_are_fine_where_many_are_meant() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="a"/><node pkg="p" type="t" name="b"/><node pkg="p" type="t" name="c"/>
        </launch>
        //- interfaces
        {"/a": {"publishers": {"m": "visualization_msgs/Marker", "/tf_static": "tf2_msgs/TFMessage", "cmd": "x/T",
                               "state": "x/S"}, "latched": ["m", "/tf_static", "state"]},
         "/b": {"publishers": {"m": "visualization_msgs/Marker", "/tf_static": "tf2_msgs/TFMessage", "cmd": "x/T",
                               "state": "x/S"}, "latched": ["m", "/tf_static"]},
         "/c": {"subscribers": {"m": "visualization_msgs/Marker", "cmd": "x/T", "state": "x/S"}}}
    """)


@pytest.mark.parametrize(("line", "severity"), [(1, "info"), (3, "warning")])
def test_a_module_that_several_programs_import(tmp_path: Path, line: int, severity: str) -> None:
    module = tmp_path / "measure.py"
    module.write_text("pub = Publisher('/cropped', Image)\nclass Camera:\n    pub = Publisher('/cropped', Image)\n")
    end = f'{{"publishers": {{"/cropped": "sensor_msgs/Image"}}, "made": {{"/cropped": ["{module}", {line}]}}}}'
    for second, found in (("debug.py", severity), ("detect.py", "warning")):
        text = f"""
            <launch>
              <node pkg="p" type="detect.py" name="detect"/>
              <node pkg="p" type="{second}" name="other"/>
            </launch>
            //- interfaces
            {{"/detect": {end}, "/other": {end}}}
        """
        assert [f.severity for f in findings_of(text) if f.rule == "TOP005"] == [found]


def test_two_cameras_on_one_topic() -> None:
    text = """
        <launch>
          <group ns="head"><node pkg="p" type="t" name="left"/></group>
          <group ns="head"><node pkg="p" type="t" name="right"/></group>
                           ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[TOP005] '/head/image_raw' has 2 publishers
          <node pkg="p" type="t" name="viewer"/>
        </launch>
        //- interfaces
        {"/head/left": {"publishers": {"image_raw": "sensor_msgs/Image"}},
         "/head/right": {"publishers": {"image_raw": "sensor_msgs/Image"}},
         "/viewer": {"subscribers": {"/head/image_raw": "sensor_msgs/Image"}}}
    """
    check(text)
    told = {
        type_: [f.severity for f in findings_of(text.replace("sensor_msgs/Image", type_)) if f.rule == "TOP005"]
        for type_ in ("nav_msgs/Odometry", "sensor_msgs/JointState", "geometry_msgs/Twist", "std_msgs/String")
    }
    assert told == {
        "nav_msgs/Odometry": ["info"],
        "sensor_msgs/JointState": [],
        "geometry_msgs/Twist": [],
        "std_msgs/String": [],
    }


@pytest.mark.parametrize(("listener", "severity"), [("", "info"), ('<node pkg="q" type="t" name="c"/>', "warning")])
def test_copies_of_a_viewer_that_the_catalogue_has(listener: str, severity: str) -> None:
    told = '"source": "catalogue", "status": "not-run", "catalogued": "x"'
    viewer = f'{{{told}, "publishers": {{"marked": "sensor_msgs/Image"}}}}'
    other = ', "/c": {"subscribers": {"marked": "sensor_msgs/Image"}}' if listener else ""
    found = findings_of(f"""
        <launch><node pkg="p" type="view" name="a"/><node pkg="p" type="view" name="b"/>{listener}</launch>
        //- interfaces
        {{"/a": {viewer}, "/b": {viewer}{other}}}
    """)
    assert [f.severity for f in found if f.rule == "TOP005"] == [severity]
