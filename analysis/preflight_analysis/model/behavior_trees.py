"""The behaviour trees that the nodes of a launch load, as rules ask for them.

Which nodes they may have: the constructor of BehaviorTreeEngine loads the libraries of `plugin_lib_names`
(nav2_behavior_tree/src/behavior_tree_engine.cpp of ros-navigation/navigation2). Which files they include:
`loadDocImpl` in src/xml_parsing.cpp of BehaviorTree/BehaviorTree.CPP.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.document import Document
from preflight_analysis.documents.reading import Unreadable
from preflight_analysis.environment.installed_paths import located
from preflight_analysis.evaluation.ros2.unknown_text import is_unknown
from preflight_analysis.evaluation.tree import LaunchNode, Param
from preflight_analysis.findings.finding import Related
from preflight_analysis.incremental.derived import derived
from preflight_analysis.model.context import Context
from preflight_analysis.trees.known_nodes import NAV_DISTRIBUTIONS, NAV_LIBRARIES, is_version_3
from preflight_analysis.trees.read import Included, TreeFile, Used, read_trees

_NAMES_TREE = re.compile(r"(?:\A|[._])bt_xml(?:_filename)?\Z")
LIBRARIES = "plugin_lib_names"
"""The parameter of bt_navigator that lists libraries of nodes."""
FOLDERS = "behavior_trees"
"""The parameter of BehaviorTree.ROS2's TreeExecutionServer that lists folders of trees: `GetDirectoryPath` and
`LoadBehaviorTrees` in behaviortree_ros2/src/bt_utils.cpp of BehaviorTree/BehaviorTree.ROS2."""
_SUFFIX = ".xml"
_MOST = 50
"""Files of one tree, each counted as often as it is included."""


@dataclass(frozen=True, slots=True)
class Part:
    """A file of a tree: the one that a node loads, or one that it includes."""

    path: str
    document: Document
    file: TreeFile


@dataclass(frozen=True, slots=True)
class Loaded:
    """A tree that a node loads: its file is the first of `parts`. `is_navigator`: the node is Nav2's, of which it is
    known how it does that; of others only what is wrong in any case is wrong. `missing` are the included files that are
    not there, with the path of the file that includes each and its own; `whole`: all others were read. `libraries` are
    those that the node lists, None where it has no list or not all of it is known; `knows_all`: those that it loads are
    known, be it by default."""

    node: LaunchNode
    is_navigator: bool
    param: Param
    parts: tuple[Part, ...]
    missing: tuple[tuple[str, Included, str], ...]
    whole: bool
    libraries: tuple[str, ...] | None
    knows_all: bool

    @property
    def path(self) -> str:
        """The path of the file that the node loads."""
        return self.parts[0].path

    @property
    def file(self) -> TreeFile:
        """What the file has that the node loads."""
        return self.parts[0].file

    @property
    def trees(self) -> frozenset[str]:
        """The names of the trees of all files."""
        return frozenset(tree for part in self.parts for tree in part.file.trees)

    @property
    def models(self) -> frozenset[str]:
        """The nodes that the files describe as their author's."""
        return frozenset(model for part in self.parts for model in part.file.models)

    @property
    def nodes(self) -> Iterator[tuple[Part, Used]]:
        """The nodes of all files that the library takes, each with its file."""
        return ((part, used) for part in self.parts if not part.file.problems for used in part.file.nodes)

    @property
    def subtrees(self) -> Iterator[tuple[Part, Used]]:
        """The trees that those of the same files name, each with the file that does."""
        return ((part, used) for part in self.parts if not part.file.problems for used in part.file.subtrees)

    @property
    def related(self) -> tuple[Related, ...]:
        """Who loads the file, and what says so."""
        return (Related(f"{self.node.name} loads the file by '{self.param.name}'", self.param.place),)


@derived
def trees_of(context: Context) -> tuple[Loaded, ...]:
    """Those of bt_navigator, and of nodes of the workspace that a parameter gives a tree; each file once for each
    node."""
    found: dict[tuple[str, str], Loaded] = {}
    workspace = context.environment.workspace
    for node in context.tree.nodes:
        package = context.environment.packages.get(node.package)
        navigates = is_navigator(node)
        if not navigates and (package is None or not package.is_within(workspace)):
            continue
        named = [(param, here(context, str(param.value))) for param in _naming(node, any_name=not navigates)]
        for param, path in (*named, *_in_folders(context, node)):
            document = context.disk.text(path)
            if (node.name, path) in found or not isinstance(document, Document):
                continue
            files = _Files(context)
            files.read(path, document)
            if navigates or files.parts[0].file.trees:
                whole = files.whole and len(files.parts) < _MOST
                parts, missing = tuple(files.parts), tuple(files.missing)
                libraries, knows_all = libraries_of(node), _knows_libraries(node)
                found[node.name, path] = Loaded(node, navigates, param, parts, missing, whole, libraries, knows_all)
    return tuple(found.values())


