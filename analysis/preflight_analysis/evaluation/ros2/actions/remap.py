"""`<remap>`, and what Python files give as `remappings`."""

from __future__ import annotations

from preflight_analysis.evaluation.ros2.entity import Part, part_tag
from preflight_analysis.launch.schema import Attribute

ENTITIES = (
    Part(
        kind="remap",
        tag=part_tag(
            "Gives a topic, service or action another name, for this node.",
            Attribute("from", "The name that the node uses.", "remap-from", required=True),
            Attribute("to", "The name that it gets instead.", "remap-to", required=True),
            named_by=("from",),
            detail=("to",),
        ),
        of=("node", "lifecycle_node", "node_container", "composable_node"),
    ),
)
