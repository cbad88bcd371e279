"""PRM021: a type of controller or plugin that its package does not have (ROS 2).

https://control.ros.org/jazzy/doc/ros2_control/controller_manager/doc/userdoc.html#parameters
https://docs.nav2.org/plugins/
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator
from fnmatch import fnmatchcase
from typing import NamedTuple

from preflight_analysis.catalogue.packages import distribution_of
from preflight_analysis.catalogue.plugin_names import distributions_with as distributions_with_plugin
from preflight_analysis.catalogue.plugin_names import is_known, name_there, names_of
from preflight_analysis.catalogue.released import DISTRIBUTIONS, distributions_with
from preflight_analysis.documents.disk import Disk
from preflight_analysis.documents.document import Document
from preflight_analysis.documents.span import Span
from preflight_analysis.environment.model import Environment
from preflight_analysis.evaluation.ros2.param_files import read_param_file
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding
from preflight_analysis.incremental.database import Database
from preflight_analysis.incremental.derived import derived
from preflight_analysis.incremental.query import query
from preflight_analysis.model.context import Context
from preflight_analysis.model.controllers import place_of
from preflight_analysis.model.descriptions import LOOSE, doubts_of
from preflight_analysis.model.meant import meant_values
from preflight_analysis.model.nearest import camel_words, did_you_mean, is_slip
from preflight_analysis.model.places import related_node
from preflight_analysis.model.problems import rename, rename_in
from preflight_analysis.model.sections import first_getters
from preflight_analysis.robot.xacro import xacro_file
from preflight_analysis.rules.further_reading import CONTROLLER_MANAGER, PLUGINLIB, PLUGINS
from preflight_analysis.rules.rule import Rule
from preflight_analysis.source.analyse import SourceAnalysis

_ALIKE = 0.6
"""How many of all the words of two names have to be in both."""
_FEWEST = 2
"""Words of a name that is another one without some of its words; one alone is `Controller`."""

_KINDS = {".type": "controller", ".plugin": "plugin"}


class _Named(NamedTuple):
    """The type of a controller or a plugin, and where it stands."""

    kind: str
    package: str
    type: str
    span: Span


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    yield from _of_types(rule, context)
    yield from _of_values(rule, context)


def _of_description(rule: Rule, disk: Disk, environment: Environment, path: str) -> Iterator[Finding]:
    """Of the hardware of ros2_control that a description names, and whose class packages of the workspace have by a
    name like it."""
    file = xacro_file(disk.db, path)
    for each in file.plugins if file is not None else ():
        known = _exported(disk.db, environment)
        package, _, leaf = each.text.replace("::", "/").rpartition("/")
        if file is None or not package or "$" in each.text or each.text in known:
            continue
        # A class of the same name may well be that of another package, if there is one.
        end = f"/{leaf}" if package not in environment.packages and not distributions_with(package, 2) else each.text
        found = [name for name in known if is_slip(each.text, name) or name.replace("::", "/").endswith(end)]
        if len(found) != 1:
            continue
        yield rule.claim(
            f"unknown plugin '{each.text}' of ros2_control; did you mean '{found[0]}'? Source: the plugin "
            "descriptions of the workspace",
            file.document.location(each.span),
            subject=Subject("plugin", each.text),
            doubts=(*LOOSE, *doubts_of(each.around, other=False)),
            candidates=found,
            fixes=rename_in(file.document, each.span, each.text, found[0]),
        )


@query
def _exported(db: Database, environment: Environment) -> frozenset[str]:
    """The plugins of all packages of the workspace, by their descriptions."""
    analysis = SourceAnalysis(environment, Disk(db))
    return frozenset(name for package in environment.own_packages for name in analysis.exported(package.name))


def _of_values(rule: Rule, context: Context) -> Iterator[Finding]:
    """What parameters name that are known to name plugins."""
    distro = context.environment.distro
    for node, values in meant_values(context):
        if _is_of_workspace(context, node.package):
            continue  # it may be another version than that of which the values are known
        for each in values:
            meaning, value = each.meaning, each.value
            if each.param is None or not isinstance(value, str):
                continue
            if distro in DISTRIBUTIONS[context.tree.generation] and distro not in each.known.entry.distributions:
                continue
            formerly = meaning.formerly.get(value)
            meant = formerly or _slip_of(value, meaning.names)
            if meant is None:
                continue
            place = place_of(context, each.param, value)
            what = "is that of an older distribution" if formerly else "names no plugin"
            yield rule.claim(
                f"value '{value}' of '{each.parameter}' {what}; did you mean '{meant}'? Source: {each.known.evidence}",
                place,
                subject=Subject("plugin", value),
                effect="no-effect" if meaning.role == "name" else None,
                doubts=doubts(OTHER_VERSION=not each.known.is_used),
                candidates=(meant,),
                related=(related_node(node),),
                fixes=rename(context, place, value, meant),
            )


def _slip_of(value: str, names: Collection[str]) -> str | None:
    """The only name that a value, which may have wildcards and any case, is a slip of."""
    if any(fnmatchcase(name.lower(), value.lower()) for name in names):
        return None
    near = [name for name in names if is_slip(value, name)]
    return near[0] if len(near) == 1 else None


def _of_types(rule: Rule, context: Context) -> Iterator[Finding]:
    """The types of controllers and plugins in parameter files."""
    environment = context.environment
    distro = distribution_of(context.tree.generation, environment.distro)
    for path, getter in first_getters(context).items():
        document = context.document(path)
        for named in _types_in(document) if document is not None else ():
            of_nav = _of_nav(context, named)
            if of_nav is not None:
                message, near = of_nav
                place = context.location(path, named.span)
                yield rule.claim(
                    message + did_you_mean(near),
                    place,
                    subject=Subject("plugin", named.type),
                    kind="absent" if near is None else "near",
                    doubts=doubts(CATALOGUE=True),
                    candidates=(near,),
                    related=(getter.related,),
                    fixes=rename(context, place, named.type, near) if near is not None else (),
                )
                continue
            known, own = context.plugins.names(named.package), context.plugins.exported(named.package)
            meant = _meant(named, known or own, is_own=bool(own))
            abridged = _unabridged(named, known) if meant is None and not own else None
            meant = meant or abridged
            if meant is None:
                continue
            place = context.location(path, named.span)
            by = "its plugin descriptions" if own else f"the catalogue of {distro}"
            yield rule.claim(
                f"unknown {named.kind} '{named.type}' of package '{named.package}'; did you mean '{meant}'? "
                f"Source: {by}",
                place,
                subject=Subject("plugin", named.type),
                # Another version of the package may have had the shorter name.
                doubts=doubts(CATALOGUE=not own, OTHER_VERSION=abridged is not None and environment.distro != distro),
                candidates=(meant,),
                related=(getter.related,),
                fixes=rename(context, place, named.type, meant),
            )


def _of_nav(context: Context, named: _Named) -> tuple[str, str | None] | None:
    """What is wrong with a plugin of Nav2 that the distribution has by another name or not at all, and what it has."""
    distro = context.environment.distro
    if distro is None or not is_known(distro) or _is_of_workspace(context, named.package):
        return None
    elsewhere, near = distributions_with_plugin(named.type), name_there(named.type, distro)
    # Of a package without plugins there nothing is loaded, such as the navigators of Humble.
    if distro in elsewhere or not (near or (elsewhere and names_of(named.package, distro))):
        return None
    has_it = f", but in {', '.join(elsewhere)}" if near is None else ""
    return f"unknown {named.kind} '{named.type}': Nav2 does not have it in {distro}{has_it}", near


def _is_of_workspace(context: Context, package: str) -> bool:
    own = context.environment.packages.get(package)
    return own is not None and own.is_within(context.environment.workspace)


@derived
def _types_in(document: Document) -> tuple[_Named, ...]:
    found = []
    for param in (param for section in read_param_file(document).sections for param in section.params):
        kind = next((kind for end, kind in _KINDS.items() if param.name.endswith(end)), None)
        type_ = param.value
        if kind is not None and isinstance(type_, str) and (package := _package_of(type_)) is not None:
            found.append(_Named(kind, package, type_, param.value_span))
    return tuple(found)


def _meant(named: _Named, known: Collection[str], *, is_own: bool) -> str | None:
    """The only one that is a slip away, or of controllers has most of the words: what a package has had in other
    versions is called otherwise altogether. `is_own`: descriptions that a build writes are not among those of the
    workspace, so that only a slip counts."""
    others = _written_alike(named, known)
    if named.type in others:
        return _exact(named.type, known) if is_own else None
    near = [each for each in others if is_slip(named.type, each)]
    if not near and named.kind == "controller" and not is_own:
        near = [each for each in others if _share_most(named.type, each)]
    return near[0] if len(near) == 1 else None


def _package_of(type_: str) -> str | None:
    package, mark, name = type_.replace("::", "/").partition("/")
    return package if mark and package.isidentifier() and name.isidentifier() else None


def _exact(type_: str, known: Collection[str]) -> str | None:
    """What a description calls a type that has the other mark: pluginlib looks for the name itself."""
    same = (each for each in known if each.replace("::", "/") == type_.replace("::", "/"))
    return next(same, None) if type_ not in known else None


def _unabridged(named: _Named, known: Iterable[str]) -> str | None:
    """The only controller of a package, where the type has some of its words and no other ones."""
    others = _written_alike(named, known) if named.kind == "controller" else []
    if len(others) != 1:
        return None
    mine, theirs = _words(named.type), _words(others[0])
    return others[0] if mine < theirs and len(mine) >= _FEWEST else None


def _written_alike(named: _Named, known: Iterable[str]) -> list[str]:
    mark = "/" if "/" in named.type else "::"
    return [each.replace("/", mark).replace("::", mark) for each in known]


def _share_most(type_: str, other: str) -> bool:
    mine, theirs = _words(type_), _words(other)
    return len(mine & theirs) >= _ALIKE * len(mine | theirs)


def _words(type_: str) -> set[str]:
    return {*camel_words(type_.partition("/")[2])}


RULE = Rule(
    id="PRM021",
    name="unknown-plugin-type",
    effect="stops-node",
    kind="near",
    always=(Reason.UNSEEN,),
    sometimes=(Reason.NOT_GIVEN,),
    of_param=True,
    what="Checks for a type of controller (`NAME.type`) or plugin (`NAME.plugin`) that its package does not have, if "
    "the package has one of a similar name. The types are those of plugin descriptions or of the catalogue. Other "
    "parameters that choose plugins count, too, such as `robot_model_type` of AMCL and `plugin_allowlist` of MAVROS. "
    "The `<plugin>` of `<ros2_control>` in a robot description counts if a package of the workspace has it.",
    why="pluginlib does not find the class. The spawner of the controller exits, or the node does not start.",
    example="force_torque_sensor_broadcaster:\n  type: force_torque_sensor_broadcaster/ForceTorqueStateBroadcaster",
    instead="force_torque_sensor_broadcaster:\n  type: force_torque_sensor_broadcaster/ForceTorqueSensorBroadcaster",
    references=(
        PLUGINS,
        PLUGINLIB,
        CONTROLLER_MANAGER,
    ),
    generations=(2,),
    check=_check,
    of_description=_of_description,
    in_branches=True,
)
