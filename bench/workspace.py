"""A ROS 1 workspace of the size that large projects have: 1,000 launch files in 200 packages.

  python bench/workspace.py FOLDER

Forty robots of five packages (description, drivers, navigation, perception, bringup) with five launch files each. They
look as those of real projects do: a handful of arguments with defaults that are passed down the includes, groups with
namespaces and conditions, parameters written out and loaded from YAML, remaps. `roslaunch` takes each of them. Nodes
are scripts of the packages, and a few of Debian's ROS packages. They read the parameters that they are given, but for
some keys of the YAML files (`topics`, the acceleration), and have defaults for others that only some are given. The
same files come out every time.

The first three robots have ten nodes where the others have two or three, and `fleet.launch` starts all three of them:
500 nodes through 60 includes, the largest tree.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

# fmt: off
ROBOTS = (
    "atlas", "borealis", "cassini", "dione", "europa", "fenrir", "ganymede", "hyperion", "iapetus", "juno",
    "kepler", "luna", "mimas", "nereid", "oberon", "pandora", "quaoar", "rhea", "sedna", "titan",
    "umbriel", "vesta", "wega", "xena", "ymir", "zephyr", "ariel", "borr", "calypso", "daphnis",
    "elara", "freya", "galatea", "helene", "io", "janus", "kari", "larissa", "metis", "naiad",
)
# fmt: on
"""Two hundred packages are forty robots of five."""
HEAVY = ROBOTS[:3]
NODES, INCLUDES = 500, 60
"""Of the largest tree."""

ARGS = """\
  <arg name="robot" default="{robot}" doc="Name of the robot, the prefix of its frames"/>
  <arg name="sim" default="false" doc="Whether the robot is simulated"/>
"""
PASSED = """\
      <arg name="robot" value="$(arg robot)"/>
      <arg name="sim" value="$(arg sim)"/>
