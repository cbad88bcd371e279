"""What a check runs, it runs side by side."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import pytest
from preflight_analysis.tracing.cache_folder import VARIABLE
from preflight_analysis.tracing.interface import NOT_RUN, Interface
from preflight_analysis.tracing.request import TraceRequest
from preflight_server.cli import project
from preflight_server.cli.main import main

MANIFEST = """<package format="2"><name>p</name><version>1.0.0</version><description/>
  <maintainer email="a@example.com">A</maintainer><license>BSD</license>
  <buildtool_depend>catkin</buildtool_depend></package>"""


@pytest.fixture
def workspace(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    package = tmp_path / "workspace/src/p"
    (package / "scripts").mkdir(parents=True)
    (package / "package.xml").write_text(MANIFEST)
    script = package / "scripts/talk"
    script.write_text("#!/usr/bin/env python3\nimport rospy\nrospy.init_node('talk')\n")
    script.chmod(0o755)
    for name in ("one", "two"):
        (package / f"{name}.launch").write_text(f'<launch><node pkg="p" type="talk" name="{name}"/></launch>')
    monkeypatch.setenv(VARIABLE, str(tmp_path / "cache"))
    return tmp_path / "workspace"


def test_the_nodes_of_several_launch_files_are_run_together(workspace: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    runs: list[list[str]] = []

    def trace_all(
        tracer: Any, requests: Sequence[TraceRequest], *, on_done: Callable[[int, Interface], None], **_: Any
    ) -> None:
        runs.append([request.node for request in requests])
        for index in range(len(requests)):
            on_done(index, NOT_RUN)

    monkeypatch.setattr(project, "trace_all", trace_all)
    monkeypatch.setattr(project, "_why_not", lambda no_run: None)
    assert main(["check", str(workspace), "--fail-on", "never"]) == 0
    assert runs == [["/one", "/two"]]
