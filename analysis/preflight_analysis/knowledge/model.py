"""What is known of a package's nodes and plugins beyond names and types: what the values of their parameters stand for.

docs/knowledge.md describes the files that this is read from.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import field
from typing import Any, Literal

from preflight_analysis.dataclass import dataclass

Kind = Literal["topic", "service", "action", "frame", "joint", "plugin", "file", "node", "value"]
ROLES: Mapping[Kind, tuple[str, ...]] = {
    "topic": ("publisher", "subscriber"),
    "service": ("server", "client"),
    "action": ("server", "client"),
    "frame": ("used", "named"),
    "joint": ("commanded", "read"),
    "plugin": ("type", "name"),
    "file": ("yaml", "lua"),
    "node": ("managed", "asked"),
}
"""What each kind of value is for. A frame that is `used` has to be there, one that is `named` is only written into
messages. A plugin is loaded by its `type`, or chosen by its `name`, which may have wildcards. A joint is `commanded`
or `read` by a controller. What a file has is parameters below its name. A node is `managed`
where another one changes the states of its lifecycle, `asked` where it is asked for something. A `value`
is for nothing by itself; its default counts."""
EntryKind = Literal["executables", "components", "nodelets", "controllers", "plugins", "simulator_plugins"]
ENTRY_KINDS: tuple[EntryKind, ...] = (
    "executables", "components", "nodelets", "controllers", "plugins", "simulator_plugins",
)  # fmt: skip


@dataclass(frozen=True, slots=True)
class Meaning:
    """What the values of the parameters of a pattern stand for, or a name that is always the same, after `=`.

    `pattern` has the names of parameters with dots between: `odom{N}` stands for `odom0`, `odom1`, ...;
    `{topics}.type` for `front.type` where the parameter `topics` lists `front`; `*` for one name or for each item of
    a list. `role` is one of `ROLES`. `type` is that of a topic, service or action as `package/Name`, of a joint its
    interfaces; `type_by` has it by the value of another parameter. `default` is the value where the parameter is not
    set, `$x` that of the parameter `x`, which `${x}` is within a text. `when` are values that other parameters must
    have, one of several where it is a list; `!x` is any value but `x`.
    """

    pattern: str
    kind: Kind
    role: str = ""
    type: str | None = None
    type_by: Mapping[str, Mapping[str, str]] = field(default_factory=dict)
    default: Any = None
    when: Mapping[str, Any] = field(default_factory=dict)
    qos: Mapping[str, Any] = field(default_factory=dict)
    append: str = ""
    """What is put behind the value to make the name: `/compressed`, `/${transport}` for that of a parameter."""
    remapped: bool = False
    """Whether a remap of the value changes the beginning of that name."""
    private: bool = False
    """Whether a relative name is below that of the node."""
    folder: str = ""
    """Of a file: the parameter or argument that has its folder."""
    names: tuple[str, ...] = ()
    """Of a plugin: those of the package and of what is released with it."""
    formerly: Mapping[str, str] = field(default_factory=dict)
    """Of a plugin: values of distributions before these, which name nothing any more, with what they are now."""


@dataclass(frozen=True, slots=True)
class Frames:
    """A transform that is broadcast. `parent` and `child` name parameters, or are frames where they begin with `=`. A
    child `*` stands for frames that no parameter names."""

    parent: str
    child: str
    static: bool = False
    when: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Entry:
    """What is known of some executables, components, ... of a package: `names` has them by their kind.

    `arguments` are forms of its command line, of which the first that fits counts: `messages {topic} [{out}] {more}...`
    has words that stand as they are and names of others. `options` has the names of what stands behind options. What
    has a name is a parameter for `meanings`. `whole`: whether they have all endpoints of the node.

    `node` is the name that the code gives to the node, of a process with several (ROS 2). `within` has what other nodes
    there are in the process, by their full name below the namespace of the process, with the component or plugin that
    says what they are.
    """

    names: Mapping[EntryKind, tuple[str, ...]]
    meanings: tuple[Meaning, ...] = ()
    frames: tuple[Frames, ...] = ()
    distributions: tuple[str, ...] = ()
    node: str = ""
    within: Mapping[str, str] = field(default_factory=dict)
    arguments: tuple[str, ...] = ()
    options: Mapping[str, str] = field(default_factory=dict)
    whole: bool = False


@dataclass(frozen=True, slots=True)
class Problem:
    """What is wrong with a file, and its line, counted from 1."""

    message: str
    line: int


@dataclass(frozen=True, slots=True)
class Knowledge:
    """What a file says of a package. `source` is where that was read: repository, branch, commit, files, and `also` the
    commits of other distributions, `owner/name@commit` in another repository; empty for a user's own. What is wrong in
    it is left out and stands in `problems`."""

    package: str = ""
    entries: tuple[Entry, ...] = ()
    distributions: tuple[str, ...] = ()
    source: Mapping[str, Any] = field(default_factory=dict)
    problems: tuple[Problem, ...] = ()
    path: str = ""
    """The path of a user's own file."""

    def evidence(self, distro: str | None) -> str:
        """Where that is from, in words: for a distribution that was read by itself, its commit."""
        repository, also = self.source.get("repository"), self.source.get("also")
        of_distro = also.get(distro) if isinstance(also, dict) else None
        commit = str(of_distro or self.source.get("commit", ""))
        if not repository:
            return f"the knowledge file of {self.package}"
        other, at, of_other = commit.rpartition("@")
        if at:
            repository, commit = other, of_other
        return f"what is known of {self.package} ({repository} at {commit[:7]})"

    def entry(
        self,
        kind: EntryKind,
        name: str,
        distro: str | None,
        others: Collection[str] = (),
        given: Collection[str] = (),
    ) -> Entry | None:
        """What is known of an executable, component, ... as that distribution has it, else as one of `others` has it;
        of what names no distribution in any case. Of several others the one that knows most of the `given`
        parameters."""
        found = [each for each in self.entries if name in each.names.get(kind, ())]
        of_distro = next((each for each in found if distro in each.distributions), None)
        if of_distro is not None:
            return of_distro
        found = [each for each in found if not each.distributions or not set(others).isdisjoint(each.distributions)]
        return max(found, key=lambda each: sum(of.pattern in given for of in each.meanings), default=None)
