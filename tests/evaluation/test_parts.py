"""With its parts remembered a launch of ROS 2 is what it is without: whatever is edited, in whatever of its files."""

from __future__ import annotations

import random
from pathlib import Path

import pytest
from preflight_analysis.environment.executables import ExecutableIndex
from preflight_analysis.environment.model import Environment
from preflight_analysis.evaluation.ros2.evaluate import evaluate_ros2
from preflight_analysis.evaluation.surroundings import Surroundings
from preflight_analysis.evaluation.tree import LaunchTree
from preflight_analysis.incremental.database import Database
from preflight_analysis.incremental.query import query
from preflight_analysis.workspace.sources import Sources

NAMES = ("root.launch.xml", "one.launch.xml", "two.launch.yaml", "three.launch.xml")
XML = (
    '<node pkg="p" exec="t" name="$(var a)"/>',
    '<node pkg="p" exec="t" name="n" args="$(var b none) $(dirname) $(env E none)"/>',
    '<node pkg="p" exec="t" name="$(anon n)"><param name="x" value="$(var a)"/><remap from="x" to="$(var b)"/></node>',
    '<node pkg="p" exec="t" name="m" if="$(var a)"><env name="F" value="$(param x none)"/></node>',
    '<node pkg="p" exec="t" name="f"><param from="$(var a).yaml"/></node>',
    '<node_container pkg="p" exec="t" name="c" namespace="/">\n  <composable_node pkg="p" plugin="P" name="$(var a)"/>'
    '  <composable_node pkg="p" plugin="P" name="d" if="$(var a)"/>\n</node_container>',
    '<executable cmd="echo $(var a) $(not $(var b false))"/>',
    '<arg name="a" default="true"/>',
    '<arg name="a" default="0"/>',
    '<arg name="a"/>',
    '<arg name="b" default="$(var a)_"/>',
    '<let name="a" value="1"/>',
    '<let name="a" value="$(var a x)y"/>',
    '<let name="b" value="false"/>',
    '<set_env name="E" value="$(var a)"/>',
    '<append_env name="E" value="e"/>',
    '<unset_env name="E"/>',
    "<reset_env/>",
    '<push_ros_namespace namespace="$(var b ns)"/>',
    '<set_remap from="x" to="/$(var a z)"/>',
    '<set_parameter name="x" value="1"/>',
    '<set_parameter name="x" value="1.0"/>',
    '<set_parameter name="x" value="true"/>',
    '<set_parameters_from_file filename="true.yaml"/>',
    '<reset><keep name="a" value="kept"/></reset>',
    "<group>{}</group>",
    '<group scoped="false">{}</group>',
    '<group forwarding="false"><keep name="a" value="$(var b kept)"/>{}</group>',
    '<group if="$(var a)">{}</group>',
    '<timer period="1.0">{}</timer>',
    '<for len="2" name="i"><let name="b" value="$(index i)"/>{}</for>',
    '<include file="{below}"/>',
    '<include file="{below}">\n  <arg name="a" value="$(var b x)"/>\n</include>',
    '<include file="{below}"><arg name="b" value="0"/>\n  <arg name="unused" value="0"/></include>',
    '<include file="$(var b {below})"/>',
    "<!-- a comment -->",
    '<node pkg="p" nam="half"',
)
YAML = (
    "- node: {pkg: p, exec: t, name: $(var a)}",
    "# preflight: ignore\n- node:\n    pkg: p\n    exec: t\n    name: n\n    args: $(var b none) $(dirname)",
    "- node: &n {pkg: p, exec: t, name: $(anon n)}\n- node: *n",
    "- arg: {name: a, default: '0'}",
    "- let: {name: a, value: $(var b z)}",
    "- set_env: {name: E, value: yaml}",
    "- set_remap: {from: y, to: $(var a w)}",
    "- group:\n  - push_ros_namespace: {namespace: g}\n  - set_parameter: {name: x, value: '1'}\n"
    "  - node: {pkg: p, exec: t, name: inside}",
    "- include: {file: BELOW, arg: [{name: a, value: '3'}]}",
    "- include:\n    file: BELOW\n    if: $(var a)",
)


