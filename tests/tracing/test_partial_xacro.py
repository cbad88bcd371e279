"""Descriptions that include packages which are not installed: what is known without them."""

from __future__ import annotations

import importlib
import sys
from pathlib import Path
from types import ModuleType

import pytest
from preflight_analysis.evaluation.partial_text import is_whole, lacks_of
from preflight_analysis.robot.parse import parse_description
from preflight_analysis.tracing.agents import partial_xacro

_ROBOT = '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">{}</robot>'
_INCLUDE = '<xacro:include filename="$(find missing)/urdf/parts.xacro"/>'


@pytest.fixture
def xacro(monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    """xacro that finds no package, and leaves out what it lacks."""
    for name in [name for name in sys.modules if name.partition(".")[0] == "xacro"]:
        monkeypatch.delitem(sys.modules, name)
    lacking = partial_xacro.Lacking()
    for name in ("ament_index_python", "ament_index_python.packages"):
        module = ModuleType(name)
        vars(module).update(get_package_share_directory=lacking.miss, PackageNotFoundError=KeyError)
        monkeypatch.setitem(sys.modules, name, module)
    found = importlib.import_module("xacro")
    assert partial_xacro.can_install(found)
    partial_xacro.install(found, lacking)
    return found


def _made(xacro: ModuleType, tmp_path: Path, content: str) -> str:
    path = tmp_path / "robot.xacro"
    path.write_text(_ROBOT.format(content))
    return str(xacro.process_file(str(path)).toprettyxml())


@pytest.mark.parametrize(
    ("content", "links"),
    [
        ('<link name="a"/>', ["a"]),
        ('<xacro:camera parent="a"><origin xyz="0 0 0"/></xacro:camera><link name="a"/>', ["a"]),
        ('<xacro:call macro="camera"/><link name="a"/>', ["a"]),
        ('<link name="${prefix}a"/><link name="b"/>', ["b"]),
        ('<xacro:if value="${model == \'x\'}"><link name="a"/></xacro:if><link name="b"/>', ["b"]),
        ('<xacro:unless value="${model == \'x\'}"><link name="a"/></xacro:unless><link name="b"/>', ["b"]),
        ('<xacro:property name="twice" value="${2 * size}"/><link name="a${twice}"/><link name="b"/>', ["b"]),
        ('<link name="a"><origin xyz="0 0 ${height / 2}"/></link>', ["a"]),
        ('<link name="$(arg prefix)a"/><link name="b"/>', ["b"]),
        ('<xacro:property name="y" value="${xacro.load_yaml(\'$(find missing)/y\')}"/><link name="${y}"/>', []),
        (
            '<xacro:macro name="box" params="name *b"><link name="${name}"><xacro:insert_block name="b"/></link>'
            '</xacro:macro><xacro:box name="a"><xacro:camera/></xacro:box><xacro:box name="b"><origin/></xacro:box>',
            ["b"],
        ),
        ('<xacro:insert_block name="parts"/><link name="a"/>', ["a"]),
    ],
)
def test_what_does_not_depend_on_it_is_known(xacro: ModuleType, tmp_path: Path, content: str, links: list[str]) -> None:
    text = _made(xacro, tmp_path, _INCLUDE + content)
    assert lacks_of(text) == ("missing",)
    assert not is_whole(text)
    description = parse_description(text)
    assert [*description.links] == links
    assert (description.lacks, description.is_whole) == (("missing",), False)


@pytest.mark.parametrize("content", ['<link name="${prefix}a"/>', "<xacro:camera/>", '<xacro:insert_block name="b"/>'])
def test_without_a_missing_package_a_mistake_is_one(xacro: ModuleType, tmp_path: Path, content: str) -> None:
    with pytest.raises(xacro.XacroException):
        _made(xacro, tmp_path, content)


def test_a_whole_description_is_that_of_xacro(xacro: ModuleType, tmp_path: Path) -> None:
    content = (
        '<xacro:property name="side" value="left"/><xacro:if value="${side == \'left\'}"><link name="l"/></xacro:if>'
    )
    text = _made(xacro, tmp_path, content)
    assert is_whole(text)
    assert parse_description(text).links == ("l",)


def test_each_document_lacks_its_own(xacro: ModuleType, tmp_path: Path) -> None:
    assert lacks_of(_made(xacro, tmp_path, _INCLUDE))
    assert not lacks_of(_made(xacro, tmp_path, '<link name="a"/>'))


def test_the_name_of_a_package_does_not_end_the_comment(xacro: ModuleType, tmp_path: Path) -> None:
    text = _made(xacro, tmp_path, '<xacro:include filename="$(find a--b>)/x"/><link name="l"/>')
    assert lacks_of(text) == ("unresolved values",)
    assert parse_description(text).links == ("l",)


def test_a_joint_or_a_plugin_of_unknown_values_is_left_out() -> None:
    comment = "<!-- incomplete for ros-preflight without missing -->"
    joint = '<joint name="{}" type="fixed"><parent link="{}"/><child link="b"/></joint>'
    plugin = '<gazebo><plugin name="p" filename="f"><frame>${unknown}</frame><topic>t</topic></plugin></gazebo>'
    inside = f"{joint.format('${unknown}_j', 'a')}{joint.format('k', '${unknown}')}{plugin}"
    description = parse_description(f"{comment}<robot>{inside}</robot>")
    assert [(each.name, each.parent, each.child) for each in description.joints] == [("k", "", "b")]
    assert description.plugins[0].params == {"topic": "t"}
