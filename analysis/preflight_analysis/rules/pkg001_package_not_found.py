"""PKG001: a package that is not there."""

import os
import re
from collections.abc import Iterable, Iterator

from preflight_analysis.catalogue.released import distributions_with
from preflight_analysis.documents.disk import Disk
from preflight_analysis.documents.span import Location
from preflight_analysis.environment.git_history import Change, formerly_named
from preflight_analysis.environment.installed_paths import package_around
from preflight_analysis.environment.model import Environment, Package
from preflight_analysis.environment.packages import MANIFEST
from preflight_analysis.evaluation.problems import PackageNotFound
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding, Related
from preflight_analysis.findings.lack import Lack
from preflight_analysis.incremental.derived import derived
from preflight_analysis.model.below_packages import has_what_is_asked_of, lacks_what_is_asked_of
from preflight_analysis.model.context import Context
from preflight_analysis.model.descriptions import LOOSE, doubts_of
from preflight_analysis.model.installed import (
    debian_package_of,
    is_of_family,
    lack_of_package,
    near_package,
    words_of_folders,
)
from preflight_analysis.model.nearest import did_you_mean, is_reworded, is_slip_of_words, nearest
from preflight_analysis.model.places import attribute_location, program_known
from preflight_analysis.model.problems import enumerated, include_chain, problems_of, rename, rename_in
from preflight_analysis.model.retired import was_removed
from preflight_analysis.robot.xacro import xacro_file
from preflight_analysis.rules.further_reading import PACKAGE_NAMES, ROSDEP, ROSLAUNCH_NODE
from preflight_analysis.rules.rule import Rule

_GENERIC = frozenset(
    ("cpp", "driver", "msgs", "node", "py", "ros", "ros2", "srvs",
     "camera", "gnss", "gps", "imu", "laser", "lidar", "radar", "sensor", "sensors")
)  # fmt: skip
"""Words that packages of all kinds have in their names, and those of drivers of all makes."""

_NOT_AMONG = "package '{}' not found among {} packages{}"
_NO_NAME = re.compile(r"[<>{}\s]")
_PLACEHOLDER = re.compile(
    r"(?i)\A(?:<.*>|\{\{.*\}\}|(?:your|my)[_-](?:\w+[_-])?(?:package|pkg)(?:[_-]name)?|(?:package|pkg)[_-]name|todo\w*|fixme"
    r"|xxx+)\Z"
)
"""Names that stand in examples for that of a package, of which some could be no name."""
_ROLES = frozenset(
    ("bringup", "config", "control", "description", "descriptions", "gazebo", "launch", "moveit", "msgs", "navigation",
     "sim", "simulation", "teleop", "viz")
)  # fmt: skip
"""Words by which the packages of one robot differ."""


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for problem in problems_of(context, PackageNotFound):
        name, chain = problem.kind.name, include_chain(problem.origin)
        yield _finding(rule, context, name, problem.location, chain, stops=problem.fatal)
    for node in _nodes_without_package(context):
        location, chain = attribute_location(context, node, "pkg"), include_chain(node.origin)
        yield _finding(rule, context, node.package, location, chain, stops=False)


def _of_description(rule: Rule, disk: Disk, environment: Environment, path: str) -> Iterator[Finding]:
    """Of what a file of a robot description names, a slip alone: others have packages that are not here."""
    file, packages = xacro_file(disk.db, path), environment.packages
    for use in file.uses if file is not None else ():
        name = use.name
        if use.kind != "package" or name in packages or "$" in name or any(distributions_with(name, n) for n in (1, 2)):
            continue
        near = nearest(name, packages)
        if near is None or not (is_slip_of_words(name, near) or is_reworded(name, near)):
            continue
        if file is None:
            continue
        named = any(name in package.dependencies for package in packages.values())
        yield rule.claim(
            _NOT_AMONG.format(name, len(packages), did_you_mean(near)),
            file.document.location(use.span),
            subject=Subject("package", name),
            kind="near",
            doubts=(*LOOSE, *doubts_of(use.around, other=named)),
            candidates=(near,),
            fixes=rename_in(file.document, use.span, name, near),
        )


