"""The structure of robot descriptions in the catalogue."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path

import pytest
from preflight_analysis.catalogue.descriptions import DESCRIPTIONS, SUFFIX, known_descriptions
from tools.catalogue import descriptions
from tools.catalogue.descriptions import write_descriptions

_LONGEST = 1000
_LARGEST = 1_500_000
_FILE = """<robot xmlns:xacro="http://www.ros.org/wiki/xacro">
  <!-- words of others -->
  <xacro:property name="mass" value="3.2"/>
  <xacro:property name="side" value="left"/>
  <xacro:property name="which" value="${side}"/>
  <xacro:macro name="inertia" params="m"><inertial><mass value="${m}"/></inertial></xacro:macro>
  <xacro:macro name="wheel" params="name
      *origin">
    <link name="${name}_wheel"><visual/><xacro:inertia m="${mass}"/></link>
    <joint name="${name}_joint" type="continuous">
      <xacro:insert_block name="origin"/><parent link="base"/><child link="${name}_wheel"/><axis xyz="0 1 0"/>
      <limit effort="3"/>
    </joint>
    <xacro:if value="${mass > 2}"><gazebo reference="${name}_wheel"><mu1>1</mu1></gazebo></xacro:if>
    <gazebo><plugin name="p" filename="f"><odomFrame>odom</odomFrame><mu1>1</mu1></plugin></gazebo>
  </xacro:macro>
  <xacro:wheel name="${which}"><origin xyz="0 0 1"/></xacro:wheel>
</robot>"""
_ROWS = [
    [0, "robot", {}],
    [1, "xacro:property", {"name": "side", "value": "left"}],
    [1, "xacro:property", {"name": "which", "value": "${side}"}],
    [1, "xacro:macro", {"name": "inertia", "params": "m"}],
    [1, "xacro:macro", {"name": "wheel", "params": "name *origin"}],
    [2, "link", {"name": "${name}_wheel"}],
    [2, "joint", {"name": "${name}_joint", "type": "continuous"}],
    [3, "parent", {"link": "base"}],
    [3, "child", {"link": "${name}_wheel"}],
    [3, "limit", {}],
    [2, "gazebo", {}],
    [3, "plugin", {"name": "p", "filename": "f"}],
    [4, "odomFrame", {}, "odom"],
    [1, "xacro:wheel", {"name": "${which}"}],
    [2, "origin", {}],
]


def test_names_and_relations_are_taken_and_nothing_else(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = tmp_path / "owner+name" / "repo"
    (folder / "urdf").mkdir(parents=True)
    (folder / "package.xml").write_text("<package><name>parts</name><license>BSD</license></package>")
    (folder / "urdf" / "wheel.xacro").write_text(_FILE)
    for words in (["init", "-q"], ["add", "."], ["commit", "-qm", "x"]):
        subprocess.run(["git", "-c", "user.name=n", "-c", "user.email=e", *words], cwd=folder, check=True)
    monkeypatch.setattr(descriptions, "DESCRIPTIONS", tmp_path / "out")
    monkeypatch.setattr(descriptions, "DESCRIPTION_SOURCES", {"owner/name": {"jazzy": "HEAD"}})
    write_descriptions(tmp_path, ())
    head, *rows = json.loads((tmp_path / "out/jazzy/parts/urdf/wheel.xacro.json").read_text())
    assert (head[0], head[3]) == ("owner/name", "BSD")
    assert rows == _ROWS


def test_each_file_says_where_it_is_from_and_has_no_texts() -> None:
    size = 0
    for path in DESCRIPTIONS.rglob(f"*{SUFFIX}"):
        text = path.read_text(encoding="utf-8")
        size += len(text)
        head, *rows = json.loads(text)
        assert len(head) == 4, path
        assert rows[0][:2] == [0, "robot"], path
        assert all(len(value) <= _LONGEST for row in rows for value in [*row[2].values(), *row[3:]]), path
    assert 0 < size < _LARGEST


def test_what_is_installed_is_what_it_is() -> None:
    assert "ur_description" in known_descriptions("jazzy", ())["packages"]
    assert "ur_description" not in known_descriptions("jazzy", {"ur_description"})["packages"]
    assert known_descriptions("no_such", ())["packages"] == []