@query
def remembering(db: Database, within: Surroundings, path: str) -> LaunchTree:
    """A launch, of which parts are remembered."""
    return evaluate_ros2(path, {}, within, by_parts=True)


class Twice:
    """Evaluates a launch with its parts remembered throughout, and without."""

    def __init__(self, folder: Path) -> None:
        self.folder, self.sources = folder, Sources()
        (folder / "true.yaml").write_text("/**:\n  ros__parameters:\n    x: 1\nn:\n  ros__parameters: {y: 2}\n")
        environment = Environment(2, "jazzy", {"E": "e", "HOME": "/"}, (), {}, {}, (), (), None)
        executables, cwd = ExecutableIndex(environment, self.sources), str(folder)
        self._within = Surroundings(self.sources, executables, environment, cwd)
        self.remembered: LaunchTree | None = None

    def write(self, name: str, lines: list[str]) -> None:
        """Edit a file, as an editor does."""
        text = "\n".join(["launch:", *lines] if name.endswith("yaml") else ["<launch>", *lines, "</launch>"])
        self.sources.open(str(self.folder / name), text)

    def tree(self, name: str = NAMES[0]) -> LaunchTree:
        """The tree, which is the same both ways."""
        within, path = self._within, str(self.folder / name)
        without = evaluate_ros2(path, {}, within)
        remembered = self.remembered = remembering(self.sources.db, within, path)
        assert repr(remembered) == repr(without)  # 1 is not 1.0
        assert remembered == without
        return remembered


def line(chance: random.Random, name: str, folder: Path, depth: int = 0) -> str:
    """Something to stand in a file, which includes those that come after it."""
    later = NAMES[NAMES.index(name) + 1 :]
    below = str(folder / chance.choice(later)) if later and chance.random() < 0.95 else str(folder / NAMES[0])
    if name.endswith("yaml"):
        return chance.choice(YAML).replace("BELOW", below)
    found = chance.choice(XML)
    inside = "\n".join(line(chance, name, folder, depth + 1) for _ in range(3)) if "{}" in found and depth < 3 else ""
    return found.replace("{}", inside).replace("{below}", below)


@pytest.mark.parametrize("seed", range(4))
def test_after_any_edits(tmp_path: Path, seed: int) -> None:
    chance, twice = random.Random(seed), Twice(tmp_path)
    files = {name: [line(chance, name, tmp_path) for _ in range(6)] for name in NAMES}
    for name, lines in files.items():
        twice.write(name, lines)
    for _ in range(25):
        name = chance.choice(NAMES)
        lines, at = files[name], chance.randrange(7)
        before = [*lines]
        lines[at : at + chance.randrange(2)] = [line(chance, name, tmp_path) for _ in range(chance.randrange(3))]
        for each in (lines, ["", *lines], before, lines):
            twice.write(name, each)
            twice.tree()
        del lines[9:]


def test_an_edit_above_leaves_all_as_it_is(tmp_path: Path) -> None:
    twice = Twice(tmp_path)
    include = f'<include file="{tmp_path}/{{}}"><arg name="a" value="{{}}"/></include>'
    root = [include.format(NAMES[1], "x"), include.format(NAMES[2], "y"), XML[1]]
    twice.write(NAMES[1], ['<node pkg="p" exec="t" name="$(var a)"/>', '<set_remap from="x" to="y"/>'])
    twice.write(NAMES[2], [YAML[0], YAML[1]])
    twice.write(NAMES[0], root)
    before = twice.tree().nodes
    twice.write(NAMES[0], ["", '<node pkg="p" exec="t" name="new"/>', '<let name="c" value="1"/>', *root])
    after = twice.tree().nodes
    assert len(after) == len(before) + 1 == 5
    assert all(one is other for one, other in zip(after[1:], before, strict=True))
    twice.write(NAMES[0], root)
    assert all(one is other for one, other in zip(twice.tree().nodes, before, strict=True))
    twice.write(NAMES[0], [include.format(NAMES[1], "z"), *root[1:]])
    changed = [one is other for one, other in zip(twice.tree().nodes, before, strict=True)]
    assert changed == [False, True, True, True], "what comes after the include passes another value itself"


