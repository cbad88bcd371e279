"""Defects of published collections (ROSDiscover's, ROBUST's) and of forums, cut down to their connection: each is told
as a warning at the right place, and nothing is left of it once it is mended."""

import pytest
from support.check import check, findings_of

_ODOMETRY_RENAMED = """
    <launch>
      <node pkg="p" type="t" name="state_estimator">
        <remap from="gps_imu/pose" to="pose_estimate_new"/>
                                       ^^^^^^^^^^^^^^^^^ warning[TOP001] '/pose_estimate_new', published by
      </node>
      <node pkg="p" type="t" name="wheel_odometry"/>
    </launch>
    //- interfaces
    {"/state_estimator": {"publishers": {"gps_imu/pose": "nav_msgs/Odometry"}},
     "/wheel_odometry": {"subscribers": {"pose_estimate": "nav_msgs/Odometry"}}}
"""

_LASER_REMAPPED_AWAY = """
    <launch>
      <include file="/spawn.launch"/>
      <node pkg="p" type="t" name="amcl"/>
    </launch>
    //- /spawn.launch
    <launch>
      <node pkg="p" type="t" name="depth_to_scan">
        <remap from="scan" to="camera/scan"/>
                               ^^^^^^^^^^^ warning[TOP001] '/camera/scan', published by /depth_to_scan: did you mean
      </node>
    </launch>
    //- interfaces
    {"/depth_to_scan": {"publishers": {"scan": "sensor_msgs/LaserScan"}},
     "/amcl": {"subscribers": {"scan": "sensor_msgs/LaserScan"}}}
"""

_CONSTANT_DEPTH_TOPIC = """
    <launch>
      <arg name="depth" value="depth_registered"/>
      <group ns="camera"><node pkg="p" type="t" name="driver"/></group>
      <node pkg="p" type="t" name="depth_to_scan">
        <remap from="image" to="camera/depth/image_raw"/>
                                ^^^^^^^^^^^^^^^^^^^^^^ warning[TOP001] '/camera/depth_registered/image_raw'
        <remap from="info" to="camera/$(arg depth)/camera_info"/>
      </node>
    </launch>
    //- interfaces
    {"/camera/driver": {"publishers": {"depth_registered/image_raw": "sensor_msgs/Image",
                                       "depth_registered/camera_info": "sensor_msgs/CameraInfo"}},
     "/depth_to_scan": {"subscribers": {"image": "sensor_msgs/Image", "info": "sensor_msgs/CameraInfo"}}}
"""

_REMAP_OF_A_NAME_THAT_IS_NOT_USED = """
    <launch>
      <node pkg="p" type="t" name="cmd_vel_mux">
        <remap from="cmd_vel_mux/mux_cmd_vel" to="mobile_base/commands/velocity"/>
                     ^^^^^^^^^^^^^^^^^^^^^^^ warning[TOP004] did you mean '~output', which it publishes
      </node>
      <node pkg="p" type="t" name="mobile_base"/>
    </launch>
    //- interfaces
    {"/cmd_vel_mux": {"publishers": {"~output": "geometry_msgs/Twist"}},
     "/mobile_base": {"subscribers": {"~commands/velocity": "geometry_msgs/Twist"}}}
"""

_REMAP_AFTER_THE_NODE = """
    <launch>
      <node pkg="p" type="t" name="base"/>
      ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ hint[TOP002]
      <remap from="odom" to="wheel_odom"/>
      <node pkg="p" type="t" name="viewer"/>
      ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[TOP001] '/odom', published by /base
    </launch>
    //- interfaces
    {"/base": {"publishers": {"odom": "nav_msgs/Odometry", "battery": "sensor_msgs/BatteryState"}},
     "/viewer": {"subscribers": {"wheel_odom": "nav_msgs/Odometry"}}}
"""

