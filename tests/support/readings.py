"""Whether the reading of a Python launch file says what its run says."""

from __future__ import annotations

import json
from typing import Any

from preflight_analysis.documents.disk import Disk
from preflight_analysis.environment.model import Environment
from preflight_analysis.evaluation.ros2.python_agreement import differences
from preflight_analysis.evaluation.ros2.python_runs import parse_request
from preflight_analysis.evaluation.tree import LaunchTree
from preflight_analysis.tracing.reading.answers import answer


def assert_readings_agree(tree: LaunchTree, environment: Environment, disk: Disk) -> None:
    """Of all runs that a tree is made of: what is known of their readings is what the runs tell."""
    for command in tree.commands:
        request = parse_request(command.line) if command.launch_file else None
        if request is None or command.result is None or command.result.status != "done":
            continue
        read, run = answer(environment, disk, request), _answer(command.result.output)
        found = list(differences(read, run)) if read is not None and run is not None else []
        assert not found, (found, request["text"], request["calls"])


def _answer(output: str) -> dict[str, Any] | None:
    try:
        found = json.loads(output)
    except ValueError:
        return None  # of a hostile file
    return found if isinstance(found, dict) and ("actions" in found or "text" in found or "error" in found) else None