"""
LEAVES = {
    "description": ("description", "rviz", "gazebo", "joint_gui", "upload"),
    "drivers": ("camera", "lidar", "imu", "base", "arm"),
    "navigation": ("map_server", "amcl", "move_base", "gmapping"),
    "perception": ("detector", "pointcloud", "tracker", "segmentation"),
    "bringup": ("teleop", "record"),
}
"""Launch files that start nodes, by package. Beside them: `navigation`, `perception`, and `drivers` and `robot` in the
bringup package, which include; and a fifth file there, `minimal` or `fleet`."""


@dataclass(frozen=True)
class Workspace:
    """What was generated: the folder, and the files of the largest tree that a benchmark edits."""

    folder: Path
    root: Path
    middle: Path
    leaf: Path


def generate(folder: Path, robots: tuple[str, ...] = ROBOTS) -> Workspace:
    """Write the workspace of these robots, `HEAVY` among them, into `folder`, which is made."""
    for robot in robots:
        for kind, leaves in LEAVES.items():
            package = folder / "src" / robot / f"{robot}_{kind}"
            for name in ("launch", "config", "scripts"):
                (package / name).mkdir(parents=True)
            (package / "package.xml").write_text(_manifest(robot, kind))
            for leaf in leaves:
                _write_leaf(package, robot, kind, leaf)
            for name, text in _including(robot, kind):
                (package / "launch" / f"{name}.launch").write_text(text)
    bringup = folder / "src" / HEAVY[0] / f"{HEAVY[0]}_bringup" / "launch"
    leaf_file = folder / "src" / HEAVY[1] / f"{HEAVY[1]}_perception" / "launch" / "tracker.launch"
    return Workspace(folder, bringup / "fleet.launch", bringup / "robot.launch", leaf_file)


def _manifest(robot: str, kind: str) -> str:
    kinds = ("drivers", "navigation", "perception", "description") if kind == "bringup" else ()
    depends = [f"{robot}_{each}" for each in kinds] + ["rospy", "rosout", "std_msgs", *(["rosbag"] if kinds else [])]
    if kind == "bringup" and robot == HEAVY[0]:
        depends += [f"{each}_bringup" for each in HEAVY[1:]]
    lines = "".join(f"  <exec_depend>{each}</exec_depend>\n" for each in depends)
    return (
        f'<?xml version="1.0"?>\n<package format="2">\n  <name>{robot}_{kind}</name>\n  <version>1.4.0</version>\n'
        f"  <description>The {kind} of {robot}</description>\n"
        '  <maintainer email="robots@example.com">Robots</maintainer>\n  <license>BSD</license>\n'
        f"  <buildtool_depend>catkin</buildtool_depend>\n{lines}</package>\n"
    )


def _write_leaf(package: Path, robot: str, kind: str, leaf: str) -> None:
    """A launch file that starts nodes, with the YAML file that it loads and the scripts that it starts."""
    nodes = 10 if robot in HEAVY else 2 + (ROBOTS.index(robot) + len(leaf)) % 2
    text = "".join(_leaf(robot, kind, leaf, nodes))
    (package / "launch" / f"{leaf}.launch").write_text(text)
    (package / "config" / f"{leaf}.yaml").write_text(_config(robot, leaf))
    for name in (leaf, f"{leaf}_monitor"):
        script = package / "scripts" / f"{name}.py"
        script.write_text(_SCRIPT.format(name=name, leaf=leaf))
        script.chmod(0o755)
    if leaf == "description":
        (package / "urdf").mkdir()
        joints = "".join(f'  <link name="link_{n}"/>\n' for n in range(40))
        (package / "urdf" / f"{robot}.urdf").write_text(f'<robot name="{robot}">\n{joints}</robot>\n')


def _leaf(robot: str, kind: str, leaf: str, nodes: int) -> Iterator[str]:
    package = f"{robot}_{kind}"
    yield f'<?xml version="1.0"?>\n<!-- The {leaf} of {robot}. -->\n<launch>\n'
    yield ARGS.format(robot=robot)
    yield f'  <arg name="name" default="{leaf}"/>\n  <arg name="rate" default="{10 + len(leaf)}"/>\n'
    yield '  <arg name="debug" default="false"/>\n'
    yield '  <arg name="launch_prefix" value="gdb -ex run --args" if="$(arg debug)"/>\n'
    yield '  <arg name="launch_prefix" value="" unless="$(arg debug)"/>\n\n'
    if leaf == "description":
        yield f'  <param name="robot_description" textfile="$(find {package})/urdf/{robot}.urdf"/>\n'
    if leaf == "record":
        yield (
            '  <node pkg="rosbag" type="record" name="record" args="-o /tmp/$(arg robot) -a" unless="$(arg sim)"/>\n'
            '  <node pkg="rosout" type="rosout" name="collector" if="$(arg sim)"/>\n'
        )
        nodes -= 1
    yield '  <group ns="$(arg name)">\n'
    yield f'    <rosparam command="load" file="$(find {package})/config/{leaf}.yaml"/>\n'
    for number in range(nodes):
        script, suffix = (leaf, "") if number == 0 else (f"{leaf}_monitor", f"_{number}")
        respawn = ' respawn="true" respawn_delay="2"' if number % 3 == 1 else ""
        yield (
            f'    <node pkg="{package}" type="{script}.py" name="{script}{suffix}" output="screen"{respawn}'
            ' launch-prefix="$(arg launch_prefix)">\n'
            '      <param name="rate" value="$(arg rate)"/>\n'
            f'      <param name="frame_id" value="$(arg robot)_{leaf}_{number}_link"/>\n'
        )
        if number % 2:
            yield f'      <remap from="in" to="{leaf}{"" if number < 2 else f"_{number - 2}"}/out"/>\n'
            yield f'      <remap from="status" to="/diagnostics/{leaf}"/>\n'
        if number % 4 == 0:
            yield f'      <rosparam command="load" file="$(find {package})/config/{leaf}.yaml"/>\n'
        if number % 5 == 2:
            yield "      <rosparam>\n        window: {size: 12, overlap: 0.5}\n        axes: [x, y, yaw]\n"
            yield "      </rosparam>\n"
            yield "      <param name=\"use_gpu\" value=\"$(eval not arg('sim') and int(arg('rate')) &gt; 5)\"/>\n"
        yield "    </node>\n"
    yield "  </group>\n</launch>\n"


def _including(robot: str, kind: str) -> Iterator[tuple[str, str]]:
    """The launch files of a package that include others."""
    if kind == "navigation":
        yield kind, _parent(robot, kind, kind, [(kind, leaf, leaf) for leaf in ("map_server", "amcl", "move_base")], 1)
    elif kind == "perception":
        yield kind, _parent(robot, kind, kind, [(kind, leaf, leaf) for leaf in LEAVES[kind]], 2)
    elif kind == "bringup":
        cameras = [("drivers", "camera", "front_camera"), ("drivers", "camera", "rear_camera")]
        others = [("drivers", leaf, leaf) for leaf in LEAVES["drivers"][1:]]
        yield "drivers", _parent(robot, kind, "drivers", [*cameras, *others], 2)
        parts = [
            ("description", "description", "description"),
            ("bringup", "drivers", "drivers"),
            ("navigation", "navigation", "navigation"),
            ("perception", "perception", "perception"),
            ("bringup", "teleop", "teleop"),
            ("bringup", "record", "record"),
        ]
        yield "robot", _parent(robot, kind, "robot", parts, 1)
        if robot == HEAVY[0]:
            yield "fleet", _fleet()
        else:
            yield "minimal", _parent(robot, kind, "minimal", parts[:2], 1)


def _parent(robot: str, kind: str, file: str, parts: list[tuple[str, str, str]], nodes: int) -> str:
    """A launch file that includes `parts` (kind of package, launch file, name), and starts a few nodes itself."""
    lines = ['<?xml version="1.0"?>\n<launch>\n', ARGS.format(robot=robot), '  <arg name="rate" default="20"/>\n']
    lines += [f'  <arg name="{name}" default="true" doc="Whether to start the {name}"/>\n' for _, _, name in parts]
    lines.append('\n  <param name="use_sim_time" value="$(arg sim)"/>\n  <env name="ROS_LOG_LEVEL" value="warn"/>\n')
    for part, leaf, name in parts:
        lines.append(
            f'  <group if="$(arg {name})">\n    <remap from="tf_raw" to="/tf"/>\n'
            f'    <include file="$(find {robot}_{part})/launch/{leaf}.launch">\n{PASSED}'
        )
        if name != leaf:
            lines.append(f'      <arg name="name" value="{name}"/>\n')
        lines.append('      <arg name="rate" value="$(arg rate)"/>\n    </include>\n  </group>\n')
    lines += [
        f'  <node pkg="{robot}_{kind}" type="{LEAVES[kind][0]}_monitor.py" name="{file}_supervisor_{number}">\n'
        f'    <param name="parts" value="{len(parts)}"/>\n'
        '    <remap from="status" to="/diagnostics"/>\n  </node>\n'
        for number in range(nodes)
    ]
    return "".join([*lines, "</launch>\n"])


def _fleet() -> str:
    """The root of the largest tree."""
    lines = ['<?xml version="1.0"?>\n<launch>\n', '  <arg name="sim" default="false"/>\n']
    lines.append('  <machine name="base_station" address="localhost" default="never"/>\n')
    for robot in HEAVY:
        lines.append(
            f'  <include file="$(find {robot}_bringup)/launch/robot.launch" ns="{robot}">\n'
            f'    <arg name="robot" value="{robot}"/>\n    <arg name="sim" value="$(arg sim)"/>\n  </include>\n'
        )
    for name in ("dispatcher", "traffic"):
        lines.append(
            f'  <node pkg="{HEAVY[0]}_bringup" type="teleop_monitor.py" name="{name}" required="true">\n'
            '    <rosparam param="robots">[' + ", ".join(HEAVY) + "]</rosparam>\n  </node>\n"
        )
    return "".join([*lines, "</launch>\n"])


def _config(robot: str, leaf: str) -> str:
    sensors = "".join(
        f"    sensor_{n}: {{type: {leaf}, frame: {robot}_{n}_link, range: [0.1, {5 + n}.0], enabled: true}}\n"
        for n in range(6)
    )
    return (
        f"# The parameters of the {leaf} of {robot}\n{leaf}:\n  rate: 20.0\n  timeout: 0.5\n  queue_size: 10\n"
        f"  frames:\n    odom: {robot}_odom\n    base: {robot}_base_link\n  sources:\n{sensors}"
        "  limits:\n    velocity: {min: -0.5, max: 1.2}\n    acceleration: {min: -2.5, max: 2.5}\n"
        '  topics:\n    - cmd_vel\n    - odom\n    - "scan"\n'
    )


_SCRIPT = """\
#!/usr/bin/env python3
import rospy
from std_msgs.msg import String

rospy.init_node("{name}")
out = rospy.Publisher("out", String, queue_size=1)
status = rospy.Publisher("status", String, queue_size=1)
rospy.Subscriber("in", String, out.publish)
frame_id = rospy.get_param("~frame_id", "base_link")
frames = rospy.get_param("~frames/odom", "odom"), rospy.get_param("~frames/base", "base_link")
timeout = rospy.get_param("~timeout", 1.0)
queue_size = rospy.get_param("~queue_size", 1)
sources = rospy.get_param("~sources", {{}})
slowest = rospy.get_param("~limits/velocity/min", 0.0)
fastest = rospy.get_param("~limits/velocity/max", 1.0)
window = rospy.get_param("~window/size", 10), rospy.get_param("~window/overlap", 0.0)
axes = rospy.get_param("~axes", [])
use_gpu = rospy.get_param("~use_gpu", False)
parts = rospy.get_param("~parts", 0)
robots = rospy.get_param("~robots", [])
of_{leaf} = rospy.get_param("~{leaf}", {{}})
rate = rospy.Rate(rospy.get_param("~rate", 10))
while not rospy.is_shutdown():
    status.publish("alive")
    rate.sleep()
"""


if __name__ == "__main__":
    print(generate(Path(sys.argv[1])).root)
