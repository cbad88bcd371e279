"""Inputs that fuzzing begins with, and the words that the languages are made of."""

from __future__ import annotations

import json
import struct
import xmlrpc.client
from pathlib import Path
from typing import Any

from support.scripted_master import BETWEEN, URI

FIXTURES = Path(__file__).parents[2] / "fixtures"
CORPUS = Path(__file__).parents[3] / "shared" / "corpus"
LONGEST = 8192
"""Of an input, in bytes. What grows faster than its input is looked for with longer ones elsewhere."""


def files(*patterns: str, most: int = 40) -> list[bytes]:
    found: list[bytes] = []
    for pattern in patterns:
        paths = sorted(p for base in (FIXTURES, CORPUS) if base.is_dir() for p in base.glob(pattern) if p.is_file())
        fitting = [p for p in paths if 0 < p.stat().st_size <= LONGEST]
        step = max(1, len(fitting) // most)
        found += [p.read_bytes() for p in fitting[::step][:most]]
    return found


def json_lines(*values: object) -> list[bytes]:
    return [json.dumps(value).encode() for value in values]


def _answer(value: object) -> bytes:
    return xmlrpc.client.dumps(([1, "", value],), methodresponse=True).encode()


def master_answers() -> list[bytes]:
    address = URI.decode()
    state = [[["/t", ["/n", "/m"]]], [["/t", ["/m"]]], [["/s", ["/n"]]]]
    parts = [_answer(each) for each in (state, [["/t", "std_msgs/String"]], address, 5, address, 5, "x")]
    fields = b"".join(struct.pack("<I", len(each)) + each for each in (b"type=std_srvs/Empty", b"md5sum=x"))
    return [
        BETWEEN.join(parts),
        BETWEEN.join([*parts[:2], _answer("rosrpc" + address[4:]), struct.pack("<I", len(fields)) + fields]),
        BETWEEN.join([*parts[:2], xmlrpc.client.dumps(([-1, "no", 0],), methodresponse=True).encode()]),
        xmlrpc.client.dumps(xmlrpc.client.Fault(1, "no"), methodresponse=True).encode(),
        b"HTTP/1.1 302 Found\r\nLocation: " + URI + b"\r\nContent-Length: 0\r\n\r\n",
    ]


EVENTS: tuple[dict[str, Any], ...] = (
    {"node": {"ev": "endpoint", "role": "publisher", "name": "a", "type": "std_msgs/String", "file": "/x", "line": 3}},
    {"node": {"ev": "param", "access": "get", "name": "~b", "has_default": True, "default": {"c": [1, 2.5, None]}}},
    {"node": {"ev": "files", "paths": ["/etc/hostname"]}},
    {"node": {"ev": "wrote", "path": "/etc/x"}},
    {"node": {"ev": "state", "state": "sleep", "seconds": 1.5}},
    {"node": {"ev": "asked", "what": "name"}},
    {"node": {"ev": "node", "name": "n", "given": "own", "full": "/n", "of_container": False}},
    {"node": {"ev": "loaded", "success": False, "error": "Component constructor threw an exception: no"}},
    {"own": {"ev": "end", "status": "spinning", "code": 0}},
)
GRAPH = {
    "nodes": ["/node_py", "/n"],
    "endpoints": [["publisher", "/n", "/t", "std_msgs/msg/String", {"reliability": "reliable"}]],
    "lifecycle": {"/n": "inactive"},
}
XML = (
    *(
        "<launch>",
        "</launch>",
        "<node ",
        "<include ",
        "<group>",
        "<arg ",
        "<param ",
        "<rosparam>",
        "<remap ",
        "<!--",
        "-->",
    ),
    *(
        "<![CDATA[",
        "]]>",
        "<!DOCTYPE x [<!ENTITY e 'v'>]>",
        "&e;",
        "&#x41;",
        "<?xml version='1.0'?>",
        "$(arg a)",
        "$(find p)",
    ),
    *("$(eval ", "$(anon n)", "$(env X)", "ns='", "if='", "command='", "file='", "preflight:"),
)
ROS2 = (
    *XML,
    *(
        "<let ",
        "<executable ",
        "<composable_node ",
        "<node_container ",
        "$(var a)",
        "$(find-pkg-share p)",
        "$(dirname)",
    ),
    *("$(eval ", "$(command ", "exec='", "<set_parameter ", "<push_ros_namespace "),
)
YAML = (
    "/**:",
    "ros__parameters:",
    "&a ",
    "*a",
    "<<: ",
    "!!python/object",
    "? ",
    "- ",
    "|\n",
    "---\n",
    "!degrees ",
    "rad(",
)
JSON = ('"ev":', '"node":', "1e999", "NaN", '"\\ud800"', "[[[[", "null", '"name":', "9" * 40)
PYTHON = (
    "def ",
    "import ",
    "LaunchDescription([",
    "Node(",
    "lambda: ",
    "f'{",
    "rospy.Publisher(",
    "create_publisher(",
    "*",
    "**",
)
READ = [
    b"""import functools, itertools, json, os, re, yaml
from launch import LaunchDescription
from launch.actions import *
from launch.substitutions import *
from launch_ros.actions import Node

class Robot:
    def __init__(self, name, *more, **values):
        self.name, self.more, self.values = name, more, values
    def __str__(self):
        return f"{self.name:>8}{self.more!r}"
    def __eq__(self, other):
        return self.name == other.name

def nodes(context, *args):
    robots = [Robot(str(i), *range(i), a=i ** 2) for i in range(3) if i % 2 == 0 or i > 1]
    for robot in sorted(robots, key=lambda each: each.name):
        yield Node(package="p", executable="%s_%03d" % (robot, 1), parameters=[{**robot.values, "x": [1, 2][-1:]}])

def generate_launch_description():
    try:
        with open(os.path.join(os.path.dirname(__file__), "x.yaml")) as file:
            values = yaml.safe_load(file)["a"]
    except (KeyError, OSError) as error:
        values = {"{0.name}/{1[0]}".format(Robot("r"), [1]): str(error).split()[0]}
    while len(values) < 3:
        values[len(values)] = functools.reduce(lambda a, b: a + b, itertools.chain("ab", values), "")
    text = re.sub("a+", "b", "-".join(map(str, values)))
    condition = PythonExpression(["'", LaunchConfiguration("a"), "' == 'b' and ", text])
    return LaunchDescription([DeclareLaunchArgument("a", default_value=text), OpaqueFunction(function=nodes)])
""",
]
READ_WORDS = (
    *(".__class__", ".format(", ".perform(", "class A(Node):", "try:", "except:", "for x in ", "while ", "yield "),
    *("'%s' % ", "map(", "sorted(", "range(", "10 ** 9", "open(", "yaml.safe_load(", "re.match(", "iter(", "x[:] = "),
)
CPP = ("#include ", "nh.advertise<", "create_publisher<", "template<", "#define ", 'R"x(', "operator", "for(", "::")
CMAKE = (
    "add_executable(",
    "install(",
    "foreach(",
    "endforeach()",
    "macro(",
    "function(",
    "${",
    "}",
    "if(",
    "include(",
    "[[",
    "]]",
)


SETUP = b"""from setuptools import setup, find_packages
import os
from glob import glob
name = 'p'
setup(name=name, packages=find_packages(), data_files=[
    ('share/' + name, ['package.xml']), (os.path.join('share', name, 'launch'), glob('launch/*.launch.py'))],
    entry_points={'console_scripts': ['node = p.node:main']})
"""
SETUP_CFG = b"""[options.entry_points]
console_scripts =
    node = p.node:main
[options.data_files]
share/p = package.xml
"""
PYPROJECT = b"""[project]
name = "p"
[project.scripts]
node = "p.node:main"
"""
SETTINGS = b"""roots:
  - src/p/launch/x.launch
  - file: src/p/launch/y.launch
    args: {a: 1}
external: [/tf, {topic: /x*}]
severities: {TOP001: off, prm001: error}
paths:
  - match: src/**
    severities: {LCH001: hint}
nodes:
  - package: p
    executable: node.py
    publishers: [{name: a, type: std_msgs/String, qos: {reliability: reliable}}]
    parameters: {b: 1}
"""
SNAPSHOT = b"""schema: ros-preflight/snapshot/1
launch: src/p/launch/x.launch
generation: 1
args: {a: "1"}
nodes:
  /n:
    package: p
    executable: node.py
    outcome: spinning
    complete: true
    publishers: {/t: {type: std_msgs/String, qos: {queue_size: 1}}}
    parameters: {/n/a: 1}
    reads: {/n/b: {default: 1}}
parameters: {/x: [1, 2.5, yes]}
errors: [x]
unknown: [y]
"""
BRIDGES = b"""- {ros_topic_name: odom, gz_topic_name: /odom, ros_type_name: nav_msgs/msg/Odometry, direction: GZ_TO_ROS}
- {topic_name: cmd_vel, ros_type_name: geometry_msgs/msg/Twist, gz_type_name: gz.msgs.Twist, direction: ROS_TO_GZ}
- {gz_topic_name: both, ros_type_name: std_msgs/msg/String}
"""
ROBOT_IN_PART = b"""<!-- incomplete for ros-preflight without a, b -->
<robot name="r"><link name="base"/><link name="${unknown}_l"/>
<joint name="j" type="fixed"><parent link="${unknown}"/><child link="base"/></joint>
<gazebo><plugin name="p" filename="f"><ros><namespace>${unknown}</namespace></ros></plugin></gazebo></robot>"""
ROBOT = b"""<robot><gazebo><plugin filename="gz_ros2_control-system" name="gz_ros2_control::GazeboSimROS2ControlPlugin">
<parameters>/a/b.yaml</parameters><controller_manager_name>cm</controller_manager_name><!-- <plugin> -->
<ros><namespace>left</namespace><remapping>/tf:=tf</remapping></ros></plugin></gazebo></robot>
"""
BEHAVIOR_TREE = b"""<root BTCPP_format="4" main_tree_to_execute="A"><include path="b.xml"/><BehaviorTree ID="A"><Control
ID="Sequence"><Action ID="Wait"/><SubTree ID="B"/><Spin angle="{a}" _skipIf="a &lt; 1"/></Control></BehaviorTree></root>
"""
WORLD = b"""<sdf version="1.9"><world name="w"><plugin filename="gz-sim-imu-system" name="i"/>
<include><uri>model://m</uri><name>n</name><plugin filename="p"/></include>
<model name="a"><link name="l"><sensor name="s" type="camera"><topic>t</topic><camera>
<camera_info_topic>i</camera_info_topic></camera></sensor></link>
<joint name="j"><sensor name="f" type="force_torque"/></joint><model name="b"/></model></world></sdf>
"""
SRDF = b"""<robot name="r"><virtual_joint name="world" type="fixed" parent_frame="world" child_link="base"/>
<group name="arm"><chain base_link="base" tip_link="tool"/><joint name="${prefix}elbow"/><group name="hand"/></group>
<group_state name="home" group="arm"><joint name="elbow" value="0"/></group_state><passive_joint name="elbow"/>
<end_effector name="hand" parent_link="tool" group="hand"/><disable_collisions link1="base" link2="tool"/></robot>
"""
NODL = b"""nodl_version: 2
include: [{ref: 'local://common.nodl.yaml'}]
parameters: {rate: {type: double, default_value: 10.0}}
publishers:
  - {name: scan, type: sensor_msgs/LaserScan, qos: {history: KEEP_LAST, depth: 5, reliability: BEST_EFFORT}}
service_servers: [{name: ~/reset, type: std_srvs/srv/Trigger}]
"""
NODL_1 = b"""<interface version="1"><node name="driver" executable="driver">
<parameter name="verbose" type="bool"/><topic name="scan" type="sensor_msgs/msg/LaserScan" role="both"/>
<service name="reset" type="std_srvs/srv/Trigger" role="server"/></node></interface>
"""
ANSWERS = (
    {
        "actions": [
            {"k": "node", "p": [3, 30], "n": "Node", "a": [["package", "p"], ["executable", "node.py"]], "c": []},
            {"k": "group", "a": {"scoped": True}, "c": [{"k": "opaque", "i": 1, "n": "OpaqueFunction", "p": [3]}]},
        ],
        "files": {"/made/by/it.yaml": "a: 1"},
    },
    {"error": {"type": "ValueError", "message": "no", "frames": [["/x.py", 3, "f"]]}},
    {"actions": [{"k": "include", "p": [3, 4], "a": [["file", [{"t": "x"}]]]}], "configurations": {"a": "b"}},
    {"actions": [], "missed": [["package", "p", None]], "assumed": [["ROS_DISTRO", "rolling", [3, 4]]]},
)
