"""URD006: a mesh of the robot whose file does not exist."""

from pathlib import Path

import pytest
from support.check import apply, check, findings_of
from support.descriptions import said, xacro
from support.robot_launch import of_urdf, robot

_URDF = '<link name="a"><visual><geometry><mesh filename="{}"/></geometry></visual></link>'


@pytest.fixture
def package(tmp_path: Path) -> str:
    (tmp_path / "arms/meshes").mkdir(parents=True)
    (tmp_path / "arms/meshes/elbow.STL").touch()
    return f"\n//- {tmp_path}/arms/package.xml\n<package><name>arms</name></package>"


def _expected(mesh: str, message: str) -> str:
    tag = f'<mesh filename="{mesh}"/>'
    return robot(tag, f"{'^' * len(mesh)} warning[URD006] {message}".rjust(len(message) + len(mesh) + 33))


def test_another_case(package: str) -> None:
    mesh = "package://arms/meshes/elbow.stl"
    written = _expected(mesh, "mesh 'arms/meshes/elbow.stl' does not exist; did you mean 'arms/meshes/elbow.STL'?")
    text = of_urdf(_URDF.format(mesh), written + package)
    (found,) = check(text)
    assert "package://arms/meshes/elbow.STL" in apply(text, found.fixes[0].edits)["/p/arm.xacro"]


def test_a_file_by_its_path(package: str, tmp_path: Path) -> None:
    written = _expected("file://$(find arms)/meshes/wrist.stl", "mesh 'arms/meshes/wrist.stl' does not exist")
    check(of_urdf(_URDF.format(f"file://{tmp_path}/arms/meshes/wrist.stl"), written + package))


@pytest.mark.silent
def test_two_slashes_behind_the_package(package: str) -> None:
    check(of_urdf(_URDF.format("package://arms//meshes/elbow.STL"), package))


def test_a_folder_that_is_missing_is_told_once(package: str) -> None:
    meshes = [f"package://arms/parts/{name}.stl" for name in ("elbow", "wrist")]
    first = _expected(meshes[0], "folder 'arms/parts' of a mesh does not exist")
    written = first.replace("</robot>", f'<mesh filename="{meshes[1]}"/></robot>')
    links = _URDF.format(meshes[0]).replace("</link>", f'<collision><mesh filename="{meshes[1]}"/></collision></link>')
    check(of_urdf(links, written + package))


def test_a_slip_in_the_package(package: str) -> None:
    mesh = "package://armss/meshes/elbow.STL"
    text = of_urdf(_URDF.format(mesh), _expected(mesh, "package 'armss' of a mesh does not exist") + package)
    (found,) = check(text)
    assert "package://arms/meshes" in apply(text, found.fixes[0].edits)["/p/arm.xacro"]


@pytest.mark.silent
@pytest.mark.parametrize(
    "mesh",
    [
        "package://arms/meshes/elbow.STL",
        "package://elsewhere/meshes/elbow.stl",
        "file:///home/me/elbow.stl",
        "model://arm/elbow.stl",
        "elbow.stl",
    ],
)
def test_one_that_is_there_or_may_be(mesh: str, package: str) -> None:
    check(of_urdf(_URDF.format(mesh), "<robot/>" + package))


def test_one_in_a_submodule_that_is_not_checked_out(package: str, tmp_path: Path) -> None:
    (tmp_path / ".git").mkdir()
    (tmp_path / ".gitmodules").write_text('[submodule "cad"]\n\tpath = arms/cad\n\turl = https://example.org/cad.git\n')
    (tmp_path / "arms/cad").mkdir()
    mesh = "package://arms/cad/wrist.stl"
    written = robot(f'<mesh filename="{mesh}"/>')
    (found,) = findings_of(of_urdf(_URDF.format(mesh), written + package))
    assert (found.rule, found.severity) == ("URD006", "hint")
    assert found.lack is not None
    assert found.lack.remedy == "git submodule update --init arms/cad"


MESH = '<link name="a"><visual><geometry><mesh filename="{}"/></geometry></visual></link>'
MODEL = '<sdf version="1.6"><model name="box"><link name="a"><uri>{}</uri></link></model></sdf>'
FILES = {"meshes/elbow_link.stl": "", "models/box/meshes/box.stl": "", "models/box/model.config": "<model/>"}


@pytest.mark.parametrize(
    ("name", "text", "expected"),
    [
        (
            "r.xacro",
            xacro(MESH.format("package://arm/meshes/elbow-link.stl")),
            "2 warning mesh 'arm/meshes/elbow-link.stl' does not exist; did you mean 'arm/meshes/elbow_link.stl'?",
        ),
        (
            "r.urdf",
            f'<robot name="r">{MESH.format("file://$(find arm)/meshes/hand.dae")}</robot>',
            "1 warning mesh 'arm/meshes/hand.dae' does not exist",
        ),
        (
            "r.xacro",
            xacro(MESH.format("package://arm/mesh/a.dae") + MESH.format("package://arm/mesh/b.dae")),
            "2 warning folder 'arm/mesh' of a mesh does not exist",
        ),
        (
            "models/box/model.sdf",
            MODEL.format("model://box_2/meshes/box.stl"),
            "1 warning model 'box_2' does not exist in the workspace; did you mean 'box', which has 'meshes/box.stl'?",
        ),
        (
            "models/box/model.sdf",
            MODEL.format("model://box/meshes/bx.stl"),
            "1 warning file of a model 'arm/models/box/meshes/bx.stl' does not exist; "
            "did you mean 'arm/models/box/meshes/box.stl'?",
        ),
    ],
)
def test_a_file_for_itself(name: str, text: str, expected: str) -> None:
    assert said({**FILES, name: text}, "URD006") == [f"{name}:{expected}"]


@pytest.mark.parametrize(
    "path",
    [
        "package://arm/meshes/elbow_link.stl",
        "package://other/meshes/a.stl",
        "package://arm/meshes/${name}.stl",
        "file:///home/me/a.stl",
        "file://media/materials/scripts/gazebo.material",
        "model://box/meshes/box.stl",
        "model://sun/meshes/sun.dae",
        "model://arm/meshes/elbow_link.stl",
    ],
)
def test_what_is_there_or_elsewhere(path: str) -> None:
    assert said({**FILES, "r.xacro": xacro(MESH.format(path)), "m.sdf": MODEL.format(path)}, "URD006") == []
