"""What the parameters of the nodes of a launch stand for, by what is known of packages."""

from __future__ import annotations

import os
import re
from bisect import bisect_left
from collections.abc import Collection, Iterator, Mapping, Sequence
from functools import lru_cache
from itertools import compress
from operator import attrgetter
from types import MappingProxyType
from typing import Any, NamedTuple

from preflight_analysis.catalogue.packages import distribution_of
from preflight_analysis.catalogue.released import DISTRIBUTIONS
from preflight_analysis.catalogue.renamed import other_names
from preflight_analysis.dataclass import dataclass
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.known_arguments import arguments_of
from preflight_analysis.evaluation.tree import LaunchNode, LaunchTree, Param
from preflight_analysis.incremental.kept import Kept
from preflight_analysis.knowledge.load import knowledge_of
from preflight_analysis.knowledge.model import Entry, EntryKind, Knowledge, Meaning

_NUMBER = "{N}"
_LISTED = re.compile(r"\{(\w[\w.]*)\}")
_PACKAGE = re.compile(r"(\w+)(?:::|/)")
_OTHER = "$"
"""Before the name of a parameter whose value is meant."""
_WITHIN = re.compile(r"\$\{([\w.]+)\}")
"""The same within a text."""
_ANY = "*"
_TYPE = re.compile(r"\w+/(?:\w+/)?\w+")
_TYPED = ("topic", "service", "action")
_FIXED = "="
"""Before a name that no parameter gives."""
_KEPT = 4096
_MOST = 256
"""Items of a list."""
_MAX_DEPTH = 3
"""Plugins that load plugins."""


class Known(NamedTuple):
    """What is known of a node, a plugin or a controller, and where that is from, in words. `is_used`: whether that was
    read of the version that is used, as far as that is known."""

    entry: Entry
    package: str
    evidence: str
    is_used: bool


@dataclass(frozen=True, slots=True)
class KnownMeanings:
    """All that is known, the user's own files first. `distro` is None where it is not known which one is used."""

    own: tuple[Knowledge, ...]
    distro: str | None
    generation: int

    def of_node(self, node: LaunchNode) -> Known | None:
        """What is known of a node; None where nothing is. What had another name then is not sure to be the same."""
        package, kind, name = place_of(node)
        found = self.of(package, kind, name, _names_of(node.params))
        if found is not None:
            return found
        others = other_names(package, kind, name, distribution_of(self.generation, self.distro))
        known = next(filter(None, (self.of(other, kind, named) for other, named in others)), None)
        return known._replace(is_used=False) if known is not None else None

    def within(self, node: LaunchNode, process: LaunchNode) -> Known | None:
        """What is known of a node that the process of another one makes beside it: a costmap, or a controller, whose
        type the other one has as a parameter."""
        type_ = next((p.value for p in process.params if p.name == f"{names.leaf(node.name)}.type"), None)
        found = self.plugin(type_, "controllers", _names_of(node.params)) if isinstance(type_, str) else None
        if found is not None:
            return found
        outer = self.of_node(process)
        below = node.name.removeprefix(names.parent(process.name))
        class_ = outer.entry.within.get(below) if outer is not None else None
        return self.plugin(class_, "components") if class_ is not None else None

    def plugin(self, type_: str, kind: EntryKind = "plugins", given: Collection[str] = ()) -> Known | None:
        """What is known of a plugin, a controller or a component, by its type: `package::Name` or `package/Name`."""
        package = _PACKAGE.match(type_)
        if package is None:
            return None
        other_spelling = type_.replace("/", "::") if "/" in type_ else type_.replace("::", "/")
        return self.of(package[1], kind, type_, given) or self.of(package[1], kind, other_spelling, given)

    def of(self, package: str, kind: EntryKind, name: str, given: Collection[str] = ()) -> Known | None:
        """What is known of an executable, a component, ... of a package. The `given` parameters tell which distribution
        it is of, where nothing else does."""
        distributions = DISTRIBUTIONS[self.generation]
        for said in self.own:
            entry = said.entry(kind, name, self.distro, distributions, given) if said.package == package else None
            if entry is not None:
                return Known(entry, package, said.evidence(self.distro), True)
        common = knowledge_of(package)
        entry = common.entry(kind, name, self.distro, distributions, given) if common is not None else None
        if common is None or entry is None or distributions.keys().isdisjoint(entry.distributions):
            return None
        return Known(entry, package, common.evidence(self.distro), self._is_used(entry))

    def _is_used(self, entry: Entry) -> bool:
        if self.distro in entry.distributions or self.distro in DISTRIBUTIONS[self.generation]:
            return self.distro in entry.distributions
        # What several distributions have alike is likely so in the one that is not known; of ROS 1 that is the last.
        known = DISTRIBUTIONS[self.generation].keys() & set(entry.distributions)
        return len(known) > 1 or "noetic" in known


