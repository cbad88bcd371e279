"""Launch files of all formats that name the secrets of their user in every way there is."""

from __future__ import annotations

import json
from pathlib import Path

CANARY = "canary_7f3a91"
"""Part of every secret."""
_KEY = f"-----BEGIN OPENSSH PRIVATE KEY-----\n{CANARY}\n-----END OPENSSH PRIVATE KEY-----\n"
VARIABLES = {
    "ROBOT_TOKEN": CANARY,
    "DB_PASSWORD": f"{CANARY} and more",
    "ORIGIN": f"https://me:{CANARY}@example.org",
}
FORMATS = ("hostile.launch", "hostile.launch.xml", "hostile.launch.yaml", "hostile.launch.py")


def write_secrets(home: Path, package: Path) -> list[str]:
    """Write secrets into a home folder and a package of a workspace; the paths that lead to them."""
    package.mkdir(parents=True, exist_ok=True)
    files = {home / ".ssh/robot": f"password: {CANARY}\n", home / ".netrc": f"machine a password {CANARY}\n"}
    files |= {package / ".env": f"TOKEN: {CANARY}\n", package / "notes.txt": _KEY}
    for path, text in files.items():
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    links = {"link.yaml": home / ".ssh/robot", "folder": home / ".ssh", "root": Path("/proc/self/root")}
    for name, target in links.items():
        (package / name).symlink_to(target)
    others = ("link.yaml", "folder/robot", f"root{home}/.netrc")
    return [*map(str, files), *(f"{package}/{name}" for name in others), "/proc/self/environ"]


def write_launch_files(package: Path, paths: list[str], node: tuple[str, str]) -> list[Path]:
    """Write a launch file of each format that gives all secrets to a node."""
    (package / "package.xml").write_text("<package><name>hostile</name></package>")
    written = (_ros1(paths, node), _xml(paths, node), _yaml(paths, node), _python(paths, node))
    for name, text in zip(FORMATS, written, strict=True):
        (package / name).write_text(text)
    return [package / name for name in FORMATS]


def _ros1(paths: list[str], node: tuple[str, str]) -> str:
    tags = []
    for at, path in enumerate(paths):
        tags += [
            f'<param name="text{at}" textfile="{path}"/>',
            f'<param name="data{at}" type="str" binfile="{path}"/>',
            f'<param name="command{at}" command="cat {path}"/>',
            f'<param name="shell{at}" command="sh -c \'cat &quot;{path}&quot;\'"/>',
            f'<rosparam command="load" file="{path}"/>',
            f'<include file="{path}"/>',
        ]
    for name in VARIABLES:
        tags += [
            f'<param name="{name}" value="$(env {name})"/>',
            f'<param name="of_{name}" value="$(optenv {name} none)"/>',
            f"<param name=\"eval_{name}\" value=\"$(eval 'x' + env('{name}'))\"/>",
            f"<param name=\"opt_{name}\" value=\"$(eval optenv('{name}', 'none'))\"/>",
        ]
    pkg, program = node
    return (
        f'<launch>\n  <node pkg="{pkg}" type="{program}" name="spy">\n'
        + "\n".join(tags[-12:])
        + ("\n  </node>\n" + "\n".join(tags) + "\n</launch>\n")
    )


def _xml(paths: list[str], node: tuple[str, str]) -> str:
    inside, beside = [], []
    for at, path in enumerate(paths):
        inside += [
            f'<param from="{path}"/>',
            f'<param name="text{at}" value="$(file-content {path})"/>',
            f'<param name="command{at}" value="$(command \'cat {path}\')"/>',
        ]
        beside.append(f'<include file="{path}"/>')
    for name in VARIABLES:
        inside += [
            f'<param name="{name}" value="$(env {name})"/>',
            f'<param name="of_{name}" value="$(env {name} none)"/>',
        ]
    pkg, program = node
    lines = "\n".join(inside)
    return (
        f'<launch>\n<node pkg="{pkg}" exec="{program}" name="spy">\n{lines}\n</node>\n'
        + "\n".join(beside)
        + "\n</launch>\n"
    )


def _yaml(paths: list[str], node: tuple[str, str]) -> str:
    params: list[dict[str, str]] = []
    for at, path in enumerate(paths):
        params += [{"from": path}, {"name": f"text{at}", "value": f"$(file-content {path})"}]
        params.append({"name": f"command{at}", "value": f"$(command 'cat {path}')"})
    for name in VARIABLES:
        params += [{"name": name, "value": f"$(env {name})"}, {"name": f"of_{name}", "value": f"$(env {name} none)"}]
    pkg, program = node
    tags: list[object] = [{"node": {"pkg": pkg, "exec": program, "name": "spy", "param": params}}]
    tags += [{"include": {"file": path}} for path in paths]
    return json.dumps({"launch": tags}, indent=1)


def _python(paths: list[str], node: tuple[str, str]) -> str:
    return f"""import os
from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription
from launch.substitutions import Command, EnvironmentVariable, FileContent
from launch_ros.actions import Node

PATHS = {paths!r}
NAMES = {list(VARIABLES)!r}


def read(path):
    try:
        with open(path) as file:
            return file.read()
    except OSError:
        return "nothing"


def generate_launch_description():
    params = list(PATHS)
    params += [{{"read%d" % at: read(path)}} for at, path in enumerate(PATHS)]
    params += [{{"text%d" % at: FileContent(path)}} for at, path in enumerate(PATHS)]
    params += [{{"command%d" % at: Command(["cat ", path])}} for at, path in enumerate(PATHS)]
    params += [{{name: EnvironmentVariable(name)}} for name in NAMES]
    params += [{{"or_" + name: EnvironmentVariable(name, default_value="none")}} for name in NAMES]
    token = os.environ["ROBOT_TOKEN"]
    params += [{{"got": "x" + token, "password": os.environ.get("DB_PASSWORD", "none"), "origin": os.getenv("ORIGIN")}}]
    more = {{"T": token}}
    node = Node(package={node[0]!r}, executable={node[1]!r}, name="spy", parameters=params, additional_env=more)
    return LaunchDescription([node, *map(IncludeLaunchDescription, PATHS)])
"""
