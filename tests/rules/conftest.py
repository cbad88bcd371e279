"""What holds for the cases of all rules, and packages on the disk for the rules that look at them."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from preflight_analysis.findings.finding import Finding
from preflight_analysis.rules.registry import run_rules
from preflight_analysis.workspace import workspace as workspace_module
from support import check
from support.demo_package import create_demo_package
from support.unbuilt_packages import create_unbuilt_packages


@pytest.fixture(autouse=True)
def silent(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """In a test that is marked so the rules run, and that of the file finds nothing."""
    if request.node.get_closest_marker("silent") is None:
        yield
        return
    found: list[set[str]] = []

    def recorded(*args: Any, **options: Any) -> list[Finding]:
        findings = run_rules(*args, **options)
        found.append({finding.rule for finding in findings})
        return findings

    for module in (check, workspace_module, request.module):
        if hasattr(module, "run_rules"):
            monkeypatch.setattr(module, "run_rules", recorded)
    yield
    rule = request.path.name.removeprefix("test_")[:6].upper()
    assert found, "the rules were not run"
    assert rule not in set().union(*found)


@pytest.fixture
def launch(tmp_path: Path) -> Path:
    """A launch file to write, in a package with executables."""
    return create_demo_package(tmp_path)


@pytest.fixture
def workspace(tmp_path: Path) -> Path:
    """A workspace of ROS 2 whose packages are not built."""
    return create_unbuilt_packages(tmp_path)
