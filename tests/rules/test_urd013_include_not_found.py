"""URD013: an included file is not there."""

from __future__ import annotations

import pytest
from support.check import check
from support.descriptions import said, xacro

FILES = {"urdf/gripper.xacro": xacro("", name="")}


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        (
            "$(find arm)/urdf/griper.xacro",
            "included file 'arm/urdf/griper.xacro' does not exist; did you mean 'arm/urdf/gripper.xacro'?",
        ),
        ("hand.xacro", "included file 'arm/urdf/hand.xacro' does not exist"),
    ],
)
def test_a_file_that_is_not_there(name: str, expected: str) -> None:
    top = xacro(f'<xacro:include filename="{name}"/>')
    assert said({**FILES, "urdf/arm.xacro": top}) == [f"urdf/arm.xacro:2 warning {expected}"]


@pytest.mark.parametrize(
    "name",
    ["gripper.xacro", "$(find arm)/urdf/gripper.xacro", "$(find other)/a.xacro", "/opt/robots/a.xacro", "${a}.xacro"],
)
def test_a_file_that_is_there_or_elsewhere(name: str) -> None:
    top = xacro(f'<xacro:property name="a" value="gripper"/><xacro:include filename="{name}"/>')
    assert said({**FILES, "urdf/arm.xacro": top}) == []


def test_an_include_that_need_not_be_there() -> None:
    top = xacro('<xacro:include filename="hand.xacro" optional="true"/>')
    assert said({**FILES, "urdf/arm.xacro": top}) == []


@pytest.mark.parametrize("more", [{"urdf/hand.xacro.in": ""}, {".gitmodules": '[submodule "h"]\n\tpath = urdf/h\n'}])
def test_a_file_that_will_be_there(more: dict[str, str]) -> None:
    name = "h/hand.xacro" if ".gitmodules" in more else "hand.xacro"
    top = xacro(f'<xacro:include filename="{name}"/>')
    assert said({**FILES, **more, "urdf/arm.xacro": top}) == []


@pytest.mark.silent
def test_a_launch_for_itself() -> None:
    assert check("<launch/>") == []
