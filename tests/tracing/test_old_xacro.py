"""`xacro.py` of ROS Melodic and before, in whose place our own xacro is run."""

from __future__ import annotations

import threading
from pathlib import Path

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.environment.own_programs import OLD_XACRO
from preflight_analysis.evaluation.commands import CommandResult
from preflight_analysis.robot.parse import parse_description
from preflight_analysis.tracing.commands import CommandRunner

pytestmark = pytest.mark.ros
_OLD = """<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <include filename="parts.xacro"/>
  <property name="side" value="left"/>
  <if value="1"><wheel name="${side}"><origin/></wheel></if>
  <unless value="1"><link name="nothing"/></unless>
  <xacro:wheel name="right"><origin/></xacro:wheel>
</robot>"""
_PARTS = """<robot>
  <macro name="wheel" params="name *at">
    <link name="${name}_wheel"/>
    <joint name="${name}" type="fixed"><insert_block name="at"/><parent link="a"/><child link="${name}_wheel"/></joint>
  </macro>
</robot>"""


def _run(folder: Path, program: str, text: str) -> CommandResult:
    (folder / "r.xacro").write_text(text)
    (folder / "parts.xacro").write_text(_PARTS)
    environment = detect_environment(str(folder), {"ROS_VERSION": "1"}, (str(folder),), root=str(folder))
    return CommandRunner(environment, str(folder), None).run(f"{program} {folder}/r.xacro", threading.Event())


def test_tags_and_macros_need_no_prefix(tmp_path: Path) -> None:
    found = _run(tmp_path, OLD_XACRO, _OLD)
    assert found.status == "done"
    assert parse_description(found.output).links == ("left_wheel", "right_wheel")


def test_to_the_xacro_of_today_they_are_urdf(tmp_path: Path) -> None:
    links = parse_description(_run(tmp_path, "xacro", _OLD.replace("xacro:wheel", "wheel")).output).links
    assert links == ()


@pytest.mark.parametrize(("program", "status"), [(OLD_XACRO, "not-run"), ("xacro", "failed")])
def test_what_only_the_old_one_may_read_is_not_known(tmp_path: Path, program: str, status: str) -> None:
    found = _run(tmp_path, program, '<robot xmlns:xacro="http://x"><xacro:later/><xacro:macro name="later"/></robot>')
    assert found.status == status
    assert status == "failed" or found.reason == "package 'xacro' is not installed here"
