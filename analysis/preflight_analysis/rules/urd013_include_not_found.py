"""URD013: a xacro file includes a file that is not there."""

from __future__ import annotations

import os
from collections.abc import Iterator

from preflight_analysis.documents.disk import Disk
from preflight_analysis.environment.git_ignored import is_ignored
from preflight_analysis.environment.installed_paths import package_around
from preflight_analysis.environment.model import Environment
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.descriptions import below_package, doubts_of, named_file
from preflight_analysis.model.files import nearest_file
from preflight_analysis.model.nearest import did_you_mean
from preflight_analysis.model.problems import rename_in
from preflight_analysis.robot.xacro import xacro_file
from preflight_analysis.rules.further_reading import XACRO
from preflight_analysis.rules.packages import check_nothing
from preflight_analysis.rules.rule import Rule


def _of_description(rule: Rule, disk: Disk, environment: Environment, path: str) -> Iterator[Finding]:
    file = xacro_file(disk.db, path)
    if file is None or not file.is_xacro or file.document.problems:
        return
    for each in file.includes:
        missing = named_file(disk.db, environment, file, each).missing if not each.optional else None
        package = package_around(environment, missing) if missing is not None else None
        # What is installed may have it where it was not looked for.
        if missing is None or package is None or environment.is_installed(package):
            continue
        near = nearest_file(disk, missing, environment)
        name = os.path.basename(missing)
        beside = near is not None and os.path.dirname(near) == os.path.dirname(missing)
        meant = below_package(environment, near) if near is not None else None
        yield rule.claim(
            f"included file '{below_package(environment, missing)}' does not exist{did_you_mean(meant)}",
            file.document.location(each.span),
            subject=Subject("file", missing),
            kind="absent" if near is None else "near",
            doubts=(*doubts_of(each.around, other=False), *doubts(MADE_ELSEWHERE=is_ignored(disk, missing))),
            candidates=(near,),
            fixes=rename_in(file.document, each.span, name, os.path.basename(near) if near and beside else None),
        )


RULE = Rule(
    id="URD013",
    name="included-description-not-found",
    effect="breaks",
    kind="absent",
    always=(Reason.NOT_GIVEN,),
    sometimes=(Reason.MADE_ELSEWHERE, Reason.EXPLAINED),
    what="Checks for a `<xacro:include>` of a file that does not exist, in a package of the workspace.",
    why="xacro stops with an error, and the robot has no description.",
    example='<xacro:include filename="$(find arm_description)/urdf/griper.xacro"/>  <!-- the file is gripper.xacro -->',
    instead='<xacro:include filename="$(find arm_description)/urdf/gripper.xacro"/>',
    references=(XACRO,),
    check=check_nothing,
    of_description=_of_description,
)
