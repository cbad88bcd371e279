"""URD015: a link of a robot description names a material that has no colour and no texture anywhere."""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.documents.disk import Disk
from preflight_analysis.environment.model import Environment
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason
from preflight_analysis.findings.finding import Finding
from preflight_analysis.model.descriptions import doubts_of, is_part, materials_for
from preflight_analysis.model.nearest import did_you_mean, nearest
from preflight_analysis.model.problems import rename_in
from preflight_analysis.robot.xacro import COMPUTED, xacro_file
from preflight_analysis.rules.further_reading import URDF_LINK
from preflight_analysis.rules.packages import check_nothing
from preflight_analysis.rules.rule import Rule


def _of_description(rule: Rule, disk: Disk, environment: Environment, path: str) -> Iterator[Finding]:
    file = xacro_file(disk.db, path)
    root = file.document.root if file is not None else None
    if file is None or root is None or root.tag != "robot" or file.document.problems or not file.materials_used:
        return
    known, whole = materials_for(disk.db, environment, path)
    if not whole or any(map(COMPUTED.search, known)) or is_part(disk.db, environment, path):
        return  # others may define it
    reported = set[str]()
    for used in file.materials_used:
        name = used.text
        if name in known or name in reported or not name or COMPUTED.search(name):
            continue
        reported.add(name)
        near = nearest(name, known)
        yield rule.claim(
            f"material '{name}' has no <color> or <texture> in this file or in those that it includes"
            f"{did_you_mean(near)}",
            file.document.location(used.span),
            subject=Subject("name", name),
            kind="absent" if near is None else "near",
            doubts=doubts_of(used.around, other=False),
            candidates=(near,),
            fixes=rename_in(file.document, used.span, name, near),
        )


RULE = Rule(
    id="URD015",
    name="undefined-material",
    effect="misbehaves",
    kind="absent",
    always=(Reason.NOT_GIVEN,),
    sometimes=(Reason.EXPLAINED,),
    what="Checks for a `<material>` of a link without `<color>` or `<texture>`, whose name has none elsewhere in the "
    "robot either. Files that include what is not known are not checked, nor those that are only made to be included.",
    why="urdfdom logs `material 'orange' undefined`, and RViz shows the link in its default colour.",
    example='<visual>\n  <geometry><box size="1 1 1"/></geometry>\n  <material name="orange"/>\n</visual>',
    instead='<material name="orange"><color rgba="1 0.5 0 1"/></material>',
    references=(URDF_LINK,),
    check=check_nothing,
    of_description=_of_description,
)
