"""TOP002: a node publishes what nobody subscribes to."""

import pytest
from support.check import check, findings_of


def test_a_connected_graph_is_quiet_and_unused_topics_share_a_hint() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="base"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ hint[TOP002] '/battery', '/joint_states' and '/odom' have no subscriber
          <node pkg="p" type="t" name="teleop"/>
        </launch>
        //- interfaces
        {"/base": {"subscribers": {"cmd_vel": "x/T"},
                   "publishers": {"odom": "x/O", "battery": "x/B", "joint_states": "x/J"}},
         "/teleop": {"publishers": {"cmd_vel": "x/T"}}}
    """)


def test_an_image_that_is_read_compressed_is_read() -> None:
    check("""
        <launch>
          <node pkg="p" type="t" name="camera"/>
          <node pkg="p" type="t" name="web"/>
          <node pkg="p" type="t" name="spare"/>
          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ hint[TOP002] '/spare/image' has no subscriber in this launch
        </launch>
        //- interfaces
        {"/camera": {"publishers": {"image": "sensor_msgs/Image", "image/theora": "theora_image_transport/Packet",
                                    "image/compressed": "sensor_msgs/CompressedImage"}},
         "/spare": {"publishers": {"~image": "sensor_msgs/Image", "~image/compressed": "sensor_msgs/CompressedImage"}},
         "/web": {"subscribers": {"image/compressed": "sensor_msgs/CompressedImage"}}}
    """)


@pytest.mark.silent
def test_what_libraries_talk_about_among_themselves_is_no_finding() -> None:
    check("""
        <launch><node pkg="p" type="t" name="n"/></launch>
        //- interfaces
        {"/n": {"publishers": {"~bond": "bond/Status", "/tf": "tf2_msgs/TFMessage", "/diagnostics": "d/DiagnosticArray",
                               "~parameter_updates": "dynamic_reconfigure/Config",
                               "~parameter_descriptions": "dynamic_reconfigure/ConfigDescription"},
                "subscribers": {"/tf": "tf2_msgs/TFMessage", "/tf_static": "tf2_msgs/TFMessage",
                                "manager/bond": "bond/Status"},
                "services": {"~set_parameters": "dynamic_reconfigure/Reconfigure"}}}
    """)


def _twins(nodes: str) -> str:
    return f"""
        <launch>
          <node pkg="p" type="sensor" name="sensor" ns="a"/>
          <node pkg="p" type="sensor" name="sensor" ns="b"/>
          {nodes}
        </launch>
        //- interfaces
        {{"/a/sensor": {{"publishers": {{"level": "x/L"}}}}, "/b/sensor": {{"publishers": {{"level": "x/L"}}}},
          "/a/monitor": {{"subscribers": {{"level": "x/L"}}}}, "/b/monitor": {{"subscribers": {{"level": "x/L"}}}}}}
    """


_TO_B = '<node pkg="p" type="monitor" name="monitor" ns="a"><remap from="level" to="/b/level"/></node>'


def test_a_remap_to_the_topic_of_the_sibling() -> None:
    (found,) = findings_of(_twins(f'{_TO_B}<node pkg="p" type="monitor" name="monitor" ns="b"/>'))
    assert (found.rule, found.severity) == ("TOP002", "info")
    assert found.message.startswith(
        "/a/monitor is remapped to '/b/level' of /b/sensor: nobody subscribes to '/a/level'"
    )


def test_a_remap_to_what_nobody_else_of_its_kind_hears() -> None:
    (found,) = findings_of(_twins(f'{_TO_B}<node pkg="p" type="show" name="monitor" ns="b"/>'))
    assert (found.rule, found.severity) == ("TOP002", "hint")
