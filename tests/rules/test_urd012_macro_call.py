"""URD012: the call of a macro does not fit it."""

from __future__ import annotations

from pathlib import Path

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.rules.registry import found_in_description
from preflight_analysis.workspace.sources import Sources
from support.check import check
from support.descriptions import said, xacro
from support.packaging import lay_out
from support.unbuilt_packages import manifest

WHEEL = '<xacro:macro name="wheel" params="prefix radius:=1 *origin"/>'
LEG = '<xacro:macro name="leg" params="prefix"/>'


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        (
            f'{LEG}<xacro:leg prefx="l"/>',
            "warning macro 'leg' has no parameter 'prefx'; did you mean 'prefix'?",
        ),
        (f"{LEG}<xacro:leg/>", "warning call of macro 'leg' lacks parameter 'prefix', which has no default"),
        (
            f'{WHEEL}<xacro:wheel prefix="l"/>',
            "warning call of macro 'wheel' has 0 elements in it, and needs 1: 'origin' is missing",
        ),
        (f'{LEG}<leg prefix="l"/>', "warning <leg> does not call the macro 'leg': write <xacro:leg>"),
        (
            '<VLP-16 parent="base"><origin/></VLP-16>',
            "warning <VLP-16> is no element of a robot: to call a macro, write <xacro:VLP-16>",
        ),
    ],
)
def test_what_does_not_fit(text: str, expected: str) -> None:
    assert said({"r.xacro": xacro(text)}) == [f"r.xacro:2 {expected}"]


@pytest.mark.parametrize(
    "text",
    [
        f'{WHEEL}<xacro:wheel prefix="l"><origin/></xacro:wheel>',
        f'{WHEEL}<xacro:wheel prefix="l" radius="2"><xacro:if value="1"><origin/></xacro:if></xacro:wheel>',
        f'{LEG}<xacro:call macro="leg" prefix="l"/>',
        f'{LEG}<gazebo><plugin name="p" filename="f"><leg prefix="l"/></plugin></gazebo>',
        f'{LEG}<xacro:if value="1"><xacro:macro name="leg" params="side"/></xacro:if><xacro:leg side="l"/>',
        '<xacro:macro name="link" params="name"/><link name="a"/>',
        '<transmission name="t"><joint name="j"/></transmission><sensor name="s"><parent link="a"/></sensor>',
    ],
)
def test_what_fits_or_may(text: str) -> None:
    assert said({"r.xacro": xacro(text)}, "URD012") == []


@pytest.mark.parametrize(("meant", "severity"), [("indigo", "info"), ("noetic", "warning")])
def test_what_an_older_xacro_takes(tmp_path: Path, meant: str, severity: str) -> None:
    path = (
        lay_out(tmp_path, {"package.xml": manifest("arm", "catkin"), "r.xacro": xacro(f'{LEG}<leg prefix="l"/>')})
        / "r.xacro"
    )
    (tmp_path / "README.md").write_text(f"Install ros-{meant}-desktop.\n")
    environment = detect_environment(str(tmp_path), {"ROS_DISTRO": "noetic"}, root=str(tmp_path / "nothing"))
    (found,) = found_in_description(Sources(), environment, str(path))
    assert (found.rule, found.severity) == ("URD012", severity)


@pytest.mark.silent
def test_a_launch_for_itself() -> None:
    assert check("<launch/>") == []