def _names_of(params: Sequence[Param]) -> frozenset[str]:
    return frozenset(param.name for param in params)


def place_of(node: LaunchNode) -> tuple[str, EntryKind, str]:
    """Package, kind and name under which the data about packages has a node."""
    if node.plugin is not None:
        return node.package, "components", node.plugin.removeprefix("::")
    if node.package == "nodelet" and node.executable == "nodelet":
        words = node.args.split()
        if len(words) > 1 and words[0] in ("load", "standalone"):
            # By convention the name begins with that of the package.
            return words[1].partition("/")[0], "nodelets", words[1]
    return node.package, "executables", node.executable


class Meant(NamedTuple):
    """A value and what it stands for. `parameter` is the name as the node asks for it (`odom0`, `scan.topic`); `param`
    is what sets it, None of a default, an argument or a name that is always the same. The items of a list come one by
    one. `type` is that of a topic, service or action, `package/Name`, None where it is not known. `append` is what
    makes the name behind the value."""

    meaning: Meaning
    known: Known
    parameter: str
    value: Any
    param: Param | None
    type: str | None = None
    append: str = ""

    def type_of(self, settings: Settings) -> str | None:
        """The type of a topic, service or action, `package/Name`; None where that is not known."""
        for parameter, types in self.meaning.type_by.items():
            value = str(settings.value(parameter, self.parameter)).lower()
            return types.get(value)
        type_ = self.meaning.type
        if type_ is None or not type_.startswith(_OTHER):
            return type_
        found = settings.value(type_.removeprefix(_OTHER), self.parameter)
        return found if isinstance(found, str) else None

    def has_broken_type(self) -> bool:
        """Whether its type is given and none."""
        return self.type not in (None, _ANY) and not _TYPE.fullmatch(self.type or "")


class Settings:
    """The parameters of a node below one name, with dots between the parts of theirs, the defaults of those that its
    knowledge has a meaning for, and its arguments, which count first."""

    def __init__(
        self, known: Known, params: Sequence[tuple[str, Param]], arguments: Mapping[str, Any] = MappingProxyType({})
    ) -> None:
        self.known = known
        self.params = dict(params)
        self.arguments = arguments
        self.defaults = {each.pattern: each.default for each in known.entry.meanings if each.default is not None}

    def value(self, name: str, beside: str = "") -> Any:
        """The value of a parameter, its default where it is not set, None where there is none. `./x` is the one that
        stands beside another."""
        if name.startswith("./"):
            name = f"{beside.rpartition('.')[0]}.{name[2:]}".removeprefix(".")
        if name in self.arguments:
            return self.arguments[name]
        found = self.params.get(name)
        return found.value if found is not None else self.default(name)

    def default(self, name: str) -> Any:
        """The value that a parameter has where it is not set: `$x` is that of another one, `${x}` within a text."""
        found = self.defaults.get(name)
        if not isinstance(found, str) or f"{_OTHER}{name}" == found or f"{_OTHER}{{{name}}}" in found:
            return found
        if _WITHIN.search(found):
            return self.filled(found)
        return self.value(found.removeprefix(_OTHER)) if found.startswith(_OTHER) else found

    def filled(self, text: str) -> str | None:
        """A text with the values of `${x}`; None where one of them is not known."""
        values = {each[1]: self.value(each[1]) for each in _WITHIN.finditer(text)}
        if not all(isinstance(value, str) and value for value in values.values()):
            return None
        return _WITHIN.sub(lambda each: str(values[each[1]]), text)

    def path(self, meaning: Meaning, value: Any) -> Any:
        """What a file is named by, behind its folder where another parameter has that."""
        folder = self.value(meaning.folder) if meaning.folder else None
        return os.path.join(folder, value) if isinstance(folder, str) and isinstance(value, str) else value

    def holds(self, conditions: Mapping[str, Any], beside: str = "") -> bool:
        """Whether all parameters have the values that are asked of them: `$x` is that of another one, `!` any other."""
        return all(self._is(self.value(name, beside), wanted) for name, wanted in conditions.items())

    def lacks(self, meaning: Meaning) -> bool:
        """Whether a condition of it is known, and is not so."""
        for name, wanted in meaning.when.items():
            value = self.value(name)
            if value is not None and not self._is(value, wanted):
                return True
        return False

    def _is(self, value: Any, wanted: Any) -> bool:
        if isinstance(wanted, list):
            return any(self._is(value, each) for each in wanted)
        if isinstance(wanted, str) and wanted.startswith("!"):
            return not self._is(value, wanted[1:])
        if isinstance(wanted, str) and wanted.startswith(_OTHER):
            wanted = self.value(wanted.removeprefix(_OTHER))
        if isinstance(value, (int, float)) and isinstance(wanted, (int, float)):
            return value == wanted
        return str(value).lower() == str(wanted).lower()


