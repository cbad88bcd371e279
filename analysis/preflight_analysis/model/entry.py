"""What the index of names has of a file: see `name_index`."""

from __future__ import annotations

import re
from typing import Literal, NamedTuple

Kind = Literal[
    "argument",
    "bridged",
    "container",
    "file",
    "flag",
    "given",
    "joint",
    "library",
    "made",
    "name",
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
    "yaml-file",
]
"""Of launch files: `argument` (declared, set or passed), `passed` to the included file `of`, `given`: a path below the
package `type`, to the argument or parameter `of`, `remap`: what one leads to, `value`: a full name that a parameter,
argument or remap has (in YAML a key about topics), `container` that nodes are loaded into, `flag` of a command line,
`file` by its base name.
Of programs: `topic` or service that they make (`role`: offer or use, with the last part of its `type`), `parameter`
that they ask for below `of`, `name`: any in quotes, `made` at run time, with `*` for what is computed, `library` that
they speak of; of behaviour trees the nodes that they register, of class `of`, and the ports of a class;
`yaml-file`: one that they name, and load by themselves.
Of robots and worlds: topics that are `simulated`, and of all files what is called like a `joint`."""


class Entry(NamedTuple):
    """A name that a file has. Where in it is no part of that: files are edited, and most of their names stay."""

    kind: Kind
    text: str
    role: str = ""
    of: str = ""
    type: str = ""


JOINT = re.compile(r"(?<!\w)([A-Za-z]\w*_(?:joint|wheel|caster)\w*|(?:joint|wheel|caster)_\w+)(?!\w)")
"""What joints are called, in whatever text."""
BRIDGED = re.compile(r"(?<!\S)(/?\w[\w/]*)@\w+/[\w/]+[@\[\]]")
"""A topic in an argument of a bridge to a simulator."""
GRAPH_NAME = re.compile(r"[\w/~]+")
FILE = re.compile(r"""([^\s/"'$(),]+\.[A-Za-z]\w*)(?=["')\s,]|\Z)""")
