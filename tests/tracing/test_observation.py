"""What is believed of the records of a run; `test_hostile.py` and `test_break_outs.py` have nodes that write such."""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path
from typing import Any

import pytest
from preflight_analysis.tracing import node_recipe
from preflight_analysis.tracing.interface import Interface
from preflight_analysis.tracing.observation import observe
from preflight_analysis.tracing.run import RawRun
from support.tracing_harness import environment, request, write_node

SPINNING = {"own": {"ev": "end", "status": "spinning"}}


def seen(tmp_path: Path, told: dict[str, Any], end: dict[str, Any] = SPINNING) -> Interface:
    asked = request(write_node(tmp_path, ""))
    recipe = node_recipe.make(environment(tmp_path), asked, None)
    return observe(RawRun(records=[{"node": told}, end]), recipe, asked).interface


def test_names_of_files_that_drive_a_terminal_are_not_told(tmp_path: Path) -> None:
    assert len(seen(tmp_path, {"ev": "wrote", "path": "/etc/x"}).notes) == 1
    for name in ("/x\x1b]0;title\x07", "/x\x9b2J", "/x\ud800"):
        assert seen(tmp_path, {"ev": "wrote", "path": name}).notes == ()


def test_numbers_of_any_size_are_not_told(tmp_path: Path) -> None:
    record = {"ev": "endpoint", "role": "publisher", "name": "a", "type": "std_msgs/String", "file": "/x"}
    for number in (10**300, True, -(10**300)):
        found = seen(tmp_path, {**record, "line": number, "qos": {"queue_size": number}})
        (endpoint,) = (each for each in found.endpoints if each.name == "a")
        assert (endpoint.source_file, endpoint.source_line, dict(endpoint.qos)) == (None, None, {})
        end = {"own": {"ev": "end", "status": "ended", "code": number}}
        assert seen(tmp_path, record, end).outcome.exit_code is None


@pytest.mark.parametrize("depth", [100, 500, 900])
def test_deep_defaults_are_cut(tmp_path: Path, depth: int) -> None:
    value = json.loads("[" * depth + "]" * depth)
    found = seen(tmp_path, {"ev": "param", "access": "get", "name": "a", "has_default": True, "default": value})
    assert json.dumps(asdict(found)).count("[[") < 100


def test_defaults_are_bounded_and_printable(tmp_path: Path) -> None:
    value = {"a\x1b": ["b\x07\ud800\n", 10**4000]}
    found = seen(tmp_path, {"ev": "param", "access": "get", "name": "a", "has_default": True, "default": value})
    assert found.params[0].default == {"a": ["b\n", f"a number of {(10**4000).bit_length()} bits"]}
