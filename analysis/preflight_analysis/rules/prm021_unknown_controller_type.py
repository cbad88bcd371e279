"""PRM021: a type of controller that its package does not have (ROS 2).

https://control.ros.org/jazzy/doc/ros2_control/controller_manager/doc/userdoc.html#parameters
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from itertools import chain
from typing import NamedTuple

from preflight_analysis.catalogue.packages import distribution_of, interfaces_of
from preflight_analysis.documents.document import Document
from preflight_analysis.documents.span import Span
from preflight_analysis.evaluation.ros2.param_files import read_param_file
from preflight_analysis.findings.finding import Finding, Related
from preflight_analysis.rules.installed import is_installed
from preflight_analysis.rules.nearest import is_slip
from preflight_analysis.rules.places import getters_of
from preflight_analysis.rules.problems import rename
from preflight_analysis.rules.rule import Context, Rule

_WORD = re.compile(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+|\d+")
_ALIKE = 0.6
"""How many of all the words of two names have to be in both."""


class _Wrong(NamedTuple):
    """A type that its package does not have, where it stands, and what was meant."""

    package: str
    type: str
    span: Span
    meant: str


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    environment = context.environment
    distro = distribution_of(context.tree.generation, environment.distro)
    getters: dict[str, Related] = {}
    for path, getter in chain.from_iterable(context.kept.each(getters_of, context.tree.nodes)):
        getters.setdefault(path, getter)
    for path, getter in getters.items():
        document = context.documents.get(path)
        for wrong in document.once(_wrong_in, distro) if document is not None else ():
            here = environment.packages.get(wrong.package)
            if here is not None and not is_installed(context, here):
                continue  # the workspace's own may be another version
            place = context.location(path, wrong.span)
            yield rule.finding(
                f"package '{wrong.package}' has no controller '{wrong.type}', as far as the catalogue of {distro} knows"
                f"; did you mean '{wrong.meant}'?",
                place,
                confidence="likely" if environment.distro == distro else "possible",
                related=(getter,),
                fixes=rename(context, place, wrong.type, wrong.meant),
            )


def _wrong_in(document: Document, distro: str) -> tuple[_Wrong, ...]:
    found = []
    for param in (param for section in read_param_file(document).sections for param in section.params):
        type_ = param.value
        if param.name.endswith(".type") and isinstance(type_, str) and type_.count("/") == 1:
            package = type_.partition("/")[0]
            known = interfaces_of(package, distro).get("controllers", {})
            meant = _meant(type_, known) if type_ not in known else None
            if meant is not None:
                found.append(_Wrong(package, type_, param.value_span, meant))
    return tuple(found)


def _meant(type_: str, known: Iterable[str]) -> str | None:
    """The only one that is a slip away, or has most of the words: what a package has had in other versions is called
    otherwise altogether."""
    near = [each for each in known if is_slip(type_, each)] or [each for each in known if _share_most(type_, each)]
    return near[0] if len(near) == 1 else None


def _share_most(type_: str, other: str) -> bool:
    mine, theirs = ({*_WORD.findall(each.partition("/")[2])} for each in (type_, other))
    return len(mine & theirs) >= _ALIKE * len(mine | theirs)


RULE = Rule(
    id="PRM021",
    name="unknown-controller-type",
    severity="warning",
    what="Reports a type of controller (`NAME.type`) that the package which it names does not have, while that one has "
    "another of nearly the same name (ROS 2). What packages have, the catalogue says; those of the workspace itself "
    "are left alone.",
    why="The manager finds no plugin of that name, the spawner ends, and what the controller should do nobody does.",
    example="force_torque_sensor_broadcaster:\n  type: force_torque_sensor_broadcaster/ForceTorqueStateBroadcaster",
    instead="force_torque_sensor_broadcaster:\n  type: force_torque_sensor_broadcaster/ForceTorqueSensorBroadcaster",
    generations=(2,),
    check=_check,
    in_branches=True,
)
