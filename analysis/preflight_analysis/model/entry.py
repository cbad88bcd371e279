"""What the index of names has of a file: see `name_index`."""

from __future__ import annotations

import re
from typing import Literal, NamedTuple

from preflight_analysis.documents.quoted import Quoted
from preflight_analysis.documents.span import Span

Kind = Literal[
    "argument",
    "bridged",
    "component",
    "container",
    "file",
    "flag",
    "frame",
    "given",
    "include",
    "joint",
    "library",
    "machine",
    "made",
    "name",
    "node",
    "package",
    "parameter",
    "passed",
    "program",
    "remap",
    "section",
    "simulated",
    "topic",
    "tree-class",
    "tree-node",
    "tree-port",
    "value",
    "variable",
    "yaml-file",
]
"""Of launch files: `argument` (`role`: declares, uses or passes), `passed` to the included file `of`, `given`: a path
below the package `type`, to the argument or parameter `of`, `include`: the text of `file=`, `node`, `machine`,
`variable` of the environment, `remap` (`role`: from or to), `value`: a full name that a parameter, argument or remap
has (in YAML a key about topics), `container` that nodes are loaded into, `flag` of a command line, `file` by its base
name.
Of launch files, and of what builds and describes packages: `package` (`role` in the latter: declares or uses), and of
package `of`, in the latter their own, a `program` and a `component` by its class (`role`: declares).
Of launch files and programs: `parameter` (`role`: set below the namespace `of`, or asked for below `of`).
Of programs: `topic` or service that they make (`role`: offer or use, with the last part of its `type`), `name`: any in
quotes, `made` at run time, with `*` for what is computed, `library` that they speak of; of behaviour trees the nodes
that they register, of class `of`, and the ports of a class; `yaml-file`: one that they name, and load by themselves.
Of robots and worlds: topics that are `simulated`, of RViz a `topic` that it uses and a `frame`, and of all files what
is called like a `joint`."""
REFERRED: frozenset[Kind] = frozenset(
    ["argument", "component", "include", "machine", "node", "package", "parameter", "program", "remap", "variable"]
)
"""Of launch files, what an editor is asked for by a place: kept for all files of a workspace."""


class Entry(NamedTuple):
    """A name that a file has. Where in it is no part of that: files are edited, and most of their names stay."""

    kind: Kind
    text: str
    role: str = ""
    of: str = ""
    type: str = ""


class Mention(NamedTuple):
    """An entry at a place. `action` is the start tag that it stands in, of an argument that is passed the include's;
    outside of tags it is the place itself."""

    entry: Entry
    span: Span
    action: Span


def mention(start: int, end: int, entry: Entry) -> Mention:
    """One outside of tags."""
    return Mention(entry, span := Span(start, end), span)


def in_quotes(quoted: Quoted, entry: Entry) -> Mention:
    """One of a text in quotes."""
    return mention(*quoted.place, entry)


JOINT = re.compile(r"(?<!\w)([A-Za-z]\w*_(?:joint|wheel|caster)\w*|(?:joint|wheel|caster)_\w+)(?!\w)")
"""What joints are called, in whatever text."""
BRIDGED = re.compile(r"(?<!\S)(/?\w[\w/]*)@\w+/[\w/]+[@\[\]]")
"""A topic in an argument of a bridge to a simulator."""
GRAPH_NAME = re.compile(r"[\w/~]+")
FILE = re.compile(r"""([^\s/"'$(),]+\.[A-Za-z]\w*)(?=["')\s,]|\Z)""")