def known_of_nodes(tree: LaunchTree, known: KnownMeanings, kept: Kept) -> Sequence[Known | None]:
    """What is known of each node of a launch or of a graph, those that a simulator makes last."""
    nodes = tree.nodes_and_simulated
    by_name = {node.name: node for node in nodes} if any(node.within for node in nodes) else {}
    return kept.each_row(_of_node, (nodes, [by_name.get(node.within or "") for node in nodes]), known)


def _of_node(node: LaunchNode, process: LaunchNode | None, known: KnownMeanings) -> Known | None:
    return known.within(node, process) if process is not None else known.of_node(node)


_BY_NAME = attrgetter("name")


def params_of_nodes(tree: LaunchTree, known: Sequence[Known | None], kept: Kept) -> Sequence[Sequence[Param]]:
    """The parameters of each node, and those of the files that it names. Those of ROS 1 stand right below its name, of
    one of which something is known at any depth."""
    files = tree.file_params
    if tree.ros.own_parameters:
        nodes = tree.nodes_and_simulated
        return [(*node.params, *files[node.name]) if node.name in files else node.params for node in nodes]
    direct = params_by_namespace(tree, kept)
    found: list[Sequence[Param]] = [direct.get(node.name, ()) for node in tree.nodes]
    params = sorted(tree.all_params, key=_BY_NAME) if any(known) else []
    for at in compress(range(len(found)), known):
        # The next sign behind a slash.
        name = tree.nodes[at].name
        start, end = (bisect_left(params, f"{name}{sign}", key=_BY_NAME) for sign in "/0")
        found[at] = kept.get(_all, (name, at), (*params[start:end], *files.get(name, ())))
    return found


def params_by_namespace(tree: LaunchTree, kept: Kept) -> Mapping[str, tuple[Param, ...]]:
    """The parameters of ROS 1 by the namespaces that they are in. A group that is as it was is the same object."""
    return kept.grouped(namespace_of, "", tree.all_params)


def namespace_of(param: Param) -> str:
    """`/a/b` of `/a/b/c`, the empty text of `/c`."""
    return param.name.rpartition("/")[0]


def _all(params: tuple[Param, ...]) -> tuple[Param, ...]:
    return params


def own_params(node: LaunchNode, given: Sequence[Param]) -> tuple[tuple[str, Param], ...]:
    """The parameters of a node by the names by which it asks for them, with dots between their parts. `given` are those
    of ROS 2 as the node has them, or those of ROS 1 below its name."""
    below = f"{node.name}/"
    return tuple((param.name.removeprefix(below).replace("/", "."), param) for param in given)


def meant_of_node(node: LaunchNode, known: Known, given: Sequence[Param], every: KnownMeanings) -> tuple[Meant, ...]:
    """All values that mean something of a node with its parameters, as `own_params` takes them, and its arguments."""
    return meant_by(known, own_params(node, given), every, arguments=arguments_of(node, known.entry))


def meant_by(
    known: Known,
    params: Sequence[tuple[str, Param]],
    every: KnownMeanings,
    prefix: str = "",
    arguments: Mapping[str, Any] = MappingProxyType({}),
) -> tuple[Meant, ...]:
    """All values that mean something, in the order of what is known, defaults among them; behind each plugin what its
    own parameters mean, which stand below its name. `prefix` is that name, with a dot."""
    settings = Settings(known, params, arguments)
    found: list[Meant] = []
    for meaning in known.entry.meanings:
        for each in _of_meaning(meaning, settings):
            if not settings.holds(meaning.when, each.parameter):
                continue
            type_ = each.type_of(settings) if meaning.type or meaning.type_by else None
            append = settings.filled(meaning.append) if meaning.append else ""
            if append is None:
                continue
            value = settings.path(meaning, each.value) if meaning.kind == "file" else each.value
            made = each._replace(parameter=f"{prefix}{each.parameter}", value=value, type=type_, append=append)
            if meaning.kind in _TYPED and made.has_broken_type():
                continue
            found.append(made)
            if meaning.kind == "plugin" and isinstance(each.value, str) and prefix.count(".") < _MAX_DEPTH:
                name, dot, _ = each.parameter.rpartition(".")
                plugin = every.plugin(each.value) if dot else None
                if plugin is not None:
                    below = [(key[len(name) + 1 :], p) for key, p in params if key.startswith(f"{name}.")]
                    found += meant_by(plugin, below, every, f"{prefix}{name}.")
    return tuple(found)


