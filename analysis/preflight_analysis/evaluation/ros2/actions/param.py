"""`<param>`, and what Python files give as `parameters`."""

from __future__ import annotations

from preflight_analysis.evaluation.ros2.entity import PARAM_TYPES, Part, flag, part_tag
from preflight_analysis.launch.schema import Attribute

NODES = ("node", "lifecycle_node", "node_container", "composable_node")

ENTITIES = (
    Part(
        kind="param",
        tag=part_tag(
            "A parameter of the node, or a file of them.",
            Attribute("name", "The name of the parameter.", "parameter"),
            Attribute("value", "The value."),
            Attribute(
                "type",
                "What to make of the value; YAML's rules where it is left out.",
                "choice",
                PARAM_TYPES,
                taken="verbatim",
            ),
            Attribute("from", "A YAML file with parameters.", "yaml-file"),
            flag("allow_substs", "Make the substitutions in that file."),
            children=("param",),
            named_by=("name", "from"),
            detail=("value",),
        ),
        of=(*NODES, "param", "set_parameter"),
    ),
    Part(kind="param_dict", tag=None, of=NODES),
    Part(kind="item", tag=None, of=("param",)),
)
