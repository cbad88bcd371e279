"""What a rule claims: of what, of which kind, what it does to the robot, and in which words. How severe that is says
`policy.py` alone."""

from __future__ import annotations

from typing import Literal, NamedTuple

from preflight_analysis.dataclass import dataclass

Effect = Literal["stops-launch", "stops-node", "breaks", "misbehaves", "no-effect", "note", "style"]
"""What the mistake does to the robot. `stops-launch`: the launcher stops, or does not load the file; `stops-node`: a
node does not start, or ends; `breaks`: a connection, controller, plugin or description never comes about; `misbehaves`:
something works otherwise than written, and nothing says so; `no-effect`: what is written is ignored; `note`: nothing is
wrong by it, but what follows is not known without it; `style`: it works."""

Kind = Literal["absent", "near", "conflict", "invalid", "unused", "duplicate", "unreachable"]
"""`absent`: what is referred to is not there; `near`: likewise, and something of a like name is; `conflict`: two things
do not fit each other; `invalid`: something cannot be what it says; `unused`: nobody asks for it; `duplicate`: it is
there more than once; `unreachable`: it is there, and nothing leads to it."""

SubjectKind = Literal[
    "action",
    "annotation",
    "argument",
    "attribute",
    "bridge",
    "command",
    "component",
    "condition",
    "container",
    "controller",
    "domain",
    "element",
    "executable",
    "expression",
    "file",
    "frame",
    "interface",
    "joint",
    "keyword",
    "link",
    "machine",
    "module",
    "name",
    "node",
    "package",
    "parameter",
    "plugin",
    "remap",
    "section",
    "service",
    "setting",
    "substitution",
    "suppression",
    "text",
    "topic",
    "tree",
    "tree-node",
    "type",
    "variable",
]


class Subject(NamedTuple):
    """What a claim is about. `name` is as ROS resolves it, "" of what has none: two claims of one rule with the same
    text and a named subject have one cause, wherever they are."""

    kind: SubjectKind
    name: str = ""


@dataclass(frozen=True, slots=True)
class Text:
    """A message: a template, and by name what stands in it. `node` is the full name of the node that the claim is
    about: there reports say how many others there are. `quoted` is what another program says. `aside` speaks of the
    launch and not of the cause."""

    template: str
    values: tuple[tuple[str, str], ...] = ()

    def __str__(self) -> str:
        return self.template.format_map(dict(self.values))

    @property
    def node(self) -> str:
        """The node that it is about; "" without one."""
        return dict(self.values).get("node", "")

    @property
    def cause(self) -> Text:
        """It without what speaks of the launch."""
        return self._without("aside")

    @property
    def own(self) -> Text:
        """It without what another program says."""
        return self._without("quoted")

    def _without(self, name: str) -> Text:
        return Text(self.template, tuple((key, "" if key == name else value) for key, value in self.values))

    def with_more(self, count: int) -> Text:
        """It of a node and so many others."""
        more = {"node": f"{self.node} and {count} more"}
        return Text(self.template, tuple((key, more.get(key, value)) for key, value in self.values))

    def followed_by(self, template: str, **values: object) -> Text:
        """It with more words behind, for which there are more values, of other names."""
        return Text(self.template + template, (*self.values, *((k, str(v)) for k, v in values.items())))

    def regardless_of_node(self) -> Text:
        """It without what differs from one instance of the node to another: its name and its namespace."""
        node = self.node
        if not node:
            return self
        space = node[: node.rfind("/") + 1]

        def plain(value: str) -> str:
            value = value.replace(node, "\0")
            return value.replace(space, "\1") if len(space) > 1 else value

        values = ((key, value if key == "quoted" else plain(value)) for key, value in self.values)
        return Text(self.template, tuple(values))


def say(template: str, **values: object) -> Text:
    """A text of a template as of `str.format`, `say("{node} reads '{name}'", node=node.name, name=name)`."""
    return Text(template, tuple((key, str(value)) for key, value in values.items()))


def as_text(said: str | Text) -> Text:
    """A text of plain words, which speak of no node."""
    return said if isinstance(said, Text) else Text("{said}", (("said", said),))
