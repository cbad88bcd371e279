"""PRM006: a parameter is set to one value and then to another."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import compress, takewhile

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.document import Document
from preflight_analysis.documents.span import Location
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.problems import YamlKeyTwice
from preflight_analysis.evaluation.ros2.param_files import read_param_file
from preflight_analysis.evaluation.tree import CommandValue, LaunchNode, Param, ParamSource
from preflight_analysis.findings.claim import Effect, Subject, say
from preflight_analysis.findings.doubt import Doubt, Reason, doubts
from preflight_analysis.findings.finding import Finding, Related
from preflight_analysis.model.arguments import gives
from preflight_analysis.model.context import Context
from preflight_analysis.model.problems import as_written, include_chain, problems_of, shortened
from preflight_analysis.model.syntax import Tag, Tags, has_condition
from preflight_analysis.rules.further_reading import NODE_ARGUMENTS, PARAMETERS, ROSLAUNCH_PARAM, ROSLAUNCH_ROSPARAM
from preflight_analysis.rules.problems import problem_claim
from preflight_analysis.rules.rule import Rule

_OVERRIDDEN = "overridden: parameter '{name}' of {node} {why} to {value}, not {old}"
_TWICE = "duplicate key '{name}' in this section: the later one overrides it with {value}"
KEY_TWICE = "duplicate key '{}' in this dictionary: the later one overrides this one"
_DEAD_ARGUMENT = (
    "overridden: parameter '{name}' of {node} is set again by a later parameter file; argument '{argument}' does not "
    "change it"
)


@dataclass(frozen=True, slots=True)
class _Setting:
    """One of the tags that set a parameter, and the includes that lead to it."""

    param: Param
    tag: Tag
    chain: tuple[Location, ...]

    @property
    def loads_file(self) -> bool:
        """Whether it is one of the many that a file holds, not written for its own sake."""
        return self.is_rosparam and self.tag.action.value("file") is not None

    @property
    def is_rosparam(self) -> bool:
        """Whether it stands in a `<rosparam>`."""
        return self.tag.action.kind.lower() == "rosparam"

    @property
    def in_node(self) -> bool:
        """Whether it stands in a node's tag."""
        return bool(self.tag.above) and self.tag.above[0].kind in ("node", "test")

    @property
    def is_private(self) -> bool:
        """Whether it is meant for the nodes around which it stands: a `<param>` of a `~name`."""
        name = self.tag.action.value("name")
        return not self.is_rosparam and name is not None and names.is_private(name.text.strip())

    @property
    def place(self) -> Location:
        """Where the name is written."""
        return self.param.place


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    yield from _keys_twice(rule, context)
    if context.tree.ros.own_parameters:
        yield from _of_ros2_nodes(rule, context)
        return
    tags = Tags(context.launch_files)
    for param, lost in filter(None, context.each(_with_lost, context.tree.all_params)):
        winner = _setting(tags, param)
        if winner is None:
            continue
        for old in lost:
            loser = _setting(tags, old)
            if loser is None:
                continue
            found = _surprise(tags, loser, winner)
            if found is not None:
                effect, why = found
                yield rule.claim(
                    f"overridden: parameter '{as_written(param.name)}' {why} to {_shown(param.value)}, not "
                    f"{_shown(old.value)}",
                    loser.place,
                    subject=Subject("parameter", as_written(param.name)),
                    effect=effect,
                    related=(Related("the value that applies", winner.place), *include_chain(old.origin)),
                )


def _with_lost(param: Param) -> tuple[Param, tuple[Param, ...]] | None:
    """The parameter itself and the settings of it that have another value than the one that counts."""
    if not param.overrides:
        return None
    lost = tuple(old for old in param.overrides if _differ(old, param))
    return (param, lost) if lost else None


def _of_ros2_nodes(rule: Rule, context: Context) -> Iterator[Finding]:
    """What files say is there to be overridden by later sources, and what is for every node by what is for one. Told is
    a value in the node's own tag or call that does not count, and what loses against this usual order."""
    paths = {source.path for node in context.tree.nodes_and_simulated for source in node.param_sources}
    for path in sorted(filter(None, paths)):
        document = context.documents.get(path)
        yield from repeated_in(document) if document is not None else ()
    reported: set[tuple[Location, Location]] = set()
    nodes = context.tree.nodes
    each_lost = context.each(_lost_values, nodes)
    for node, lost_values in compress(zip(nodes, each_lost, strict=True), each_lost):
        by_place = _settings(node, {param.name for param, _ in lost_values})
        for param, old in lost_values:
            counts, lost = by_place[_place(param)], by_place[_place(old)]
            why = _why_lost(lost, counts, own=_is_own(lost, counts, node, context))
            at = lost.place, counts.place
            if why is None or at in reported:
                continue
            reported.add(at)
            values = {"value": _shown(param.value), "old": _shown(old.value)}
            yield rule.claim(
                say(_OVERRIDDEN, name=param.name, node=node.name, why=why, **values),
                lost.place,
                subject=Subject("parameter", param.name),
                doubts=doubts(SHARED=lost.of_launch_file and not _is_inside(lost.place, node)),
                related=(Related("the value that applies", counts.place), *include_chain(old.origin)),
            )
    yield from _dead_arguments(rule, context, reported)