def _in_folders(context: Context, node: LaunchNode) -> Iterator[tuple[Param, str]]:
    """The files of the folders `package/folder` that `behavior_trees` lists: what TreeExecutionServer registers."""
    for param in node.params if not is_navigator(node) else ():
        for listed in param.value if param.name == FOLDERS and isinstance(param.value, list) else ():
            folder = folder_of(context, listed)
            for name in sorted(context.disk.names(folder)) if folder is not None else ():
                if name.endswith(_SUFFIX):
                    yield param, f"{folder}/{name}"


def folder_of(context: Context, listed: object) -> str | None:
    """The folder that an item of `behavior_trees` names; None where it names no package of the workspace."""
    name, _, below = listed.partition("/") if isinstance(listed, str) else ("", "", "")
    package = context.environment.packages.get(name)
    if package is None or not below or not package.is_within(context.environment.workspace):
        return None
    return located(context.disk, context.environment, os.path.normpath(os.path.join(package.share, below)))


def has_only_nodes_of_nav(context: Context, loaded: Loaded) -> bool:
    """Whether the node loads no other libraries: its list is known, and Nav2 is not changed in the workspace."""
    if has_own_nav(context):
        return False
    return loaded.knows_all and NAV_LIBRARIES.issuperset(loaded.libraries or ())


def has_own_nav(context: Context) -> bool:
    """Whether the workspace has a Nav2 of its own, which may have any nodes."""
    own = context.environment.packages.get("nav2_behavior_tree")
    return own is not None and own.is_within(context.environment.workspace)


def is_version_4(context: Context, loaded: Loaded) -> bool:
    """Whether the tree is surely for version 4 of BehaviorTree.CPP: Nav2's of a known distribution, else as it says."""
    distro = context.environment.distro
    if loaded.is_navigator and distro in NAV_DISTRIBUTIONS:
        return not is_version_3(distro)
    return loaded.file.format == "4"


def here(context: Context, path: str) -> str:
    """The file on this machine that a path leads to: of one that another machine has, that of the package which it
    names. Itself where there is none."""
    path = located(context.disk, context.environment, os.path.normpath(path))
    if context.disk.exists(path):
        return path
    parts = path.split("/")
    for at in range(len(parts) - 2, 0, -1):
        package = context.environment.packages.get(parts[at])
        if package is not None and package.is_within(context.environment.workspace):
            candidate = os.path.join(package.share, *parts[at + 1 :])
            if context.disk.exists(candidate):
                return candidate
    return path


def path_of(context: Context, included: Included, file: str) -> str | None:
    """The path of an included file; None where its package is not known."""
    if included.path.startswith("/"):
        return here(context, included.path)
    if included.package is None:
        return os.path.normpath(os.path.join(os.path.dirname(file), included.path))
    package = context.environment.packages.get(included.package)
    if package is None:
        return None
    return located(context.disk, context.environment, os.path.normpath(os.path.join(package.share, included.path)))


class _Files:
    """Reads a file with all that it includes."""

    def __init__(self, context: Context) -> None:
        self._context = context
        self._seen = set[str]()
        self.parts: list[Part] = []
        self.missing: list[tuple[str, Included, str]] = []
        self.whole = True

    def read(self, path: str, document: Document) -> None:
        pending = [(path, document)]
        while pending and len(self.parts) < _MOST:
            path, document = pending.pop()
            if path in self._seen:
                continue
            self._seen.add(path)
            file = read_trees(document)
            self.parts.append(Part(path, document, file))
            for included in file.includes:
                target = path_of(self._context, included, path)
                text = self._context.disk.text(target) if target is not None else None
                if isinstance(text, Document) and target is not None:
                    pending.append((target, text))
                elif (
                    isinstance(text, Unreadable)
                    and text.kind == "missing"
                    and target is not None
                    and not included.path.startswith("/")  # which the robot may have
                ):
                    self.missing.append((path, included, target))
                else:
                    self.whole = False
        self.whole = self.whole and not pending


def is_navigator(node: LaunchNode) -> bool:
    """Whether it is the one of Nav2, of which it is known how it loads trees."""
    return node.package == "nav2_bt_navigator"


def _naming(node: LaunchNode, *, any_name: bool) -> Iterator[Param]:
    """The parameters that name trees; with `any_name` all that name files which may be some."""
    for param in node.params:
        value = param.value
        if (
            (_NAMES_TREE.search(param.name) or (any_name and str(value).endswith(_SUFFIX)))
            and isinstance(value, str)
            and value.startswith("/")
            and not is_unknown(value)
        ):
            yield param


def libraries_of(node: LaunchNode) -> tuple[str, ...] | None:
    """Those that the node lists; None where it has no list or not all of it is known."""
    listed = next((param.value for param in node.params if param.name == LIBRARIES), None)
    if not isinstance(listed, list) or not all(isinstance(each, str) and not is_unknown(each) for each in listed):
        return None
    return tuple(map(str, listed))


def _knows_libraries(node: LaunchNode) -> bool:
    if any(param.name == LIBRARIES for param in node.params):
        return libraries_of(node) is not None
    return not node.unknowns
