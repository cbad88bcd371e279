"""The process that asks rclpy, started and ended from several threads."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.live.model import CannotObserveError
from preflight_analysis.live.observe_ros2 import Ros2Observer


def test_what_was_closed_starts_nothing_more(tmp_path: Path) -> None:
    """Who stops a watch that has hardly begun leaves no process behind."""
    started = tmp_path / "started"
    python = tmp_path / "python"
    python.write_text(f"#!/bin/sh\ntouch {started}\n")
    python.chmod(0o755)
    environment = dataclasses.replace(detect_environment(str(tmp_path), {}), ros2_python=str(python))
    observer = Ros2Observer(environment)
    observer.close()
    with pytest.raises(CannotObserveError) as refused:
        observer.observe()
    assert refused.value.final
    assert not started.exists()