def repeated_in(document: Document, *more: Doubt) -> Iterator[Finding]:
    """Of the parameters that a file of ROS 2 sets twice for one node."""
    for first, second in read_param_file(document).repeated:
        yield RULE.claim(
            say(_TWICE, name=first.name, value=_shown(second.value)),
            document.location(first.name_span),
            subject=Subject("parameter", first.name),
            effect="style" if first.value == second.value else None,
            doubts=more,
            related=(Related("the value that applies", document.location(second.name_span)),),
        )


def _dead_arguments(rule: Rule, context: Context, reported: set[tuple[Location, Location]]) -> Iterator[Finding]:
    """What an argument gives and a later file sets again, to the value that the argument has by default: the argument
    cannot change it."""
    nodes = context.tree.nodes
    each_lost = context.each(_same_values, nodes)
    for node, same_values in compress(zip(nodes, each_lost, strict=True), each_lost):
        by_place = _settings(node, {param.name for param, _ in same_values})
        for param, old in same_values:
            counts, lost = by_place[_place(param)], by_place[_place(old)]
            at = lost.place, counts.place
            plain = counts.place.file == counts.path and not counts.source.substituted
            if at in reported or counts.index < lost.index or not plain or not lost.of_launch_file:
                continue
            reported.add(at)
            use = next((use for use in context.tree.uses if gives(context, use, lost.place)), None)
            if use is None or not _is_inside(lost.place, node):
                continue
            yield rule.claim(
                say(_DEAD_ARGUMENT, name=param.name, node=node.name, argument=use.name),
                lost.place,
                subject=Subject("parameter", param.name),
                related=(Related("the value that applies", counts.place), *include_chain(old.origin)),
            )


@dataclass(frozen=True, slots=True)
class _Ros2Setting:
    """A value that a node of ROS 2 gets: of its `index`th source, below that key."""

    index: int
    name: str
    source: ParamSource
    key: str
    place: Location

    @property
    def path(self) -> str | None:
        """The file that it stands in, unless that is the launch file."""
        return self.source.path

    @property
    def of_launch_file(self) -> bool:
        """Whether it is a value that the launch file has for the node."""
        return self.path is None and not self.source.pushed


def _lost_values(node: LaunchNode) -> tuple[tuple[Param, Param], ...]:
    """The node's parameters, each with one of the settings of other values that it replaced."""
    return tuple((param, old) for param in node.params for old in param.overrides if _differ(old, param))


def _same_values(node: LaunchNode) -> tuple[tuple[Param, Param], ...]:
    """The node's parameters, each with an equal setting that it replaced."""
    return tuple((param, old) for param in node.params for old in param.overrides if not _differ(old, param))


def _settings(node: LaunchNode, wanted: set[str]) -> dict[tuple[str, Location], _Ros2Setting]:
    return {
        _place(param): _Ros2Setting(index, param.name, source, key, _place(param)[1])
        for index, source in enumerate(node.param_sources)
        for key, param in zip(source.keys, source.params, strict=True)
        if param.name in wanted
    }


def _differ(one: Param, other: Param) -> bool:
    """Whether their values are not the same; 1 is not true."""
    if isinstance(one.value, bool) or isinstance(other.value, bool):
        return one.value is not other.value
    return bool(one.value != other.value)


def _place(param: Param) -> tuple[str, Location]:
    return param.name, param.place


def _why_lost(lost: _Ros2Setting, counts: _Ros2Setting, *, own: bool) -> str | None:
    """Why one value does not count beside another; None where that is what such settings are for."""
    if counts.index > lost.index:
        if not own:
            return None
        return "is set again by a later parameter file" if counts.path else "is set again below"
    if counts.index == lost.index:
        if counts.key == lost.key or "*" in lost.key or lost.path is None:
            return None
        return f"is set again by the later key '{counts.key}'"
    by = f"key '{counts.key}' of an earlier file" if counts.path else f"the earlier value for '{counts.key}'"
    return f"is set by {by}, which overrides '{lost.key}',"


def _is_own(lost: _Ros2Setting, counts: _Ros2Setting, node: LaunchNode, context: Context) -> bool:
    """Whether the value is meant to count: what a `<set_parameter>` says is there to be overridden, and so is by
    another dictionary what a Python launch file keeps in a variable for several nodes, or takes from a function."""
    if not lost.of_launch_file:
        return False
    written = context.text(lost.place)
    if not written or ("$" not in written and not lost.name.endswith(written)):
        return False
    return _is_inside(lost.place, node) or counts.path is not None


