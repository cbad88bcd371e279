"""QOS001: publisher and subscriber of a topic whose QoS does not fit (ROS 2)."""

import json
from pathlib import Path

import pytest
from preflight_analysis.rules.registry import run_rules
from support import package_elsewhere
from support.check import check


def test_qos_that_does_not_fit() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="laser" name="laser"/>
          <node pkg="p" exec="filter" name="filter"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ error[QOS001] incompatible QoS on '/scan': /laser publishes best
          <node pkg="p" exec="map" name="map"/>
          <node pkg="p" exec="nav" name="nav"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ error[QOS001] incompatible QoS on '/map': /map publishes volatile
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
        ({}, {"deadline": 0.5}, "/a publishes no deadline, /b requests deadline 0.5 s"),
        ({"deadline": 0.5}, {"deadline": 0.1}, "/a publishes deadline 0.5 s, /b requests deadline 0.1 s"),
        ({}, {"liveliness": "manual_by_topic"}, "/a publishes automatic liveliness"),
        ({}, {"lease_duration": 2.0}, "/a publishes no lease duration"),
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


@pytest.mark.silent
def test_qos_that_fits_or_is_not_known() -> None:
    check("""
        //- /robot.launch.xml
        <launch>
          <node pkg="p" exec="laser" name="laser"/>
          <node pkg="p" exec="filter" name="filter"/>
          <node pkg="p" exec="map" name="map"/>
        </launch>
        //- interfaces
        {"/laser": {"publishers": {"scan": "sensor_msgs/msg/LaserScan"}, "qos": {"scan": {"reliability": "reliable"}}},
         "/filter": {"subscribers": {"scan": "sensor_msgs/msg/LaserScan"},
                     "qos": {"scan": {"reliability": "best_effort"}}},
         "/map": {"subscribers": {"scan": "sensor_msgs/msg/LaserScan"}}}
    """)


def test_a_display_of_rviz_is_a_warning(tmp_path: Path) -> None:
    topic = "{Value: pointcloud, Reliability Policy: Reliable, Durability Policy: Transient Local}"
    display = f"{{Class: rviz_default_plugins/PointCloud, Enabled: true, Topic: {topic}}}"
    config = f"Visualization Manager: {{Displays: [{display}]}}"
    text = """<launch>
      <node pkg="rviz2" exec="send_lots_of_points_node"/>
      <node pkg="rviz2" exec="rviz2" name="rviz" args="-d $(dirname)/a.rviz"/>
    </launch>"""
    analysis = package_elsewhere.analysed(tmp_path, text, "a.launch.xml", "jazzy", **{"a.rviz": config})
    (finding,) = (each for each in run_rules(analysis.context) if each.rule == "QOS001")
    assert (finding.severity, finding.confidence) == ("warning", "likely")
    assert finding.location.file.endswith("/a.rviz")
