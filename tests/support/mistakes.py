"""A package of ROS 2 with one simple mistake in each launch file, in Python, XML and YAML."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

_MANIFEST = """<package format="3">
  <name>p</name>
  <version>0.0.1</version>
  <description>d</description>
  <maintainer email="a@example.org">a</maintainer>
  <license>MIT</license>
  <exec_depend>launch_ros</exec_depend>
  <exec_depend>rclpy</exec_depend>
  <export><build_type>ament_python</build_type></export>
</package>
"""
_SETUP = """from glob import glob

from setuptools import setup

setup(
    name='p',
    version='0.0.1',
    packages=['p'],
    data_files=[
        ('share/p', ['package.xml']),
        ('share/p/launch', glob('launch/*')),
        ('share/p/config', glob('config/*')),
    ],
    entry_points={'console_scripts': ['talker = p.talker:main', 'listener = p.listener:main']},
)
"""
_NODE = """import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class {cls}(Node):
    def __init__(self):
        super().__init__('{name}')
        {body}


def main():
    rclpy.init()
    rclpy.spin({cls}())
"""
_PARAMS = ("('max_speed', 1.0)", "('count', 3)", "('frame', 'map')", "('enabled', True)")
_NODES = {
    "talker": [*(f"self.declare_parameter{each}" for each in _PARAMS), "self.create_publisher(String, 'chatter', 10)"],
    "listener": ["self.create_subscription(String, 'chatter', print, 10)"],
}
_CONFIGS = {
    "good": "talker:\n  ros__parameters:\n    max_speed: 2.0\n",
    "keys": "talker:\n  ros__parameters:\n    max_sped: 2.0\n    count: '4'\n    frame: 7\n    enabled: \"true\"\n",
    "double": "talker:\n  ros__parameters:\n    max_speed: 2\n",
    "bare": "talker:\n  max_speed: 2.0\n",
    "near": "talker:\n  ros_parameters:\n    max_speed: 2.0\n",
    "other": "taker:\n  ros__parameters:\n    max_speed: 2.0\n",
}
_PYTHON = """from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import EnvironmentVariable, LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    return LaunchDescription([
{}    ])
"""
_ADDED = """import launch
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    ld = launch.LaunchDescription()
    {}
    return ld
