"""Files that are not what they seem, or shut to the user, and paths with odd characters: `check` reports what it cannot
read, in time, and each format keeps its form."""

from __future__ import annotations

import json
import os
import re
import shutil
import socket
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree
from collections.abc import Callable, Iterator
from pathlib import Path
from urllib.parse import unquote_to_bytes

import pytest
from support.ordinary_user import become
from tools.attacks import readable_python

pytestmark = pytest.mark.ros

MANIFEST = """<package format="2"><name>odd</name><version>1.0.0</version><description>d</description>
<maintainer email="a@b.c">a</maintainer><license>BSD</license></package>"""
LAUNCH = """<launch>
  <include file="$(find odd)/launch/inc.launch"/>
  <node pkg="odd" type="n.py" name="n"><rosparam command="load" file="$(find odd)/config/p.yaml"/></node>
  <param name="x" command="cat $(find odd)/config/p.yaml"/>
  <param name="typo" value="$(arg missing)"/>
</launch>
"""
NODE = "#!/usr/bin/env python3\nimport rospy\nrospy.init_node('n')\nrospy.get_param('~a')\nrospy.spin()\n"


def create(workspace: Path, package: str = "odd", launch: str = "main.launch") -> Path:
    """A package with a launch file, all that this names, and one error at its fifth line."""
    folder = workspace / "src" / package
    for below, text in (
        ("package.xml", MANIFEST),
        ("CMakeLists.txt", "project(odd)\nfind_package(catkin REQUIRED)\ncatkin_package()\n"),
        ("config/p.yaml", "a: 1\n"),
        ("scripts/n.py", NODE),
        ("launch/inc.launch", "<launch/>\n"),
        (f"launch/{launch}", LAUNCH),
    ):
        place = folder / below
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_text(text)
    (folder / "scripts/n.py").chmod(0o755)
    return folder


class User:
    """One who is not root, with a workspace of its own."""

    def __init__(self, folder: Path) -> None:
        self.workspace, self.home = folder / "workspace", folder / "home"
        self.home.mkdir()
        self.root = os.geteuid() == 0

    def check(self, launch: Path | None, *options: str) -> tuple[int, str, str]:
        """Exit code and what it says, without a run."""
        prefix: list[str] = ["env"]
        python: list[str] = [sys.executable]
        if self.root:
            prefix, python = [*become("nobody"), "env"], readable_python("nobody")
            for place in (self.home, self.workspace, *self.workspace.rglob("*")):
                os.chown(place, *NOBODY, follow_symlinks=False)
        variables = ["-i", f"HOME={self.home}", "PATH=/usr/bin:/bin", f"ROS_PACKAGE_PATH={self.workspace}/src"]
        variables += ["ROS_DISTRO=noetic", "ROS_VERSION=1", f"XDG_CACHE_HOME={self.workspace}/cache"]
        named = [str(launch)] if launch is not None else []
        done = subprocess.run(
            [*prefix, *variables, *python, "-m", "preflight_server.cli.main", "check", "--no-run", *options, *named],
            capture_output=True,
            timeout=60,
            check=False,
            cwd=self.workspace,
        )
        said = done.stdout.decode("utf-8", "surrogateescape"), done.stderr.decode("utf-8", "surrogateescape")
        assert "Traceback" not in "".join(said), said
        return done.returncode, *said


NOBODY = (65534, 65534)


@pytest.fixture
def user() -> Iterator[User]:
    with tempfile.TemporaryDirectory(prefix="preflight-odd-", dir="/tmp", ignore_cleanup_errors=True) as folder:
        Path(folder).chmod(0o755)
        yield User(Path(folder))
        for place in Path(folder).rglob("*"):
            if place.is_dir() and not place.is_symlink():
                place.chmod(0o700)


def shut(place: Path) -> None:
    place.chmod(0)


def looped(place: Path) -> None:
    removed(place)
    place.symlink_to(place)


def piped(place: Path) -> None:
    removed(place)
    os.mkfifo(place, 0o666)


def bound(place: Path) -> None:
    removed(place)
    with socket.socket(socket.AF_UNIX) as end:
        before = os.getcwd()
        os.chdir(place.parent)
        end.bind(place.name)
        os.chdir(before)


def endless(place: Path) -> None:
    removed(place)
    place.symlink_to("/dev/zero")


def removed(place: Path) -> None:
    if place.is_dir():
        shutil.rmtree(place)
    else:
        place.unlink(missing_ok=True)


WAYS = (shut, looped, piped, bound, endless)
SAID = {
    "launch/main.launch": "main.launch",
    "launch/inc.launch": "included file 'odd/launch/inc.launch'",
    "config/p.yaml": "parameter file 'odd/config/p.yaml'",
    "package.xml": "package.xml",
    "scripts/n.py": "n.py",
}


