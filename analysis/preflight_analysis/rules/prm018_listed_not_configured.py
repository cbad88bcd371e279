"""PRM018: a plugin in a list of plugins that is not configured as the others of the list are (ROS 2).

nav2, moveit and others take their plugins so: a list of names, and `NAME.plugin` (or `NAME.type`) for each.
https://docs.nav2.org/configuration/packages/configuring-costmaps.html#plugin-parameters
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import NamedTuple

from preflight_analysis.documents.document import Document
from preflight_analysis.documents.span import Span
from preflight_analysis.evaluation.ros2.param_files import Section, read_param_file
from preflight_analysis.findings.claim import Effect, Subject
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding, Related
from preflight_analysis.incremental.derived import derived
from preflight_analysis.model.context import Context
from preflight_analysis.model.problems import include_chain, quoted
from preflight_analysis.model.sections import first_getters
from preflight_analysis.rules.further_reading import NAV2, PLUGINS
from preflight_analysis.rules.rule import Rule

_KINDS = ("plugin", "type")
_MOVEIT = "moveit_simple_controller_manager"
_WITH_DEFAULTS = frozenset(
    map(
        frozenset,
        (
            ("static_layer", "obstacle_layer", "inflation_layer"),
            ("spin", "backup", "drive_on_heading", "wait"),
            ("spin", "backup", "drive_on_heading", "assisted_teleop", "wait"),
            ("navigate_to_pose", "navigate_through_poses"),
            ("DistanceScorer", "DynamicEdgesScorer"),
            ("AdjustSpeedLimit", "ReroutingService"),
        ),
    )
)
"""The lists that nav2 has where none is given: it knows the plugins of these, and of no other list."""


_COSTMAP = {"plugins": ("static_layer", "obstacle_layer", "inflation_layer")}
_OF_NAV: Mapping[str, Mapping[str, tuple[str, ...]]] = {
    "local_costmap": _COSTMAP,
    "global_costmap": _COSTMAP,
    "planner_server": {"planner_plugins": ("GridBased",)},
    "smoother_server": {"smoother_plugins": ("simple_smoother",)},
    "behavior_server": {"behavior_plugins": ("spin", "backup", "drive_on_heading", "wait")},
    "controller_server": {
        "controller_plugins": ("FollowPath",),
        "goal_checker_plugins": ("goal_checker",),
        "progress_checker_plugins": ("progress_checker",),
    },
}
"""By node of nav2: its lists of plugins, and what each has where it is not set. Each item needs `NAME.plugin` unless
the list is that one: `get_plugin_type_param` in nav2_util/include/nav2_util/node_utils.hpp, navigation2."""


class Missing(NamedTuple):
    """An item of a list without the parameter that says what it is. `ready`: plugins beside it that no list has. It is
    in a section for the nodes of `pattern`, with so many parameters. `instead`: it is the list that is missing, and
    those are loaded, but not `name`."""

    name: str
    parameter: str
    listed_in: str
    span: Span
    ready: tuple[tuple[str, Span], ...]
    pattern: str
    size: int
    instead: tuple[str, ...] = ()

    @property
    def message(self) -> str:
        """What is wrong with it."""
        if self.instead:
            return f"'{self.name}' is configured, but '{self.listed_in}' is not set: nav2 loads {quoted(self.instead)}"
        ready = [name for name, _ in self.ready]
        hint = f"; {quoted(ready)} is configured but not listed" if len(ready) == 1 else ""
        return (
            f"'{self.name}' in '{self.listed_in}' has no parameter '{self.parameter}', so nothing is loaded for "
            f"it{hint}"
        )

    @property
    def subject(self) -> Subject:
        """The parameter that is not there."""
        return Subject("parameter", self.listed_in if self.instead else self.parameter)

    @property
    def effect(self) -> Effect:
        """What it does: nav2 goes on with other plugins than those of the file, or a node ends."""
        return "no-effect" if self.instead else "stops-node"

    @property
    def meant(self) -> tuple[str, ...]:
        """What is configured in its place, where that is one."""
        return tuple(name for name, _ in self.ready) if len(self.ready) == 1 else ()


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    yield from _of_moveit(rule, context)
    getters = first_getters(context)
    found: list[tuple[str, Missing]] = []
    for path in getters:
        document = context.document(path)
        found += ((path, each) for each in missing_in(document)) if document is not None else ()
    if not found:
        return
    given: dict[str, set[str]] = {}
    for node in context.tree.nodes_and_simulated:
        given.setdefault(node.name, set()).update(
            param.name for source in node.param_sources for param in source.params
        )
    anywhere = set().union(*given.values())
    for path, missing in found:
        if missing.parameter in given.get(missing.pattern, anywhere) or (
            missing.instead and _is_listed(context, getters, missing)
        ):
            continue
        yield rule.claim(
            missing.message,
            context.location(path, missing.span),
            subject=missing.subject,
            effect=missing.effect,
            doubts=doubts(CATALOGUE=getters[path].by_include),
            candidates=missing.meant,
            related=(
                *(Related(f"'{name}' is configured here", context.location(path, at)) for name, at in missing.ready),
                getters[path].related,
            ),
        )


def _is_listed(context: Context, paths: Iterable[str], missing: Missing) -> bool:
    """Whether another file has the list for the same node."""
    return any(
        section.pattern == missing.pattern and any(param.name == missing.listed_in for param in section.params)
        for document in map(context.document, paths)
        if document is not None
        for section in read_param_file(document).sections
    )


def _of_moveit(rule: Rule, context: Context) -> Iterator[Finding]:
    """The controllers of a controller manager of MoveIt, which asks for `NAME.type` and more of each by that name. Of a
    file that has some of them it is said as of any list."""
    for node in context.tree.nodes:
        given = {param.name for param in node.params}
        for param in node.params:
            if param.name != f"{_MOVEIT}.controller_names" or not isinstance(param.value, list):
                continue
            listed = [each for each in param.value if isinstance(each, str)]
            lacking = [name for name in listed if not any(each.startswith(f"{_MOVEIT}.{name}.") for each in given)]
            of_file = any(source.path == param.place.file for source in node.param_sources)
            for name in lacking if len(lacking) == len(listed) or not of_file else ():
                yield rule.claim(
                    f"'{name}' in '{param.name}' has no section '{_MOVEIT}.{name}'; MoveIt does not know the "
                    "controller",
                    param.place,
                    subject=Subject("controller", name),
                    effect="breaks",
                    related=include_chain(node.origin),
                )


@derived
def missing_in(document: Document) -> tuple[Missing, ...]:
    """Those of a parameter file."""
    sections = read_param_file(document).sections
    return tuple(
        found for section in sections for found in (*_missing(document.text, section), *_without_list(section))
    )


def _without_list(section: Section) -> Iterator[Missing]:
    """Plugins of a node of nav2 whose only list is not set, so that it loads others."""
    lists = _of_nav(section)
    spans = {param.name: param.name_span for param in section.params}
    if len(lists) != 1 or any(name in spans for name in lists):
        return
    listed = {name for param in section.params if isinstance(param.value, list) for name in map(str, param.value)}
    for name, default in lists.items():
        for plugin, span in _ready(spans, "", "plugin", listed.union(default)):
            yield Missing(plugin, name, name, span, (), section.pattern, len(section.params), default)


def _of_nav(section: Section) -> Mapping[str, tuple[str, ...]]:
    return _OF_NAV.get(section.pattern.rpartition("/")[2], {})


def _missing(text: str, section: Section) -> Iterator[Missing]:
    spans = {param.name: param.name_span for param in section.params}
    of_nav = _of_nav(section)
    lists = {
        p.name: p.value
        for p in section.params
        if isinstance(p.value, list) and _are_names(p.value, fewest=1 if p.name in of_nav else 2)
    }
    listed = {name for names in lists.values() for name in names}
    for param in section.params:
        items = lists.get(param.name)
        if items is None or frozenset(items) in _WITH_DEFAULTS or of_nav.get(param.name) == tuple(items):
            continue
        above, dot, _ = param.name.rpartition(".")
        for kind in _KINDS:
            lacking = [name for name in items if f"{above}{dot}{name}.{kind}" not in spans]
            if not lacking:
                continue
            ready = tuple(_ready(spans, f"{above}{dot}", kind, listed))
            if len(lacking) == len(items) and not (
                kind == "plugin" and param.name in of_nav and (ready or any(_has_more(spans, name) for name in items))
            ):
                continue
            for name in lacking:
                at = re.search(
                    rf"(?<![\w.]){re.escape(name)}(?![\w.])", text[param.value_span.start : param.value_span.end]
                )
                start = param.value_span.start + (at.start() if at is not None else 0)
                at_name = Span(start, start + len(name))
                parameter, size = f"{above}{dot}{name}.{kind}", len(section.params)
                yield Missing(name, parameter, param.name, at_name, ready, section.pattern, size)


def _has_more(names: Iterable[str], plugin: str) -> bool:
    """Whether something else is set of the plugin."""
    return any(name.startswith(f"{plugin}.") for name in names)


def _are_names(items: Sequence[object], *, fewest: int) -> bool:
    return len(items) >= fewest and all(isinstance(item, str) and re.fullmatch(r"\w+", item) for item in items)


def _ready(spans: Mapping[str, Span], prefix: str, kind: str, listed: set[str]) -> Iterator[tuple[str, Span]]:
    """What is configured at the same place and in no list of the section."""
    for name, span in spans.items():
        if name.startswith(prefix) and name.endswith(f".{kind}"):
            plugin = name[len(prefix) : -len(kind) - 1]
            if plugin and "." not in plugin and plugin not in listed:
                yield plugin, span


RULE = Rule(
    id="PRM018",
    name="listed-not-configured",
    effect="stops-node",
    kind="absent",
    always=(Reason.LIBRARY,),
    sometimes=("breaks", "no-effect", Reason.NOT_GIVEN, Reason.CATALOGUE),
    what="Checks for a name in a list of a parameter file (`plugins`, `controller_plugins`, ...) without a "
    "`NAME.plugin` or `NAME.type`, and for a plugin of Nav2 that is in no list. It also checks "
    "`controller_names` of MoveIt.",
    why="The node requests that parameter for each name of the list and does not start without it. Often the list "
    "and the section differ in the name.",
    example='plugins: ["voxel_layer", "inflation_layer"]\n'
    'obstacle_layer:\n  plugin: "nav2_costmap_2d::ObstacleLayer"\n'
    'inflation_layer:\n  plugin: "nav2_costmap_2d::InflationLayer"',
    instead='plugins: ["obstacle_layer", "inflation_layer"]\n'
    'obstacle_layer:\n  plugin: "nav2_costmap_2d::ObstacleLayer"\n'
    'inflation_layer:\n  plugin: "nav2_costmap_2d::InflationLayer"',
    references=(
        NAV2,
        PLUGINS,
    ),
    generations=(2,),
    check=_check,
    in_branches=True,
)
