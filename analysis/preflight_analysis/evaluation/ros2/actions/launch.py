"""`<launch>`, around everything else."""

from __future__ import annotations

from preflight_analysis.evaluation.ros2.entity import Part, part_tag
from preflight_analysis.launch.schema import Attribute

ENTITIES = (
    Part(
        kind="launch",
        tag=part_tag(
            "The root of every launch file.",
            Attribute(
                "deprecated",
                "Tell users that the file should no longer be used, with this message.",
                "prose",
                taken="verbatim",
            ),
        ),
        of=(),
        holds_actions=True,
    ),
)