_REMAP_SWAPPED = """
    <launch>
      <node pkg="p" type="t" name="laser"><remap from="scan" to="scan_raw"/></node>
                                                                 ^^^^^^^^ warning[TOP001] '/scan_raw', published by
      <node pkg="p" type="t" name="filter"><remap from="scan_raw" to="scan"/></node>
    </launch>
    //- interfaces
    {"/laser": {"publishers": {"scan": "sensor_msgs/LaserScan"}},
     "/filter": {"subscribers": {"scan": "sensor_msgs/LaserScan"}}}
"""

_PRIVATE_TOPIC_REMAPPED_AS_A_PUBLIC_ONE = """
    <launch>
      <node pkg="p" type="t" name="overlay"><remap from="marked" to="hud/image"/></node>
                                                         ^^^^^^ warning[TOP004] '~marked', which it publishes
      <node pkg="p" type="t" name="hud"/>
    </launch>
    //- interfaces
    {"/overlay": {"publishers": {"~marked": "sensor_msgs/Image"}},
     "/hud": {"subscribers": {"hud/image": "sensor_msgs/Image"}}}
"""

_ABSOLUTE_NAME = """
    <launch>
      <group ns="bot">
        <node pkg="p" type="t" name="avoid"/>
        <node pkg="p" type="t" name="base"/>
        ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[TOP001] '/bot/cmd_vel' has no publisher (subscriber: /bot/base);
      </group>
    </launch>
    //- interfaces
    {"/bot/avoid": {"publishers": {"/cmd_vel": "geometry_msgs/Twist"}},
     "/bot/base": {"subscribers": {"cmd_vel": "geometry_msgs/Twist"}}}
"""

_ACTION_IN_ANOTHER_NAMESPACE = """
    <launch>
      <group ns="arm"><node pkg="p" type="t" name="server"/></group>
      <node pkg="p" type="t" name="task">
        <remap from="goto" to="reach"/>
                               ^^^^^ warning[ACT001] action '/reach' has no server (client: /task); did you mean
      </node>
    </launch>
    //- interfaces
    {"/arm/server": {"action_servers": {"reach": "move_base_msgs/MoveBaseAction"}},
     "/task": {"action_clients": {"goto": "move_base_msgs/MoveBaseAction"},
               "answers": ["it waits for the action server reach"]}}
"""

_SERVICE_OF_A_NODE_THAT_WAS_RENAMED = """
    <launch>
      <node pkg="p" type="t" name="imu_calibration"/>
      <node pkg="p" type="t" name="boot"><remap from="calibrate" to="imu_calib/calibrate"/></node>
                                                                     ^^^^^^^^^^^^^^^^^^^ warning[SRV001] '/imu_cal
    </launch>
    //- interfaces
    {"/imu_calibration": {"services": {"~calibrate": "std_srvs/Trigger"}},
     "/boot": {"clients": {"calibrate": "std_srvs/Trigger"}}}
"""

_PARAMETERS_OF_A_RENAMED_NODE = """
    <launch>
      <rosparam>
        laser_filter:
          lower: 0.2
          ^^^^^ warning[PRM001] /scan_filter reads '/scan_filter/lower', which is not set
          upper: 12.0
          ^^^^^ warning[PRM001] /scan_filter reads '/scan_filter/upper', which is not set
      </rosparam>
      <node pkg="p" type="t" name="scan_filter"/>
    </launch>
    //- interfaces
    {"/scan_filter": {"params": {"~lower": 0.1, "~upper": 30.0}}}
"""

_PARAMETERS_MOVED_BELOW_A_NAMESPACE = """
    <launch>
      <node pkg="p" type="t" name="move_group">
        <param name="allowed_goal_duration_margin" value="0.8"/>
                     ^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[PRM001] '/move_group/trajectory_execution/allowed_goal
      </node>
    </launch>
    //- interfaces
    {"/move_group": {"params": {"~trajectory_execution/allowed_goal_duration_margin": 0.5}}}
"""

