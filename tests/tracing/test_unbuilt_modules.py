"""Nodes of a catkin workspace that was not built: Python modules come from their source, messages are not there yet."""

from __future__ import annotations

import threading
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from types import MappingProxyType

import pytest
from preflight_analysis.documents.disk import Disk
from preflight_analysis.environment.catkin_python import source_folders
from preflight_analysis.environment.model import Environment
from preflight_analysis.environment.packages import find_packages
from preflight_analysis.tracing.interface import Interface
from preflight_analysis.tracing.trace import Tracer
from support.tracing_harness import environment, own, request, write_node

pytestmark = pytest.mark.ros

SETUP = """
from distutils.core import setup
from catkin_pkg.python_setup import generate_distutils_setup
d = generate_distutils_setup({})
{}
setup(**d)
"""


def package(
    folder: Path,
    name: str,
    *,
    setup: str = "",
    lists: str = "catkin_python_setup()\n",
    files: Mapping[str, str] = MappingProxyType({}),
) -> Path:
    """A package; `setup` is its setup.py."""
    share = folder / name
    share.mkdir(parents=True)
    (share / "package.xml").write_text(f'<package format="2"><name>{name}</name></package>')
    (share / "CMakeLists.txt").write_text(f"project({name})\n{lists}")
    if setup:
        (share / "setup.py").write_text(setup)
    for path, text in files.items():
        place = share / path
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_text(text)
    return share


def found_in(folder: Path) -> Environment:
    found = environment(folder)
    return replace(found, packages=find_packages([str(folder)]).packages)


def run(folder: Path, body: str) -> Interface:
    scripts = folder / "scripts"
    scripts.mkdir(exist_ok=True)
    node = write_node(scripts, body)
    return Tracer(found_in(folder), None).trace(request(node), threading.Event())


NODE = """
import rospy
from std_msgs.msg import String
from {} import TOPIC
rospy.init_node("n")
rospy.Publisher(TOPIC, String, queue_size=1)
rospy.spin()
"""


@pytest.mark.parametrize(
    ("setup", "where"),
    [
        (SETUP.format("packages=['robot'], package_dir={'': 'src'}", ""), "src/robot"),
        (SETUP.format("", "d['packages'] = ['robot']\nd['package_dir'] = {'': 'python'}"), "python/robot"),
        (SETUP.format("packages=['robot'], package_dir={'robot': 'lib/robot'}", ""), "lib/robot"),
        (SETUP.format("packages=['robot']", ""), "robot"),
    ],
)
def test_a_package_is_imported_from_its_source(tmp_path: Path, setup: str, where: str) -> None:
    share = package(tmp_path, "p", setup=setup)
    (share / where).mkdir(parents=True)
    (share / where / "__init__.py").write_text("")
    (share / where / "names.py").write_text("TOPIC = 'hello'\n")
    interface = run(tmp_path, NODE.format("robot.names"))
    assert interface.outcome.status == "spinning", interface.outcome
    assert own(interface) == {("publisher", "hello", "std_msgs/String")}


def test_without_the_call_in_cmake_a_package_is_not_there(tmp_path: Path) -> None:
    setup = SETUP.format("packages=['robot'], package_dir={'': 'src'}", "")
    lists = "# catkin_python_setup()\n"
    package(tmp_path, "p", setup=setup, lists=lists, files={"src/robot/__init__.py": ""})
    assert source_folders(Disk(), found_in(tmp_path)) == ()
    interface = run(tmp_path, NODE.format("robot"))
    assert interface.outcome.status == "crashed"


def test_what_is_installed_is_found_before_the_source(tmp_path: Path) -> None:
    setup = SETUP.format("packages=['std_msgs'], package_dir={'': 'src'}", "")
    package(tmp_path, "std_msgs", setup=setup, files={"src/std_msgs/__init__.py": "raise RuntimeError\n"})
    package(tmp_path, "q", setup=SETUP.format("packages=['q']", ""), files={"q/__init__.py": "TOPIC = 'hello'\n"})
    assert run(tmp_path, NODE.format("q")).outcome.status == "spinning"


def test_messages_that_were_not_generated_are_made_of_their_definitions(tmp_path: Path) -> None:
    package(tmp_path, "arm_msgs", lists="")
    (tmp_path / "arm_msgs" / "msg").mkdir()
    (tmp_path / "arm_msgs" / "msg" / "Joint.msg").write_text("float64 angle\n")
    node = (
        "import rospy\nfrom arm_msgs.msg import Joint\nrospy.init_node('n')\nassert Joint().angle == 0\nrospy.spin()\n"
    )
    interface = run(tmp_path, node)
    assert (interface.source, interface.outcome.status, interface.stand_ins) == ("trace", "spinning", ("arm_msgs",))


def test_services_beside_python_modules_that_were_not_generated_are_made_of_their_definitions(tmp_path: Path) -> None:
    setup = SETUP.format("packages=['arm'], package_dir={'': 'src'}", "")
    share = package(tmp_path, "arm", setup=setup, files={"src/arm/__init__.py": ""})
    (share / "srv").mkdir()
    (share / "srv" / "Move.srv").write_text("---\n")
    interface = run(tmp_path, "import rospy\nfrom arm.srv import Move, MoveRequest\nMoveRequest()\n")
    assert (interface.outcome.status, interface.stand_ins) == ("exited", ("arm",))


def test_what_a_build_of_the_workspace_does_not_make_is_a_crash(tmp_path: Path) -> None:
    package(tmp_path, "arm", lists="")
    (tmp_path / "arm" / "msg").mkdir()
    (tmp_path / "arm" / "msg" / "Joint.msg").write_text("float64 angle\n")
    assert run(tmp_path, "import rospy\nfrom arm.msg import Hand\n").outcome.status == "crashed"
