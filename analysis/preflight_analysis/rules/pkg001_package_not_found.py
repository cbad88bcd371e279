"""PKG001: a package that is not there."""

import os
from collections.abc import Iterable, Iterator
from functools import cache, partial

from preflight_analysis.documents.span import Location
from preflight_analysis.environment.model import Package
from preflight_analysis.evaluation.problems import PackageNotFound
from preflight_analysis.findings.finding import Finding, Related
from preflight_analysis.rules.installed import lack_of_package
from preflight_analysis.rules.nearest import did_you_mean, is_slip, nearest
from preflight_analysis.rules.places import attribute_location
from preflight_analysis.rules.problems import include_chain, problems_of, rename
from preflight_analysis.rules.retired import was_removed
from preflight_analysis.rules.rule import Context, Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    meant = cache(partial(_meant, context))
    for problem in problems_of(context, PackageNotFound):
        name, chain = problem.kind.name, include_chain(problem.origin)
        yield _finding(rule, context, name, meant(name), problem.location, chain, stops=problem.fatal)
    packages = context.environment.packages
    for node in context.tree.nodes:
        # A plain process is of no package, and a component has no executable in its one.
        there = node.resolved.package_path is not None or node.package in packages
        if node.package and not there and not node.unknowns and not was_removed(context, node):
            location, chain = attribute_location(context, node, "pkg"), include_chain(node.origin)
            yield _finding(rule, context, node.package, meant(node.package), location, chain, stops=False)


def _meant(context: Context, name: str) -> tuple[Package | None, str | None]:
    """The package in a folder of that name, and the name of the one that was probably meant."""
    renamed = _in_folder_of_that_name(context, name)
    return renamed, renamed.name if renamed is not None else nearest(name, context.environment.packages)


def _finding(
    rule: Rule,
    context: Context,
    name: str,
    meant: tuple[Package | None, str | None],
    location: Location,
    related: Iterable[Related],
    *,
    stops: bool,
) -> Finding:
    renamed, near = meant
    sure = renamed is not None or (near is not None and is_slip(name, near))
    if not sure:
        return rule.finding(
            f"package '{name}' is neither installed here nor in the workspace{did_you_mean(near)}",
            location,
            confidence="possible",
            related=related,
            stops_launch=stops,
            lack=lack_of_package(name),
        )
    fixes = rename(context, location, name, near) if near is not None else ()
    hint = f"; the folder {renamed.share} holds package '{renamed.name}'" if renamed is not None else did_you_mean(near)
    return rule.finding(
        f"package '{name}' is not among the {len(context.environment.packages)} packages of this environment{hint}",
        location,
        related=related,
        fixes=fixes,
        stops_launch=stops,
    )


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
    severity="error",
    what="Reports a package, in `$(find ...)` or as a node's `pkg`, that is neither on the package path nor in the "
    "workspace, and names the nearest one, or the one whose folder has that name and whose `package.xml` another. "
    "Without such a name the package may just not be installed on this machine: that is a hint only.",
    why="`$(find ...)` of a package that is not there stops `roslaunch`; a node of such a package is not started. The "
    "command `ros-preflight doctor` shows where packages are looked for.",
    example='<node pkg="rospy_tutorial" type="talker" name="talker"/>',
    instead='<node pkg="rospy_tutorials" type="talker" name="talker"/>',
    check=_check,
    problems=(PackageNotFound,),
)
