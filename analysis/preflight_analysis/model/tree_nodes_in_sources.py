"""The behaviour tree nodes that the sources of a workspace register, whoever loads them.

https://www.behaviortree.dev/docs/tutorial-basics/tutorial_01_first_tree: `registerNodeType<Class>("Name")`,
`registerBuilder<Class>("Name", ...)`, `registerSimpleAction("Name", ...)`; of BehaviorTree.ROS2
`CreateRosNodePlugin(Class, "Name")`. Only texts are read: a name counts where a text in quotes has it.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Mapping
from typing import NamedTuple

from preflight_analysis.documents.disk import Disk
from preflight_analysis.documents.document import Document
from preflight_analysis.environment.model import Environment
from preflight_analysis.environment.package_files import files_in
from preflight_analysis.incremental.database import Database
from preflight_analysis.incremental.query import query

_SUFFIXES = (".cpp", ".cc", ".cxx", ".hpp", ".h")
_MOST = 600
_MOST_PACKAGES = 60
"""Of more packages only those are read that say so."""
_DEPENDENCY = re.compile(r"behavior_?tree|nav2_bt|nav2_behavior")
_ABOUT = ("behaviortree", "BT::")
_COMMENT = re.compile(r"^[ \t]*//[^\n]*|/\*.*?\*/", re.MULTILINE | re.DOTALL)
_REGISTERED = re.compile(
    r"\bregister(?:NodeType|Builder)\s*<\s*(?P<cls>[\w:]+)[^(;]{0,80}\(\s*\"(?P<name>\w+)\""
    r"|\bCreateRosNodePlugin\(\s*(?P<ros>[\w:]+)\s*,\s*\"(?P<plugin>\w+)\""
)
_QUOTED = re.compile(r"\"([A-Za-z]\w*)\"")
_CLASS = re.compile(r"\b(?:class|struct)\s+(\w+)\b[^;{}()]{0,200}\{")
_PORTS = re.compile(r"\b(?:(?P<cls>\w+)::)?providedPorts\s*\(\s*\)\s*\{")
_PORT = re.compile(r"\b(?:In|Out|Bidirectional)(?:put)?Port\b")
_NAMED_PORT = re.compile(
    r"\b(?P<kind>Input|Output|Bidirectional)Port\s*(?:<(?P<type>[^()\";]{0,200})>)?\s*\(\s*\"(?P<name>\w+)\""
)
_BRACE = re.compile(r"[{}]")
_LONGEST = 20_000
"""Of a function."""
_MORE = re.compile(r"\bprovided\w*Ports\s*\(|\binsert\b|\bmerge\b")


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


class _Read(NamedTuple):
    registered: tuple[tuple[str, str], ...] = ()
    ports: tuple[tuple[str, Mapping[str, OwnPort] | None], ...] = ()
    words: frozenset[str] = frozenset()


@query
def own_nodes(db: Database, environment: Environment) -> OwnNodes:
    """Those of the sources of the workspace, in a large one of the packages that depend on behaviour trees."""
    packages = list(environment.own_packages)
    if len(packages) > _MOST_PACKAGES:
        packages = [each for each in packages if any(map(_DEPENDENCY.search, each.dependencies))]
    shares = {each.share for each in packages}
    registered = dict[str, tuple[str, str]]()
    ports = dict[str, list[Mapping[str, OwnPort] | None]]()
    words = set[str]()
    for share in sorted(shares):
        if os.path.dirname(share) in shares:
            continue
        paths = [path for path in files_in(Disk(db), share, deep=True) if path.endswith(_SUFFIXES)]
        for path in paths if len(paths) <= _MOST else ():
            found = _in_file(db, path)
            words |= found.words
            registered |= {name: (cls, path) for name, cls in found.registered}
            for cls, of_class in found.ports:
                ports.setdefault(cls, []).append(of_class)
    nodes = {}
    for name, (cls, path) in registered.items():
        # Two classes of one name have different ports.
        known = ports.get(cls, [])
        nodes[name] = OwnNode(name, path, known[0] if len(known) == 1 else None)
    return OwnNodes(nodes, frozenset(words))


@query
def _in_file(db: Database, path: str) -> _Read:
    document = Disk(db).text(path)
    if not isinstance(document, Document) or not any(each in document.text for each in _ABOUT):
        return _Read()
    text = _COMMENT.sub("", document.text)
    registered = (
        (found["name"] or found["plugin"], (found["cls"] or found["ros"]).rpartition("::")[2])
        for found in _REGISTERED.finditer(text)
    )
    return _Read(tuple(registered), tuple(_ports(text)), frozenset(_QUOTED.findall(text)))


def _ports(text: str) -> Iterator[tuple[str, Mapping[str, OwnPort] | None]]:
    classes = [(found.start(), found[1]) for found in _CLASS.finditer(text)]
    for found in _PORTS.finditer(text):
        cls = found["cls"] or next((name for at, name in reversed(classes) if at < found.start()), None)
        if cls is None:
            continue
        body = text[found.end() : _end_of(text, found.end())]
        found_ports = [*_NAMED_PORT.finditer(body)]
        whole = len(found_ports) == len(_PORT.findall(body)) and _MORE.search(body) is None
        ports = {
            each["name"]: OwnPort(" ".join((each["type"] or "").split()), each["kind"] == "Output")
            for each in found_ports
        }
        yield cls, ports if whole else None


def _end_of(text: str, start: int) -> int:
    """Where the block ends that begins before `start`."""
    depth = 1
    for found in _BRACE.finditer(text, start, start + _LONGEST):
        depth += 1 if found[0] == "{" else -1
        if depth == 0:
            return found.start()
    return start
