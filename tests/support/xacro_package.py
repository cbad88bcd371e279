"""A package path with a real xacro, and a robot that is described with it in several files."""

from __future__ import annotations

import importlib.util
import os
import shutil
import time
from pathlib import Path

XACRO = """#!/usr/bin/env python3
import os, sys
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "lib"))
import xacro
xacro.main()
"""
PACKAGES = """import rospkg
def get_package_share_directory(name):
    return rospkg.RosPack().get_path(name)
"""
ARM = """<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:arg name="side" default="left"/>
  <xacro:include filename="$(find arm)/urdf/macros.xacro"/>
  <xacro:property name="sizes" value="${load_yaml('%s')}"/>
  <xacro:finger name="$(arg side)_thumb" length="${sizes['thumb']}"/>
</robot>
"""
MACROS = """<robot xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:macro name="finger" params="name length"><link name="${name}" length="${length}"/></xacro:macro>
</robot>
"""
LAUNCH = """<launch>
  <arg name="side" default="right"/>
  <param name="robot_description" command="$(find xacro)/xacro $(find arm)/urdf/arm.xacro side:=$(arg side)"/>
</launch>
"""


def create_robot(folder: Path) -> Path:
    """Make `folder` a catkin workspace with packages `xacro` and `arm`, all of yesterday. Its launch file."""
    (spec,) = [importlib.util.find_spec("xacro")]
    assert spec is not None, "xacro is missing: pip install --editable ."
    assert spec.origin is not None
    xacro, arm = folder / "xacro", folder / "arm"
    shutil.copytree(Path(spec.origin).parent, xacro / "lib/xacro", ignore=shutil.ignore_patterns("__pycache__"))
    (xacro / "xacro").write_text(XACRO)
    # The xacro of today asks ROS 2's index of packages.
    (xacro / "lib/ament_index_python").mkdir()
    (xacro / "lib/ament_index_python/__init__.py").touch()
    (xacro / "lib/ament_index_python/packages.py").write_text(PACKAGES)
    (xacro / "xacro").chmod(0o755)
    (arm / "urdf").mkdir(parents=True)
    (arm / "urdf/sizes.yaml").write_text("thumb: 0.25\n")
    (arm / "urdf/arm.xacro").write_text(ARM % (arm / "urdf/sizes.yaml"))
    (arm / "urdf/macros.xacro").write_text(MACROS)
    (arm / "urdf/unrelated.xacro").write_text(MACROS)
    (folder / ".catkin_workspace").touch()
    (arm / "launch").mkdir()
    launch = arm / "launch/arm.launch"
    launch.write_text(LAUNCH)
    for package, needs in ((xacro, ""), (arm, "<exec_depend>xacro</exec_depend>")):
        manifest = f'<package format="2"><name>{package.name}</name><version>1.0.0</version>{needs}</package>'
        (package / "package.xml").write_text(manifest)
    yesterday = time.time() - 86400
    for path in folder.rglob("*"):
        os.utime(path, (yesterday, yesterday))
    return launch