_GLOBAL_NAME_IN_THE_NODE = """
    <launch>
      <group ns="cob">
        <node pkg="p" type="t" name="sound_controller"><param name="mode" value="festival"/></node>
                                                                    ^^^^ warning[PRM001] '/sound_controller/mode'
      </group>
    </launch>
    //- interfaces
    {"/cob/sound_controller": {"params": {"/sound_controller/mode": "espeak"}}}
"""

_TYPES_DIFFER = """
    <launch>
      <node pkg="p" type="t" name="sonar"/>
      <node pkg="p" type="t" name="alarm"/>
      ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ error[TOP003] '/distance'
    </launch>
    //- interfaces
    {"/sonar": {"publishers": {"distance": "std_msgs/Float64"}},
     "/alarm": {"subscribers": {"distance": "std_msgs/Float32"}}}
"""

_TWO_MAPS = """
    <launch>
      <node pkg="p" type="t" name="slam"/>
      <node pkg="p" type="t" name="map_server"/>
      ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ warning[TOP005] '/map' has 2 publishers (/slam and /map_server): each
      <node pkg="p" type="t" name="amcl"/>
    </launch>
    //- interfaces
    {"/slam": {"publishers": {"map": "nav_msgs/OccupancyGrid"}, "latched": ["map"]},
     "/map_server": {"publishers": {"map": "nav_msgs/OccupancyGrid"}, "latched": ["map"]},
     "/amcl": {"subscribers": {"map": "nav_msgs/OccupancyGrid"}}}
"""

_DEFECTS = {
    "odometry renamed by a remap": (_ODOMETRY_RENAMED, "_new", ""),
    "laser remapped away": (_LASER_REMAPPED_AWAY, 'to="camera/scan"', 'to="scan"'),
    "depth topic as a constant": (_CONSTANT_DEPTH_TOPIC, "camera/depth/image_raw", "camera/$(arg depth)/image_raw"),
    "remap of a name that is not used": (_REMAP_OF_A_NAME_THAT_IS_NOT_USED, "mux_cmd_vel", "output"),
    "remap after the node": (
        _REMAP_AFTER_THE_NODE,
        '<launch>\n      <node pkg="p" type="t" name="base"/>',
        '<launch>\n      <remap from="odom" to="wheel_odom"/>\n      <node pkg="p" type="t" name="base"/>',
    ),
    "remap swapped": (_REMAP_SWAPPED, '<remap from="scan_raw" to="scan"/>', '<remap from="scan" to="scan_raw"/>'),
    "private topic remapped as a public one": (_PRIVATE_TOPIC_REMAPPED_AS_A_PUBLIC_ONE, '"marked"', '"~marked"'),
    "absolute name": (_ABSOLUTE_NAME, '"/cmd_vel"', '"cmd_vel"'),
    "action in another namespace": (_ACTION_IN_ANOTHER_NAMESPACE, 'to="reach"', 'to="arm/reach"'),
    "service of a node that was renamed": (_SERVICE_OF_A_NODE_THAT_WAS_RENAMED, "imu_calib/", "imu_calibration/"),
    "parameters of a renamed node": (_PARAMETERS_OF_A_RENAMED_NODE, "laser_filter", "scan_filter"),
    "parameters moved below a namespace": (
        _PARAMETERS_MOVED_BELOW_A_NAMESPACE,
        'name="allowed',
        'name="trajectory_execution/allowed',
    ),
    "global name in the node": (_GLOBAL_NAME_IN_THE_NODE, '"/sound_controller/mode"', '"~mode"'),
    "types differ": (_TYPES_DIFFER, "Float64", "Float32"),
    "two maps": (_TWO_MAPS, 'name="slam"/>', 'name="slam"><remap from="map" to="own_map"/></node>'),
}


@pytest.mark.parametrize("name", _DEFECTS)
def test_a_known_defect_and_its_repair(name: str) -> None:
    text, wrong, right = _DEFECTS[name]
    check(text)
    assert wrong in text
    left = findings_of(text.replace(wrong, right, 1))
    assert [f for f in left if f.severity != "hint" and f.rule != "TRC005"] == []