def _is_inside(place: Location, node: LaunchNode) -> bool:
    """Whether it stands in the tag or the call that starts the node."""
    around = node.action.span
    return place.file == node.origin[-1].file and around.start <= place.span.start and place.span.end <= around.end


def _keys_twice(rule: Rule, context: Context) -> Iterator[Finding]:
    for problem in problems_of(context, YamlKeyTwice):
        yield problem_claim(
            rule,
            problem,
            KEY_TWICE.format(problem.kind.name),
            subject=Subject("parameter", problem.kind.name),
            related=(Related("the value that applies", problem.kind.second),),
        )


def _setting(tags: Tags, param: Param) -> _Setting | None:
    for at in range(len(param.origin) - 1, -1, -1):
        tag = tags.at(param.origin[at])
        if tag is not None:
            return _Setting(param, tag, param.origin[:at])
    return None


def _surprise(tags: Tags, loser: _Setting, winner: _Setting) -> tuple[Effect, str] | None:
    """Why it is not what was meant that the one value is lost; None where it may well be.

    What a file of many parameters says is there to be overridden, and so is what an included file says. A setting
    under a condition is an alternative to the one that it overrides.
    """
    common = sum(1 for a, b in takewhile(lambda pair: pair[0] == pair[1], zip(loser.chain, winner.chain, strict=False)))
    if loser.loads_file or _is_alternative(tags, loser, winner, common):
        return None
    if len(winner.chain) == common < len(loser.chain):
        return None
    if len(loser.chain) == common < len(winner.chain):
        return "no-effect", "is set again by a later include"
    if len(winner.chain) > common:
        return "style", "is set again by another included file"
    return _in_one_file(loser, winner)


def _is_alternative(tags: Tags, loser: _Setting, winner: _Setting, common: int) -> bool:
    """Whether the winner has a condition that the loser does not have as well."""
    around = {id(action) for action in loser.tag.above}
    steps = [tag for place in winner.chain[common:] if (tag := tags.at(place)) is not None]
    own = (action for tag in (winner.tag, *steps) for action in (tag.action, *tag.above) if id(action) not in around)
    return any(map(has_condition, own))


def _in_one_file(loser: _Setting, winner: _Setting) -> tuple[Effect, str] | None:
    node = next((action for action in loser.tag.above if action.kind in ("node", "test")), None)
    in_winners_node = node is not None and any(action is node for action in winner.tag.above)
    if loser.is_private and not in_winners_node and not loser.in_node:
        return None  # a `~param` around the nodes, as a default that one of them replaces
    if winner.tag.action.head_span > loser.tag.action.head_span:
        if winner.loads_file:
            return "no-effect", "is set again by a later file"
        if loser.is_rosparam:
            return "style", f"is set again by a later <{winner.tag.action.kind}>"
        return "no-effect", "is set again below"
    if in_winners_node:
        return "no-effect", "is set by the <param> of the <node>, which comes after each <rosparam>,"
    if loser.in_node:
        return "no-effect", "is set by the <param> around the <node>, which comes after each <rosparam>,"
    return "no-effect", "is set by an earlier <param> for the node, which comes later,"


def _shown(value: object) -> str:
    if isinstance(value, CommandValue):
        return "the output of a command"
    if isinstance(value, (bytes, list)):
        return "another value" if isinstance(value, bytes) else f"a list of {len(value)}"
    text = str(value).lower() if isinstance(value, bool) else str(value)
    return f"'{shortened(text)}'"


RULE = Rule(
    id="PRM006",
    name="parameter-set-twice",
    effect="no-effect",
    kind="duplicate",
    sometimes=("style", Reason.SHARED, Reason.NOT_GIVEN),
    what="Checks for a parameter value that another one overrides in a way that is easily missed. Files that are "
    "overridden on purpose, included files and tags under a condition are ignored.",
    why="A change of the overridden value has no effect. The last of several settings applies, and no launcher "
    "reports the others. In a `<node>` of ROS 1 each `<param>` comes after each `<rosparam>`. A `<param "
    'name="~...">` around the node comes after those too. In ROS 2 the client library first collects all files by '
    "their keys. Of two keys that apply to a node, such as `/**` and `/camera`, the key that first appears later "
    "applies. In one file this is the lower one, even if it is the wildcard. A `<param>` belongs to `/**`, unless "
    "the node has both a `name` and a `namespace`. A `<param>` is therefore overridden by an earlier file with "
    "`/**` and the node's own name.",
    example='<param name="use_sim_time" value="true"/>\n<!-- sets use_sim_time to false -->\n'
    '<include file="$(find robot)/launch/robot.launch"/>',
    instead='<include file="$(find robot)/launch/robot.launch"/>\n<param name="use_sim_time" value="true"/>',
    references=(
        ROSLAUNCH_PARAM,
        ROSLAUNCH_ROSPARAM,
        PARAMETERS,
        NODE_ARGUMENTS,
    ),
    check=_check,
    problems=(YamlKeyTwice,),
)
