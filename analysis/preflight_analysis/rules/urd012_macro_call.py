"""URD012: the call of a xacro macro does not fit the macro."""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.documents.disk import Disk
from preflight_analysis.environment.installed_paths import package_around
from preflight_analysis.environment.model import Environment
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Doubt, Reason, doubts
from preflight_analysis.findings.finding import Finding, Related
from preflight_analysis.generation import ros
from preflight_analysis.model.descriptions import defined_for, doubts_of
from preflight_analysis.model.distributions import BEFORE_NOETIC, otherwise_in
from preflight_analysis.model.nearest import did_you_mean, nearest
from preflight_analysis.model.problems import quoted, rename_in
from preflight_analysis.robot.xacro import XACRO, Call, Macro, XacroFile, xacro_file
from preflight_analysis.rules.further_reading import XACRO as XACRO_PAGE
from preflight_analysis.rules.packages import check_nothing
from preflight_analysis.rules.rule import Rule

_WHERE = frozenset(("robot", f"{XACRO}macro", f"{XACRO}if", f"{XACRO}unless"))
"""What has links and joints in it, and no elements of plugins that are called as they like."""
_OF_ROBOT = ("link", "joint", "visual", "collision", "inertial", "geometry")
_OF_URDF = frozenset(
    ("axis", "box", "collision", "color", "cylinder", "gazebo", "geometry", "group", "inertia", "inertial", "joint",
     "limit", "link", "mass", "material", "mesh", "origin", "robot", "ros2_control", "sensor", "sphere", "transmission",
     "visual", "plugin", "model", "world", "safety_controller", "dynamics", "mimic", "calibration")
)  # fmt: skip


def _of_description(rule: Rule, disk: Disk, environment: Environment, path: str) -> Iterator[Finding]:
    file = xacro_file(disk.db, path)
    if file is None or not file.is_xacro or file.document.problems:
        return
    macros = defined_for(disk.db, environment, path).macros
    package = package_around(environment, path)
    generation = package.generation if package is not None else environment.generation
    old = environment.distro in BEFORE_NOETIC
    of_version = (
        *doubts(OTHER_VERSION=old or (ros(generation).has_master and environment.distro != "noetic")),
        *otherwise_in(environment, BEFORE_NOETIC),
    )
    # The xacro of these takes a call without its prefix, and says that Noetic's does not.
    for call in file.calls:
        definitions = macros.get(call.name, ())
        if not call.prefixed and not definitions and _is_call_of_unknown(call):
            message = f"<{call.name}> is no element of a robot: to call a macro, write <{XACRO}{call.name}>"
            yield _unprefixed(rule, file, call, message, of_version, ())
        # Those of one name may be each for another robot.
        if len({macro.parameters for _, macro in definitions}) != 1:
            continue
        home, macro = definitions[0]
        if not all(each.name.isidentifier() for each in macro.parameters):
            continue
        defined = xacro_file(disk.db, home)
        related = (
            (Related(f"macro '{macro.name}'", defined.document.location(macro.span)),) if defined is not None else ()
        )
        if call.prefixed:
            yield from _unfit(rule, file, call, macro, related)
        elif _is_call(call, macro):
            message = f"<{call.name}> does not call the macro '{call.name}': write <{XACRO}{call.name}>"
            yield _unprefixed(rule, file, call, message, of_version, related)


def _unprefixed(
    rule: Rule, file: XacroFile, call: Call, message: str, of_version: tuple[Doubt, ...], related: tuple[Related, ...]
) -> Finding:
    meant = f"{XACRO}{call.name}"
    return rule.claim(
        message,
        file.document.location(call.span),
        subject=Subject("element", call.name),
        kind="near",
        effect="no-effect",
        doubts=(*doubts_of(call.around, other=False), *of_version),
        candidates=(meant,),
        related=related,
        fixes=rename_in(file.document, call.span, call.name, meant) if not call.blocks else (),
    )


def _unfit(rule: Rule, file: XacroFile, call: Call, macro: Macro, related: tuple[Related, ...]) -> Iterator[Finding]:
    plain = [each for each in macro.parameters if not each.block]
    names = [each.name for each in plain]
    doubted = doubts_of(call.around, other=False)
    missing = [each.name for each in plain if not each.has_default and each.name not in call.attributes]
    unknown = [name for name in call.attributes if name not in names]
    for name in unknown:
        near = nearest(name, [each for each in names if each not in call.attributes])
        span = call.attributes[name]
        yield rule.claim(
            f"macro '{macro.name}' has no parameter '{name}'{did_you_mean(near)}",
            file.document.location(span),
            subject=Subject("argument", name),
            kind="absent" if near is None else "near",
            doubts=doubted,
            candidates=(near,),
            related=related,
            fixes=rename_in(file.document, span, name, near),
        )
    if missing and not unknown:
        what, have = ("parameter", "has") if len(missing) == 1 else ("parameters", "have")
        yield rule.claim(
            f"call of macro '{macro.name}' lacks {what} {quoted(missing)}, which {have} no default",
            file.document.location(call.span),
            subject=Subject("name", macro.name),
            doubts=doubted,
            related=related,
        )
    needed = [each.name for each in macro.parameters if each.block and not each.has_default]
    if 0 <= call.blocks < len(needed):
        yield rule.claim(
            f"call of macro '{macro.name}' has {call.blocks} elements in it, and needs {len(needed)}: "
            f"{quoted(needed[call.blocks :])} is missing",
            file.document.location(call.span),
            subject=Subject("name", macro.name),
            doubts=doubted,
            related=related,
        )


def _is_call(call: Call, macro: Macro) -> bool:
    """Whether an element without the prefix is meant to call the macro."""
    if call.name in _OF_URDF or call.parent not in (*_WHERE, *_OF_ROBOT):
        return False
    given = frozenset(call.attributes)
    plain = [each for each in macro.parameters if not each.block]
    needed = {each.name for each in plain if not each.has_default}
    return needed <= given <= {each.name for each in plain}


def _is_call_of_unknown(call: Call) -> bool:
    """Whether an element that no robot has names a parent link and has an origin, as calls of macros for parts do."""
    known = call.name in _OF_URDF or call.parent not in _WHERE or ":" in call.name
    return not known and "parent" in call.attributes and call.placed


RULE = Rule(
    id="URD012",
    name="macro-call",
    effect="breaks",
    kind="absent",
    always=(Reason.NOT_GIVEN,),
    sometimes=("no-effect", Reason.OTHER_VERSION, Reason.MEANT_FOR_OTHER, Reason.EXPLAINED),
    what="Checks for the call of a xacro macro that lacks a parameter or block, or has a parameter that the macro does "
    "not know. An element that has the name and the parameters of a macro needs the prefix `xacro:`.",
    why="xacro stops with an error, and the robot has no description. An element without the prefix stays as it is, so "
    "the part is not there.",
    example='<xacro:macro name="wheel" params="prefix"/>\n<xacro:wheel prefx="left"/>',
    instead='<xacro:macro name="wheel" params="prefix"/>\n<xacro:wheel prefix="left"/>',
    references=(XACRO_PAGE,),
    check=check_nothing,
    of_description=_of_description,
)
