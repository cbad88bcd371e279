"""PRM022: a parameter that a plugin does not declare, in a parameter file (ROS 2).

https://docs.nav2.org/configuration/: below the name of a plugin stand `plugin`, by which it is loaded, and what it
declares.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import NamedTuple

from preflight_analysis.documents.document import Document
from preflight_analysis.documents.span import Span
from preflight_analysis.evaluation.ros2.param_files import FileParam, read_param_file
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Doubt, Reason, doubts
from preflight_analysis.findings.finding import Finding
from preflight_analysis.incremental.derived import derived
from preflight_analysis.model.context import Context, Plugin, Plugins
from preflight_analysis.model.nearest import is_slip
from preflight_analysis.model.plugin_params import KIND, LISTED, declared_below
from preflight_analysis.model.problems import rename
from preflight_analysis.model.sections import first_getters
from preflight_analysis.rules.further_reading import NAV2, PLUGINS
from preflight_analysis.rules.rule import Rule
from preflight_analysis.slips import closest


class Wrong(NamedTuple):
    """A parameter that its plugin does not declare, where it stands, and what was meant."""

    name: str
    span: Span
    meant: str
    plugin: Plugin

    @property
    def message(self) -> str:
        """What is wrong with it."""
        return (
            f"parameter '{self.name}' is not declared by plugin '{self.plugin.name}'; did you mean '{self.meant}'? "
            f"Source: {self.plugin.evidence}"
        )

    @property
    def doubts(self) -> tuple[Doubt, ...]:
        """How that is known."""
        return doubts(FROM_SOURCE=self.plugin.of_workspace, CATALOGUE=not self.plugin.of_workspace)


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for path, getter in first_getters(context).items():
        document = context.document(path)
        for wrong in wrong_in(document, context.plugins) if document is not None else ():
            place = context.location(path, wrong.span)
            old, new = (name.rpartition(".")[2] for name in (wrong.name, wrong.meant))
            same_place = wrong.name.removesuffix(old) == wrong.meant.removesuffix(new)
            yield rule.claim(
                wrong.message,
                place,
                subject=Subject("parameter", wrong.name),
                doubts=wrong.doubts,
                candidates=(wrong.meant,),
                related=(getter.related,),
                fixes=rename(context, place, old, new) if same_place else (),
            )


def wrong_in(document: Document, plugins: Plugins) -> Iterator[Wrong]:
    """Those of a parameter file."""
    for loaded, type_, values, below in _loaded(document):
        plugin = plugins.plugin(type_)
        if plugin is None or not plugin.params:
            continue
        declared = declared_below(plugin, values, plugins)
        elsewhere = {*plugin.elsewhere, KIND[1:]}
        free = [name for name in declared if name not in values]
        for param in below:
            name = param.name[len(loaded) + 1 :]
            if name in declared or name in elsewhere or any(map(name.endswith, _endings(elsewhere))):
                continue
            near = closest(name, [each for each in free if _is_near(name, each, values)])
            if len(near) == 1:
                yield Wrong(name, param.name_span, near[0], plugin)


@derived
def _loaded(document: Document) -> tuple[tuple[str, str, Mapping[str, object], tuple[FileParam, ...]], ...]:
    """The plugins of a file: name and type of each, and what is set below it, by name and as parameters."""
    found = []
    for section in read_param_file(document).sections:
        for param in section.params:
            name = param.name.removesuffix(KIND)
            if name != param.name and name and isinstance(param.value, str):
                below = tuple(each for each in section.params if each.name.startswith(f"{name}."))
                values = {each.name[len(name) + 1 :]: each.value for each in below}
                found.append((name, param.value, values, below))
    return tuple(found)


def _endings(elsewhere: set[str]) -> Iterator[str]:
    """Of what other versions declare below what a parameter lists."""
    return (name[found.end() :] for name in elsewhere if (found := LISTED.match(name)) is not None)


def _is_near(name: str, declared: str, values: Mapping[str, object]) -> bool:
    """Whether the last parts of two names at the same place are a slip apart, or the places, of which nothing is set in
    the one that was meant."""
    (space, _, leaf), (other_space, _, other) = name.rpartition("."), declared.rpartition(".")
    if space == other_space:
        return is_slip(leaf, other)
    return (
        leaf == other and is_slip(space, other_space) and not any(each.startswith(f"{other_space}.") for each in values)
    )


RULE = Rule(
    id="PRM022",
    name="parameter-of-plugin-not-declared",
    effect="no-effect",
    kind="near",
    sometimes=(Reason.FROM_SOURCE, Reason.NOT_GIVEN),
    of_sources=True,
    what="Checks for a parameter below the name of a plugin that the plugin does not declare, while one of a similar "
    "name is not set. Plugins of the workspace are read from their source, those of Nav2 are in the catalogue.",
    why="The plugin uses its default, and no tool reports that the value of the file is unused.",
    example='FollowPath:\n  plugin: "nav2_mppi_controller::MPPIController"\n  vx_maxx: 0.3',
    instead='FollowPath:\n  plugin: "nav2_mppi_controller::MPPIController"\n  vx_max: 0.3',
    references=(
        NAV2,
        PLUGINS,
    ),
    generations=(2,),
    check=_check,
    in_branches=True,
)