"""
_IN_PYTHON = (
    "IncludeLaunchDescription(\n"
    "    PythonLaunchDescriptionSource(PathJoinSubstitution([FindPackageShare('p'), 'launch', '{}.launch.py'])),\n"
    "    launch_arguments={},\n)"
)
_IN_XML = '<include file="$(find-pkg-share p)/launch/{}.launch.py">\n{}\n</include>'
_IN_YAML = "- include:\n    file: $(find-pkg-share p)/launch/{}.launch.py\n{}"


def _python_node(executable: str, **given: str) -> str:
    more = "".join(f", {name}={value}" for name, value in given.items())
    return f"Node(package='p', executable='{executable}'{more})"


def _python() -> Iterator[tuple[str, list[str]]]:
    declared, node = "DeclareLaunchArgument('speed', default_value='0.4')", _python_node
    yield "undeclared", [declared, node("talker", parameters="[{'max_speed': LaunchConfiguration('sped')}]")]
    yield "undeclared_alone", [node("talker", namespace="LaunchConfiguration('tempo')")]
    yield "unknown_arg", [_IN_PYTHON.format("inc", "{'speed': '1.0', 'foo': 'x'}.items()")]
    yield "unknown_pair", [_IN_PYTHON.format("inc", "[('speed', '1.0'), ('foo', 'x')]")]
    yield "unknown_arg_near", [_IN_PYTHON.format("inc", "[('sped', '1.0')]")]
    yield "missing_arg", [declared, _IN_PYTHON.replace("    launch_arguments={},\n", "").format("inc")]
    yield "executable", [node("taker")]
    yield "param", [node("talker", parameters="[{'max_sped': 2.0, 'count': '4'}]")]
    yield "param_type", [node("talker", name="'b'", parameters="[{'max_speed': 2, 'enabled': 'true'}]")]
    for name in (*_CONFIGS, "god"):
        path = f"PathJoinSubstitution([FindPackageShare('p'), 'config', '{name}.yaml'])"
        yield f"file_{name}", [node("talker", parameters=f"[{path}]")]
    yield "near", [node("talker", remappings="[('chatter', 'chater')]"), node("listener")]
    yield "namespace", [node("talker", namespace="'a'"), node("listener")]
    yield "environment", [node("talker", namespace="EnvironmentVariable('HOM')")]
    yield "output", [node("talker", output="'scren'")]
    choices = "DeclareLaunchArgument('mode', default_value='fast', choices=['fast' 'slow', 'off'])"
    yield "choice", [choices, node("talker", name="LaunchConfiguration('mode')")]
    yield "include", [_IN_PYTHON.format("ink", "{'speed': '1.0'}.items()")]
    yield "name", [node("talker", name="'my-talker'")]
    yield "twice", [node("talker", name="'n'"), node("listener", name="'n'")]
    yield "unused", [declared, node("talker")]


def _xml() -> Iterator[tuple[str, list[str]]]:
    declared, talker, listener = (
        '<arg name="speed" default="0.4"/>',
        '<node pkg="p" exec="talker"',
        '<node pkg="p" exec="listener"',
    )
    yield "undeclared", [declared, f'{talker}>\n  <param name="max_speed" value="$(var sped)"/>\n</node>']
    yield "undeclared_alone", [f'{talker} namespace="$(var tempo)"/>']
    yield "unknown_arg", [_IN_XML.format("inc", '<arg name="speed" value="1.0"/>\n<arg name="foo" value="x"/>')]
    yield "unknown_arg_near", [_IN_XML.format("inc", '<arg name="sped" value="1.0"/>')]
    yield "missing_arg", [declared, _IN_XML.format("inc", "")]
    yield "executable", ['<node pkg="p" exec="taker"/>']
    yield (
        "param",
        [f'{talker}>\n  <param name="max_sped" value="2.0"/>\n  <param name="count" value="\'4\'"/>\n</node>'],
    )
    yield "param_type", [f'{talker} name="b">\n  <param name="max_speed" value="2"/>\n</node>']
    for name in (*_CONFIGS, "god"):
        yield f"file_{name}", [f'{talker}>\n  <param from="$(find-pkg-share p)/config/{name}.yaml"/>\n</node>']
    yield "near", [f'{talker}>\n  <remap from="chatter" to="chater"/>\n</node>', f"{listener}/>"]
    yield "namespace", [f'{talker} namespace="a"/>', f"{listener}/>"]
    yield "environment", [f'{talker} namespace="$(env HOM)"/>']
    yield "output", [f'{talker} output="scren"/>']
    yield (
        "choice",
        ['<arg name="mode" default="fst">\n  <choice value="fast"/>\n</arg>', f'{talker} name="$(var mode)"/>'],
    )
    yield "include", [_IN_XML.format("ink", '<arg name="speed" value="1.0"/>')]
    yield "name", [f'{talker} name="my-talker"/>', f'{listener} name="a/b"/>']
    yield "twice", [f'{talker} name="n"/>', f'{listener} name="n"/>']
    yield "unused", [declared, f"{talker}/>"]
    yield "attribute", [f'{talker} nmae="x"/>', '<nod pkg="p" exec="talker"></nod>']


def _yaml() -> Iterator[tuple[str, list[str]]]:
    declared, talker = '- arg:\n    name: speed\n    default: "0.4"', "- node:\n    pkg: p\n    exec: talker"
    listener = "- node: {pkg: p, exec: listener}"
    yield "undeclared", [declared, f"{talker}\n    param:\n    - name: max_speed\n      value: $(var sped)"]
    yield "undeclared_alone", [f"{talker}\n    namespace: $(var tempo)"]
    arg = "    - name: {}\n      value: '1.0'\n"
    yield "unknown_arg", [_IN_YAML.format("inc", "    arg:\n" + arg.format("speed") + arg.format("foo"))]
    flow = "    arg: [{name: speed, value: '1.0'}, {name: foo, value: x}]"
    yield "unknown_arg_flow", [_IN_YAML.format("inc", flow)]
    yield "unknown_arg_near", [_IN_YAML.format("inc", "    arg:\n" + arg.format("sped"))]
    yield "missing_arg", [declared, _IN_YAML.format("inc", "")]
    yield "executable", ["- node:\n    pkg: p\n    exec: 'taker'"]
    flow_param = "    - {name: count, value: '4'}"
    yield "param", [f"{talker}\n    param:\n    - name: max_sped\n      value: 2.0\n{flow_param}"]
    yield "param_type", [f"{talker}\n    name: b\n    param:\n    - name: max_speed\n      value: 2"]
    for name in (*_CONFIGS, "god"):
        yield f"file_{name}", [f"{talker}\n    param:\n    - from: $(find-pkg-share p)/config/{name}.yaml"]
    yield "near", [f"{talker}\n    remap:\n    - from: chatter\n      to: chater", listener]
    yield "namespace", [f"{talker}\n    namespace: a", listener]
    yield "environment", [f"{talker}\n    namespace: $(env HOM)"]
    yield "output", ["- node: {pkg: p, exec: talker, output: scren}"]
    yield (
        "choice",
        [
            "- arg:\n    name: mode\n    default: fst\n    choice:\n    - value: fast",
            f"{talker}\n    name: $(var mode)",
        ],
    )
    yield "include", [_IN_YAML.format("ink", "    arg: [{name: speed, value: '1.0'}]")]
    yield "name", ["- node: {pkg: p, exec: talker, name: my-talker}"]
    yield "twice", ["- node: {pkg: p, exec: talker, name: n}", "- node: {pkg: p, exec: listener, name: n}"]
    yield "unused", [declared, talker]
    yield "attribute", [f"{talker}\n    nmae: x", "- nod:\n    pkg: p\n    exec: talker"]


def write_mistakes(folder: Path) -> None:
    """The package in `folder/src`."""
    package = folder / "src" / "p"
    files = {"package.xml": _MANIFEST, "setup.py": _SETUP, "p/__init__.py": ""}
    for name, body in _NODES.items():
        files[f"p/{name}.py"] = _NODE.format(cls=name.title(), name=name, body="\n        ".join(body))
    files |= {f"config/{name}.yaml": text for name, text in _CONFIGS.items()}
    speed = "[{'max_speed': LaunchConfiguration('speed')}]"
    files["launch/inc.launch.py"] = _of_items(
        ["DeclareLaunchArgument('speed')", _python_node("talker", parameters=speed)]
    )
    files |= {f"launch/py_{name}.launch.py": _of_items(items) for name, items in _python()}
    added = [_python_node("talker", namespace="LaunchConfiguration('tempo')")]
    unused = ["DeclareLaunchArgument('speed', default_value='1')", _python_node("talker")]
    for name, items in (("added", added), ("added_unused", unused)):
        files[f"launch/py_{name}.launch.py"] = _ADDED.format("\n    ".join(f"ld.add_action({item})" for item in items))
    files["launch/py_undefined.launch.py"] = _of_items(["Nod(package='p', executable='talker')"])
    for name, items in _xml():
        body = "".join(f"  {item}\n".replace("\n", "\n  ").rstrip() + "\n" for item in items)
        files[f"launch/xml_{name}.launch.xml"] = f"<launch>\n{body}</launch>\n"
    files |= {f"launch/yaml_{n}.launch.yaml": "launch:\n" + "".join(f"{i}\n" for i in items) for n, items in _yaml()}
    for path, text in files.items():
        (package / path).parent.mkdir(parents=True, exist_ok=True)
        (package / path).write_text(text)


def _of_items(items: list[str]) -> str:
    return _PYTHON.format("".join(f"        {item},\n".replace("\n", "\n        ").rstrip() + "\n" for item in items))