def names_not_made(node: LaunchNode, known: Known, given: Sequence[Param]) -> frozenset[tuple[str, str, str]]:
    """Kind, role and name of what a node would have under other conditions, all of which are known: `=odom` of
    cartographer with `use_odometry = false`."""
    settings = Settings(known, own_params(node, given), arguments_of(node, known.entry))
    by_name: dict[tuple[str, str, str], list[Meaning]] = {}
    for meaning in known.entry.meanings:
        if meaning.pattern.startswith(_FIXED) and meaning.when and not meaning.append:
            by_name.setdefault((meaning.kind, meaning.role, meaning.pattern[1:]), []).append(meaning)
    return frozenset(name for name, every in by_name.items() if all(map(settings.lacks, every)))


def _of_meaning(meaning: Meaning, settings: Settings) -> Iterator[Meant]:
    if meaning.pattern.startswith(_FIXED):
        yield Meant(meaning, settings.known, meaning.pattern, meaning.pattern.removeprefix(_FIXED), None)
        return
    for name in _expanded(meaning.pattern, settings):
        if name in settings.arguments:
            value = settings.arguments[name]
            for each in value if isinstance(value, list) else [value]:
                yield Meant(meaning, settings.known, name, each, None)
            continue
        for parameter, value, param in _values(name, settings):
            for each in value[:_MOST] if isinstance(value, (list, tuple)) else (value,):
                yield Meant(meaning, settings.known, parameter, each, param)
        if name not in settings.params and meaning.default is not None and "*" not in name and _NUMBER not in name:
            default = settings.default(meaning.pattern)
            for each in default if isinstance(default, list) else [] if default is None else [default]:
                yield Meant(meaning, settings.known, name, each, None)


def _expanded(pattern: str, settings: Settings) -> tuple[str, ...]:
    """The pattern for each item of the lists that it names."""
    listed = next((each for each in _LISTED.finditer(pattern) if each[0] != _NUMBER), None)
    if listed is None:
        return (pattern,)
    before, _, _ = pattern[: listed.start()].rpartition(".")
    if "*" in before:
        fits, rest = _compiled(f"{before}.{listed[1]}"), pattern[len(before) :]
        found = [name.removesuffix(f".{listed[1]}") for name in settings.params if fits.fullmatch(name)]
        return tuple(name for each in found for name in _expanded(f"{each}{rest}", settings))
    names = (f"{before}.{listed[1]}", listed[1]) if before else (listed[1],)
    value = next((found for name in names if (found := settings.value(name)) is not None), None)
    items = dict.fromkeys(items_of(value))
    return tuple(
        name
        for item in items
        for name in _expanded(f"{pattern[: listed.start()]}{item}{pattern[listed.end() :]}", settings)
    )


def items_of(value: Any) -> list[str]:
    """What a list of texts has, or a text with blanks in between."""
    items = value.split() if isinstance(value, str) else value if isinstance(value, (list, tuple)) else ()
    return [each for each in items if isinstance(each, str)][:_MOST]


def _values(name: str, settings: Settings) -> Iterator[tuple[str, Any, Param | None]]:
    exact = settings.params.get(name)
    if exact is not None:
        yield name, exact.value, exact
        return
    if "*" not in name and _NUMBER not in name:
        return
    fits = _compiled(name)
    wanted = name.split(".")
    for parameter, param in settings.params.items():
        if fits.fullmatch(parameter):
            yield parameter, param.value, param
        elif isinstance(param.value, (list, dict)):
            words = parameter.split(".")
            if len(words) < len(wanted) and _compiled(".".join(wanted[: len(words)])).fullmatch(parameter):
                for value in within(param.value, wanted[len(words) :]):
                    yield parameter, value, param


@lru_cache(maxsize=_KEPT)
def _compiled(pattern: str) -> re.Pattern[str]:
    """What fits a pattern without lists."""
    parts = re.split(r"(\{N\}|\*)", pattern)
    return re.compile("".join({_NUMBER: r"\d+", "*": r"[^.]+"}.get(part, re.escape(part)) for part in parts))


def within(value: Any, wanted: Sequence[str]) -> Iterator[Any]:
    """What stands in a list or dictionary of ROS 1 where the rest of a pattern says."""
    if not wanted:
        yield value
        return
    first, *rest = wanted
    if isinstance(value, dict):
        values = value.values() if first == "*" else [value[first]] if first in value else []
    else:
        values = value if isinstance(value, list) and first == "*" else []
    for each in values:
        yield from within(each, rest)