def test_what_an_include_sets_stays_set(tmp_path: Path) -> None:
    twice = Twice(tmp_path)
    twice.write(NAMES[1], ['<let name="a" value="1"/>', '<set_env name="E" value="$(var a)"/>'])
    root = [f'<include file="{tmp_path}/{NAMES[1]}"/>', '<node pkg="p" exec="t" name="n" args="$(var a) $(env E)"/>']
    for above in ([], [""], ['<arg name="a" default="0"/>'], ["<!-- -->"]):
        twice.write(NAMES[0], [*above, *root])
        assert twice.tree().nodes[0].args == "1 1"
        assert dict(twice.tree().nodes[0].env) == {"E": "1"}


INNER = (
    '<node pkg="p" exec="t" name="n"><param name="x" value="1"/></node>',
    '<node pkg="p" exec="t" name="n" namespace="/abs"/>',
    '<node pkg="p" exec="t" name="n" args="$(dirname)"/>',
    '<node pkg="p" exec="t" name="n" args="$(filename) $(index i)"/>',
    '<node pkg="p" exec="t" name="n" args="$(var undeclared)"/>',
    '<node pkg="p" exec="t" name="n" args="$(anon n)"/>',
    '<node pkg="p" exec="$(find-exec program)"/>',
    '<group><set_remap from="p" to="q"/><set_parameter name="z" value="1"/></group>',
    '<group forwarding="false"><node pkg="p" exec="t" name="n"/></group>',
    '<set_remap from="p" to="q"/>',
    '<reset/><set_parameter name="z" value="1"/>',
    '<push_ros_namespace namespace="deeper"/>',
    '<unset_env name="E"/><set_env name="E" value="again"/>',
)
ABOVE = (
    "",
    '<include file="$(var nowhere)"/>',
    '<push_ros_namespace namespace="above"/>',
    '<push_ros_namespace namespace="/$(var undeclared)"/>',
    '<set_remap from="x" to="y"/>',
    '<set_parameter name="z" value="0"/>',
    '<let name="undeclared" value="1"/>',
    '<let name="other" value="1"/>',
    '<include file="{}"/>',
    '<let name="anonn" value="known"/>',
    '<executable cmd="$(anon n)"/>',
    '<set_env name="PATH" value="{}"/>',
    '<set_env name="E" value="other"/>',
    "<reset_env/>",
)
AROUND = ("{}", "<group>{}</group>", '<for len="2" name="i">{}</for>', '<for len="1" name="i">{}</for>')
AFTER = '<node pkg="p" exec="t" name="after" args="$(var z none) $(env E none) $(dirname)"/>'


@pytest.mark.parametrize("inside", INNER)
def test_what_a_part_depends_on(tmp_path: Path, inside: str) -> None:
    twice, program = Twice(tmp_path), tmp_path / "program"
    program.write_text("#!/bin/sh")
    program.chmod(0o755)
    twice.write(NAMES[1], [inside])
    twice.write(NAMES[3], ['<let name="from three" value="1"/>'])
    for part in (inside, f'<include file="{tmp_path / NAMES[1]}"/>'):
        for around in AROUND:
            for above in ABOVE:
                known = above.replace("{}", str(tmp_path if "PATH" in above else tmp_path / NAMES[3]))
                twice.write(NAMES[0], [known, around.format(f"\n{part}\n"), AFTER])
                twice.tree()


def test_what_is_too_much_is_said_at_the_same_place(tmp_path: Path) -> None:
    twice = Twice(tmp_path)
    twice.write(NAMES[3], ['<node pkg="p" exec="t" name="$(anon n)"/>'])
    twice.write(NAMES[1], [f'<for len="900" name="i"><include file="{tmp_path / NAMES[3]}"/></for>'])
    include = f'<include file="{tmp_path / NAMES[1]}"/>'
    for count in (1, 2, 3, 2):
        twice.write(NAMES[0], [include] * count)
        twice.tree()
