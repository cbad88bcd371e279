"""The behaviour trees that the nodes of a launch load, as rules ask for them.

Which nodes they may have: the constructor of BehaviorTreeEngine loads the libraries of `plugin_lib_names`
(nav2_behavior_tree/src/behavior_tree_engine.cpp of ros-navigation/navigation2).
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.document import Document
from preflight_analysis.evaluation.ros2.unknown_text import is_unknown
from preflight_analysis.evaluation.tree import LaunchNode, Param
from preflight_analysis.findings.finding import Related
from preflight_analysis.rules.rule import Context
from preflight_analysis.trees.read import TreeFile, read_trees

_NAMES_TREE = re.compile(r"(?:\A|[._])bt_xml(?:_filename)?\Z")
_LIBRARIES = "plugin_lib_names"


@dataclass(frozen=True, slots=True)
class Loaded:
    """A tree file that a node loads. `libraries` are those that the node lists, None where it has no list or not all of
    it is known; `knows_all`: those that it loads are known, be it by default."""

    node: LaunchNode
    path: str
    param: Param
    file: TreeFile
    libraries: tuple[str, ...] | None
    knows_all: bool

    @property
    def related(self) -> tuple[Related, ...]:
        """Who loads the file, and what says so."""
        return (Related(f"{self.node.name} loads the file by '{self.param.name}'", self.param.place),)


def trees_of(context: Context) -> tuple[Loaded, ...]:
    """Those of bt_navigator, each file once for each node; ask through `context.once`. What other programs load is
    not Nav2's to say."""
    found: dict[tuple[str, str], Loaded] = {}
    for node in context.tree.nodes:
        if not _is_navigator(node):
            continue
        for param in _naming(node):
            path = str(param.value)
            document = context.disk.text(path)
            if (node.name, path) not in found and isinstance(document, Document):
                file = document.once(read_trees)
                found[node.name, path] = Loaded(node, path, param, file, *_libraries(node))
    return tuple(found.values())


def _is_navigator(node: LaunchNode) -> bool:
    return node.package == "nav2_bt_navigator"


def _naming(node: LaunchNode) -> Iterator[Param]:
    for param in node.params:
        value = param.value
        if (
            _NAMES_TREE.search(param.name)
            and isinstance(value, str)
            and value.startswith("/")
            and not is_unknown(value)
        ):
            yield param


def _libraries(node: LaunchNode) -> tuple[tuple[str, ...] | None, bool]:
    listed = next((param.value for param in node.params if param.name == _LIBRARIES), None)
    if listed is None:
        return None, not node.unknowns
    if not isinstance(listed, list) or not all(isinstance(each, str) and not is_unknown(each) for each in listed):
        return None, False
    return tuple(map(str, listed)), True
