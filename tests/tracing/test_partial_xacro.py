"""Descriptions that include packages which are not installed: what is known without them."""

from __future__ import annotations

import importlib
import json
import sys
from pathlib import Path
from types import ModuleType

import pytest
import yaml
from preflight_analysis.evaluation.partial_text import Catalogued, is_whole, lacks_of, missing_of
from preflight_analysis.robot.parse import parse_description
from preflight_analysis.tracing.agents import partial_xacro
from preflight_analysis.tracing.agents.skeletons import Skeletons

_ROBOT = '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">{}</robot>'
_INCLUDE = '<xacro:include filename="$(find missing)/urdf/parts.xacro"/>'


_SENSOR = [
    ["owner/name", "c0ffee", "2024-01-01", "BSD"],
    [0, "robot", {}],
    [1, "xacro:macro", {"name": "sensor", "params": "name parent *origin fast:=false"}],
    [2, "link", {"name": "${name}_link"}],
    [2, "joint", {"name": "${name}_joint", "type": "${sensor_type}"}],
    [3, "parent", {"link": "${parent}"}],
    [3, "child", {"link": "${name}_link"}],
    [2, "xacro:if", {"value": "${fast}"}],
    [3, "link", {"name": "${name}_fast"}],
    [2, "transmission", {"name": "t"}],
    [3, "joint", {"name": "${name}_joint"}],
    [4, "hardwareInterface", {}, "effort"],
]


@pytest.fixture
def xacro(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> ModuleType:
    """xacro that finds no package, knows the structure of `sensors`, and leaves out what it lacks."""
    for name in [name for name in sys.modules if name.partition(".")[0] == "xacro"]:
        monkeypatch.delitem(sys.modules, name)
    file = tmp_path / "catalogue/sensors/urdf/sensor.xacro.json"
    file.parent.mkdir(parents=True)
    file.write_text(json.dumps(_SENSOR))
    known = {"folder": str(tmp_path / "catalogue"), "distro": "jazzy", "packages": ["sensors"]}
    lacking = partial_xacro.Lacking(Skeletons(known))
    for name in ("ament_index_python", "ament_index_python.packages"):
        module = ModuleType(name)
        vars(module).update(get_package_share_directory=lacking.share_of, PackageNotFoundError=KeyError)
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
        ('<link name="a"><origin xyz="0 0 ${height / 2}"/></link><link name="${prefix}b"/>', ["a"]),
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


_SENSORS = '<xacro:include filename="$(find sensors)/urdf/sensor.xacro"/>'
_CALL = '<xacro:sensor name="s" parent="a"{}><origin xyz="${{unknown_value}} 0 0"/></xacro:sensor>'
_CATALOGUED = Catalogued("jazzy", ("sensors",))


@pytest.mark.parametrize(("more", "links"), [("", ["a", "s_link"]), (' fast="true"', ["a", "s_link", "s_fast"])])
def test_the_catalogue_has_the_structure_of_a_package(
    xacro: ModuleType, tmp_path: Path, more: str, links: list[str]
) -> None:
    text = _made(xacro, tmp_path, f'{_SENSORS}<link name="a"/>{_CALL.format(more)}')
    description = parse_description(text)
    assert [*description.links] == links
    assert (description.catalogued, description.is_whole, is_whole(text)) == (_CATALOGUED, True, False)
    (joint,) = description.joints
    assert (joint.name, joint.parent, joint.child, joint.catalogued) == ("s_joint", "a", "s_link", "sensors")
    assert joint.type == ""  # it depends on a value
    assert [(each.name, each.commands) for each in description.transmissions[0].joints] == [("s_joint", ("effort",))]


@pytest.mark.parametrize(
    "content",
    [
        _SENSORS + _CALL.format(' newer="true"'),
        f"{_SENSORS}<xacro:other_sensor/>",
        f"{_SENSORS}<sensor/>",
        f'{_SENSORS}<link name="${{value_of_sensors}}"/>',
        f'{_SENSORS}<xacro:if value="${{value_of_sensors}}"><link name="b"/></xacro:if>',
        '<xacro:include filename="$(find sensors)/urdf/newer.xacro"/>',
    ],
)
def test_what_the_catalogue_does_not_have_is_lacking(xacro: ModuleType, tmp_path: Path, content: str) -> None:
    text = _made(xacro, tmp_path, f'<link name="a"/>{content}')
    assert lacks_of(text) == ("sensors",)
    assert parse_description(text).links == ("a",)


def test_what_it_says_of_the_catalogue_is_a_text_for_yaml(xacro: ModuleType, tmp_path: Path) -> None:
    text = _made(xacro, tmp_path, f'{_SENSORS}<link name="a"/>')
    assert isinstance(yaml.safe_load(text.replace("\t", "  ")), str)  # xacro's own program puts no tabs


def test_a_mistake_is_one_beside_the_catalogue(xacro: ModuleType, tmp_path: Path) -> None:
    with pytest.raises(RuntimeError, match="missing attribute 'default'"):
        _made(xacro, tmp_path, f'{_SENSORS}<xacro:arg name="without_default"/>')


def test_a_property_whose_condition_is_not_known_is_not_known(xacro: ModuleType, tmp_path: Path) -> None:
    setting = '<xacro:if value="${value_of_sensors}"><xacro:property name="side" value="left"/></xacro:if>'
    text = _made(xacro, tmp_path, f'{_SENSORS}<xacro:property name="side" value="right"/>{setting}<link name="a"/>')
    assert parse_description(text).is_whole
    text = _made(
        xacro, tmp_path, f'{_SENSORS}<xacro:property name="side" value="right"/>{setting}<link name="${{side}}"/>'
    )
    assert (lacks_of(text), parse_description(text).links) == (("sensors",), ())


@pytest.mark.parametrize("package", ["missing", "sensors"])
def test_a_file_of_a_package_that_names_nothing_is_no_lack(xacro: ModuleType, tmp_path: Path, package: str) -> None:
    content = (
        f'<link name="a"><visual><geometry><mesh filename="file://$(find {package})/a.stl"/></geometry></visual></link>'
        f'<gazebo><plugin name="p" filename="f"><parameters>$(find {package})/a.yaml</parameters></plugin></gazebo>'
    )
    text = _made(xacro, tmp_path, content)
    description = parse_description(text)
    assert (missing_of(text), description.is_whole, is_whole(text)) == ((package,), True, False)
    assert (description.links, description.meshes, description.plugins[0].params) == (("a",), (), {})