@pytest.mark.parametrize("way", WAYS, ids=lambda way: way.__name__)
@pytest.mark.parametrize("path", SAID)
def test_a_file_that_cannot_be_read(user: User, path: str, way: Callable[[Path], None]) -> None:
    package = create(user.workspace)
    way(package / path)
    code, out, err = user.check(package / "launch/main.launch")
    assert SAID[path] in out + err
    assert code in (1, 2)
    assert (code == 2) == ("ros-preflight: " in err)
    if way is shut:
        assert "does not exist" not in out + err


@pytest.mark.parametrize("way", [shut, looped])
@pytest.mark.parametrize("path", ["launch", "config", "scripts", "."])
def test_a_folder_that_cannot_be_read(user: User, path: str, way: Callable[[Path], None]) -> None:
    package = create(user.workspace)
    way(package / path if path != "." else package)
    code, out, err = user.check(package / "launch/main.launch")
    if path in (".", "launch"):
        reason = "permission denied" if way is shut else "too many levels of symbolic links"
        assert (code, err) == (2, f"ros-preflight: {package}/launch/main.launch cannot be read: {reason}\n")
    else:
        assert code == 1
    if way is shut:
        assert "does not exist" not in out + err


@pytest.mark.parametrize("way", WAYS, ids=lambda way: way.__name__)
@pytest.mark.parametrize("path", [".ros-preflight.yaml", "cache"])
def test_settings_and_cache_that_cannot_be_read(user: User, path: str, way: Callable[[Path], None]) -> None:
    """Settings are reported; without a cache it does its work."""
    package = create(user.workspace)
    (user.workspace / "cache").mkdir()
    (user.workspace / ".ros-preflight.yaml").touch()
    way(user.workspace / path)
    code, out, _ = user.check(package / "launch/main.launch")
    assert ("settings file cannot be read" in out or "settings file is" in out) == (path != "cache"), out
    assert "argument 'missing'" in out
    assert code == 1


def test_links_that_lead_round_in_circles(user: User) -> None:
    """On the package path, in a package, and from one launch file to the next."""
    package = create(user.workspace)
    (package / "up").symlink_to("../..")
    (user.workspace / "src/again").symlink_to(".")
    (package / "launch/inc.launch").unlink()
    (package / "launch/inc.launch").symlink_to("main.launch")
    code, out, _ = user.check(package / "launch/main.launch")
    assert "includes itself" in out or "LCH015" in out or "circular" in out, out
    assert code == 1
    assert user.check(None)[0] == 1


ODD = ("a blank quo'te", 'dou"ble a&b<c>]]>', "per%0Acent ha#sh [a]*?", "line\nbreak::error::x", "-dash", "\udcff")
ODD += ("co:lon,x=y $(pwd) back\\slash", "esc\x1b[31m bell\x07 right\u202eleft")


@pytest.mark.parametrize("name", ODD)
def test_a_path_with_odd_characters(user: User, name: str) -> None:
    """Of the folder of the workspace, of the package and of the launch file."""
    user.workspace /= name
    package = create(user.workspace, name, f"{name}.launch")
    launch = package / "launch" / f"{name}.launch"
    below = str(launch.relative_to(user.workspace))
    pictures = re.sub("[\x00-\x1f]", lambda control: chr(0x2400 + ord(control[0])), below)
    seen = re.sub("[\u202e\udc80-\udcff]", "\N{REPLACEMENT CHARACTER}", pictures)
    _, text, _ = user.check(launch)
    assert f"{seen}:5:" in text
    assert not re.search("[\x00-\x09\x0b-\x1f\u202e]|^::", text, re.MULTILINE), "what a terminal or a CI obeys"

    _, said, _ = user.check(launch, "--format", "github")
    files = {line.partition("file=")[2].partition(",line=")[0] for line in said.splitlines() if line.startswith("::")}
    assert {unescaped(each) for each in files} == {seen}

    _, said, _ = user.check(launch, "--format", "sarif")
    results = json.loads(said)["runs"][0]["results"]
    uris = {each["locations"][0]["physicalLocation"]["artifactLocation"]["uri"] for each in results}
    assert {os.fsdecode(unquote_to_bytes(uri)) for uri in uris} == {below}

    _, said, _ = user.check(launch, "--format", "junit")
    ElementTree.fromstring(said)


def unescaped(value: str) -> str:
    """A property of a workflow command, as GitHub's runner reads it."""
    for code, character in (("%3A", ":"), ("%2C", ","), ("%0D", "\r"), ("%0A", "\n"), ("%25", "%")):
        value = value.replace(code, character)
    return value