def _nodes_without_package(context: Context) -> Iterator[LaunchNode]:
    packages = context.environment.packages
    for node in context.tree.nodes:
        # A plain process is of no package, and a component has no executable in its one.
        there = node.resolved.package_path is not None or node.package in packages
        if node.package and not there and program_known(node) and not was_removed(context, node):
            yield node


@derived
def _meant(context: Context, name: str) -> tuple[Package | None, str | None]:
    """The package in a folder of that name, and the name of the one that was probably meant."""
    renamed = _in_folder_of_that_name(context, name)
    return renamed, renamed.name if renamed is not None else near_package(context, name)


def _finding(
    rule: Rule,
    context: Context,
    name: str,
    location: Location,
    related: Iterable[Related],
    *,
    stops: bool,
) -> Finding:
    change = _change_of(context, name, location.file)
    renamed, near = _meant(context, name)
    if change is not None:
        renamed, near = None, _at(context, change.path)
    if near is None:
        return _not_here(rule, context, name, location, related, stops=stops)
    fixes = rename(context, location, name, near)
    hint = did_you_mean(near)
    if renamed is not None:
        hint = f"; the folder {renamed.share} contains package '{renamed.name}'"
    elif change is not None:
        hint = change.told(near)
    return rule.claim(
        _NOT_AMONG.format(name, len(context.environment.packages), hint),
        location,
        subject=Subject("package", name),
        kind="near",
        effect="stops-launch" if stops else None,
        candidates=(near,),
        related=related,
        fixes=fixes,
        stops_launch=stops,
    )


def _change_of(context: Context, name: str, file: str) -> Change | None:
    """What git knows of a package that was in a folder of that name, in the repository of the launch file."""
    manifests = formerly_named(context.disk, os.path.dirname(file), MANIFEST)
    return next((change for path, change in manifests if os.path.basename(os.path.dirname(path)) == name), None)


def _at(context: Context, manifest: str | None) -> str | None:
    """The name of the package with that manifest."""
    return next((each.name for each in context.environment.packages.values() if each.manifest == manifest), None)


def _not_here(
    rule: Rule, context: Context, name: str, location: Location, related: Iterable[Related], *, stops: bool
) -> Finding:
    """Of a package that nothing is near to: what is released, or named by a manifest, is missing on this machine."""
    having = distributions_with(name, context.tree.generation)
    lack: Lack | None = lack_of_package(context, name)
    meant: str | None = None
    is_sure, is_placeholder = True, False
    text = f"package '{name}' is neither installed nor in the workspace"
    if having:
        package = debian_package_of(context, name)
        which = f"; install {package}" if package else f"; it is released for {enumerated(having)}"
        text = f"package '{name}' is not installed{which}"
    elif name in _named_by_manifests(context):
        text += " nor released for any distribution"
    elif _PLACEHOLDER.search(name):
        text = f"'{name}' is the placeholder of an example, no package; write the name of the package"
        lack, is_placeholder = None, True
    elif (having_it := has_what_is_asked_of(context, location.file, name)) is not None:
        other, path = having_it
        text += f" nor released for any distribution; package '{other.name}' has '{path}'{did_you_mean(other.name)}"
        meant, lack = other.name, None
        is_sure = _is_own_or_akin(context, location.file, name, other)
    else:
        text += f"; it is not released for any distribution, and no {MANIFEST} of the workspace names it"
        # Whoever uses several such packages has them elsewhere. A single one may be left over from before a rename.
        if _strangers(context) == {name}:
            near = _of_like_words(context, name)
            if near is not None and (
                is_of_family(context, name, near.name) or lacks_what_is_asked_of(context, location.file, name, near)
            ):
                near = None
            meant, lack = near.name if near is not None else None, None
            text += did_you_mean(meant)
            is_sure = meant is not None
    change = _change_of(context, name, location.file)
    if change is not None and change.path is None:
        text += change.told(None)
    return rule.claim(
        text,
        location,
        subject=Subject("package", name),
        kind="invalid" if is_placeholder else "absent" if meant is None else "near",
        effect="stops-launch" if stops else None,
        doubts=doubts(UNSEEN=not having and not _NO_NAME.search(name), ON_ROBOT=not is_sure),
        candidates=(meant,),
        related=related,
        fixes=rename(context, location, name, meant, preferred=False) if meant is not None else (),
        stops_launch=stops,
        lack=lack,
    )


