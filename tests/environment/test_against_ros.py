"""Packages and executables are those that the real rospkg and roslib find."""

from __future__ import annotations

import json
import random
import subprocess
from pathlib import Path

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.environment.executables import ExecutableIndex
from support.package_folders import file, package, script, space

ORACLE = """
import json, os, sys
job = json.load(sys.stdin)
os.environ["CMAKE_PREFIX_PATH"] = job["prefixes"]
import rospkg, roslib.packages
rospack = rospkg.RosPack(job["path"])
found = {name: rospack.get_path(name) for name in rospack.list()}
find = roslib.packages.find_node
nodes = [find(package, name, rospack) if package in found else None for package, name in job["nodes"]]
json.dump({"packages": found, "nodes": nodes}, sys.stdout)
"""


@pytest.mark.ros
def test_packages_and_executables_are_those_of_ros(tmp_path: Path) -> None:
    rng = random.Random(1)
    names = [f"p{i}" for i in range(12)]
    types = ["talker", "listener.py", "driver"]
    sources = [tmp_path / "one" / "src", tmp_path / "two" / "src"]
    for source in sources:
        for _ in range(25):
            depth = [f"d{rng.randrange(4)}" for _ in range(rng.randrange(3))]
            share = package(source.joinpath(*depth, f"f{rng.randrange(1000)}"), rng.choice(names))
            for _ in range(rng.randrange(4)):
                below = [f"s{rng.randrange(3)}" for _ in range(rng.randrange(3))]
                file(share.joinpath(*below, rng.choice(types)), rng.choice([0o755, 0o644, 0o500, 0o111]))
        file(source / "ignored" / "CATKIN_IGNORE")
        package(source / "ignored" / "q", "ignored")
        package(source / "meta", body="<export><metapackage/></export>")
        file(source / "legacy" / "manifest.xml", text="<package/>")
        script(source / "legacy" / "talker")
    (sources[0] / "link").symlink_to(sources[1])
    # catkin itself refuses a devel space with two packages of a name.
    built = tmp_path / "built" / "src"
    for name in names[:6]:
        script(package(built / "d" / f"folder-{name}", name) / "scripts" / rng.choice(types))
    spaces = [space(tmp_path / "built" / "devel", built), space(tmp_path / "two" / "install")]
    for folder in spaces:
        for kind in ("lib", "share", "libexec"):
            for name in rng.sample(names, 5):
                script(folder / kind / name / rng.choice(types))
    path = [str(sources[1]), str(sources[0]), "/usr/share"]
    prefixes = ":".join(map(str, spaces))
    nodes = [
        (name, kind)
        for name in [*names, "legacy", "meta", "ignored", "rosout", "rosbag", "roslaunch"]
        for kind in types
    ]
    nodes += [("rosout", "rosout"), ("rosbag", "play"), ("rosbag", "record"), ("gone", "gone")]

    answer = subprocess.run(
        ["/usr/bin/python3", "-c", ORACLE],
        input=json.dumps({"path": path, "prefixes": prefixes, "nodes": nodes}),
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert answer.returncode == 0, answer.stderr
    theirs = json.loads(answer.stdout)
    environment = detect_environment(None, {"CMAKE_PREFIX_PATH": prefixes}, path)
    assert {name: found.share for name, found in environment.packages.items()} == theirs["packages"]
    index = ExecutableIndex(environment)
    ours = []
    for name, kind in nodes:
        found = index.find(name, kind)
        ours.append(None if found.package_path is None else list(found.candidates))
    assert ours == theirs["nodes"]
    assert sum(1 for candidates in ours if candidates) > 20
