"""Remaps of ROS 2 as rcl reads them: which of a process's nodes they are for, and whether they are for names of nodes.

https://design.ros2.org/articles/static_remapping.html: `node:from` is for the nodes of that name alone.
"""

from __future__ import annotations

import re

from preflight_analysis.evaluation.tree import Remap

_FOR_ONE = re.compile(r"([A-Za-z_]\w*):(?!//)(.+)\Z")
_OF_NODES = ("__node", "__name", "__ns")


def renames_nodes(remap: Remap) -> bool:
    """Whether it is for the name or the namespace of a node."""
    return _split(remap)[1] in _OF_NODES


def source_for(remap: Remap, node: str) -> str | None:
    """The name that it moves of the node of this full name; None where it is for others."""
    only, source = _split(remap)
    return source if only in (None, node.rpartition("/")[2]) else None


def _split(remap: Remap) -> tuple[str | None, str]:
    found = _FOR_ONE.match(remap.source)
    return (found[1], found[2]) if found is not None else (None, remap.source)
