"""The behaviour tree nodes that the sources of a workspace register, whoever loads them.

https://www.behaviortree.dev/docs/tutorial-basics/tutorial_01_first_tree: `registerNodeType<Class>("Name")`,
`registerBuilder<Class>("Name", ...)`, `registerSimpleAction("Name", ...)`; of BehaviorTree.ROS2
`CreateRosNodePlugin(Class, "Name")`. Only texts are read: a name counts where a text in quotes has it.
"""

from __future__ import annotations

import os
import re
from collections import Counter
from collections.abc import Mapping
from typing import NamedTuple

from preflight_analysis.environment.model import Environment
from preflight_analysis.incremental.database import Database
from preflight_analysis.incremental.query import query
from preflight_analysis.model.entry import Entry
from preflight_analysis.model.name_index import entries_in, named_in, sources_in

_MOST_PACKAGES = 60
"""Of more packages only those are read that say so."""
_DEPENDENCY = re.compile(r"behavior_?tree|nav2_bt|nav2_behavior")


class OwnPort(NamedTuple):
    """A port that a source declares, with its C++ type, empty where it has none; `is_output`: it is only written."""

    type: str
    is_output: bool


class OwnNode(NamedTuple):
    """A node that a source registers. `ports` is None where they are not all written in one place."""

    name: str
    path: str
    ports: Mapping[str, OwnPort] | None


class OwnNodes(NamedTuple):
    """The nodes of a workspace, and all other texts in quotes in sources that are about behaviour trees."""

    nodes: Mapping[str, OwnNode]
    words: frozenset[str]

    def has(self, name: str) -> bool:
        """Whether a source may register a node of that name."""
        return name in self.nodes or name in self.words


@query
def own_nodes(db: Database, environment: Environment) -> OwnNodes:
    """Those of the sources of the workspace, in a large one of the packages that depend on behaviour trees."""
    packages = list(environment.own_packages)
    if len(packages) > _MOST_PACKAGES:
        packages = [each for each in packages if any(map(_DEPENDENCY.search, each.dependencies))]
    shares = {each.share for each in packages}
    entries = [
        entry for share in sorted(shares) if os.path.dirname(share) not in shares for entry in _about_trees(db, share)
    ]
    classes = Counter(entry.text for _, entry in entries if entry.kind == "tree-class")
    closed = {entry.text for _, entry in entries if entry.kind == "tree-class" and entry.role == "closed"}
    ports = dict[str, dict[str, OwnPort]]()
    for _, entry in entries:
        if entry.kind == "tree-port":
            is_output = entry.role == "OutputPort"
            ports.setdefault(entry.of, {})[entry.text] = OwnPort(entry.type, is_output)
    return OwnNodes(
        {
            # Two classes of one name have different ports.
            entry.text: OwnNode(
                entry.text,
                path,
                ports.get(entry.of, {}) if entry.of in closed and classes[entry.of] == 1 else None,
            )
            for path, entry in entries
            if entry.kind == "tree-node"
        },
        frozenset(entry.text for _, entry in entries if entry.kind == "name"),
    )


@query
def _about_trees(db: Database, share: str) -> tuple[tuple[str, Entry], ...]:
    """The names in sources of a package that are about behaviour trees, each with the file."""
    return tuple(
        (path, entry)
        for path in sources_in(db, share) or ()
        if named_in(db, path, "library")
        for entry in sorted(entries_in(db, path))
    )