def _is_own_or_akin(context: Context, file: str, name: str, other: Package) -> bool:
    """Whether a package is that of the launch file, or has a word of another's name that not all may have."""
    own = package_around(context.environment, file)
    generic = _GENERIC | words_of_folders(context.disk.db, context.environment)
    common = set(name.split("_")) & set(other.name.split("_")) - generic
    return bool(common) or (own is not None and own.name == other.name)


@derived
def _strangers(context: Context) -> frozenset[str]:
    """The packages of the launch that nobody knows: not here, not released, named by no manifest."""
    generation, named = context.tree.generation, _named_by_manifests(context)
    names = {problem.kind.name for problem in problems_of(context, PackageNotFound)}
    names.update(node.package for node in _nodes_without_package(context))
    return frozenset(name for name in names if name not in named and not distributions_with(name, generation))


def _of_like_words(context: Context, name: str) -> Package | None:
    """The one package of the workspace whose name differs in one word, or has some more: as before a rename. A word
    that all packages of the project may have, as its folder has it, tells nothing."""
    generic = _GENERIC | words_of_folders(context.disk.db, context.environment)
    words, environment = name.split("_"), context.environment
    here, own = [], package_around(environment, context.root)
    for package in environment.own_packages:
        others = package.name.split("_")
        if package is own or _ROLES.issuperset(set(words) ^ set(others)):
            continue
        differing = sum(a != b for a, b in zip(words, others, strict=False))
        one_word = len(words) == len(others) > 1 and differing == 1
        if (one_word or set(words) < set(others)) and not generic.issuperset(set(words) & set(others)):
            here.append(package)
    return here[0] if len(here) == 1 else None


@derived
def _named_by_manifests(context: Context) -> frozenset[str]:
    return frozenset[str]().union(*(package.dependencies for package in context.environment.packages.values()))


def _in_folder_of_that_name(context: Context, name: str) -> Package | None:
    """The package whose folder is named so, while its package.xml says something else: that one counts for ROS."""
    environment = context.environment
    for package in (*environment.packages.values(), *(p for others in environment.shadowed.values() for p in others)):
        if os.path.basename(package.share.rstrip("/")) == name and package.name != name:
            return package
    return None


RULE = Rule(
    id="PKG001",
    name="package-not-found",
    effect="stops-node",
    kind="absent",
    sometimes=("stops-launch", Reason.NOT_HERE, Reason.UNSEEN, Reason.ON_ROBOT, Reason.NOT_GIVEN),
    what="Checks for a package, in `$(find ...)` or as the `pkg` of a node, that is neither on the package path nor "
    "in the workspace. The finding names the nearest package, or the Debian package to install.",
    why="`roslaunch` stops at `$(find ...)` of a missing package, and does not start a node of one. `ros-preflight "
    "doctor` shows the folders that are searched.",
    example='<node pkg="rospy_tutorial" type="talker" name="talker"/>',
    instead='<node pkg="rospy_tutorials" type="talker" name="talker"/>',
    references=(
        PACKAGE_NAMES,
        ROSLAUNCH_NODE,
        ROSDEP,
    ),
    check=_check,
    of_description=_of_description,
    problems=(PackageNotFound,),
    in_branches=True,
)
