"""What a world or model of Gazebo says."""

import pytest
from preflight_analysis.robot.model import IncludedModel
from preflight_analysis.robot.parse import parse_description
from preflight_analysis.robot.sdf import parse_sdf

_WORLD = """<?xml version="1.0"?>
<sdf version="1.9"><world name="w">
  <!-- <plugin filename="a" name="a"/> -->
  <plugin filename="gz-sim-imu-system" name="i"/>
  <gui><plugin filename="Teleop" name="t"/></gui>
  <include><uri>model://m</uri><name>n</name><plugin filename="p" name="p"><topic> t </topic></plugin></include>
  <model name="a">
    <link name="l"><sensor name="s" type="camera"><topic>t</topic>
      <camera><camera_info_topic>i</camera_info_topic></camera></sensor></link>
    <joint name="j"><sensor name="f" type="force_torque"/></joint>
    <model name="b"><link name="k"><sensor name="c" type="contact"><contact><topic>x</topic></contact></sensor></link>
    </model>
  </model>
</world></sdf>"""


def test_a_world_is_read() -> None:
    (world,) = parse_sdf(_WORLD) or ()
    assert (world.kind, world.name, [each.filename for each in world.plugins]) == ("world", "w", ["gz-sim-imu-system"])
    assert world.includes == (IncludedModel("model://m", "n"),)
    model, included = world.models
    assert [(each.name, each.within, dict(each.texts)) for each in model.sensors] == [
        ("s", "/link/l", {"topic": "t", "camera_info_topic": "i"}),
        ("f", "/joint/j", {}),
    ]
    assert [(each.type, dict(each.texts)) for each in model.models[0].sensors] == [("contact", {"topic": "x"})]
    assert (included.name, dict(included.plugins[0].params)) == ("n", {"topic": "t"})


@pytest.mark.parametrize("text", ["", "<sdf><world", "<robot name='r'/>", "x" * 10, "<sdf>&a;</sdf>"])
def test_what_is_no_sdf(text: str) -> None:
    assert not parse_sdf(text)


def test_models_in_models_have_an_end() -> None:
    deep = "<model name='m'>" * 100 + "</model>" * 100
    assert parse_sdf(f"<sdf>{deep}</sdf>")


def test_the_sensors_of_a_description() -> None:
    robot = parse_description(
        "<robot name='r'><gazebo reference='l'><sensor name='s' type='imu'><topic>imu</topic></sensor></gazebo></robot>"
    )
    (sensor,) = robot.sensors
    assert (sensor.type, sensor.within, dict(sensor.texts)) == ("imu", "/link/*", {"topic": "imu"})
