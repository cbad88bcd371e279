"""LCH004: an element that roslaunch does not know."""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding, Fix
from preflight_analysis.launch.problems import UnknownElement
from preflight_analysis.model.context import Context
from preflight_analysis.model.installed import has_ros
from preflight_analysis.model.nearest import did_you_mean, nearest
from preflight_analysis.model.problems import fix, problems_of
from preflight_analysis.model.syntax import Tags
from preflight_analysis.rules.further_reading import LAUNCH_XML_DESIGN, ROSLAUNCH
from preflight_analysis.rules.problems import problem_claim
from preflight_analysis.rules.rule import Rule

_OF_OTHERS = {"rtactivate": "rtmlaunch", "rtconnect": "rtmlaunch"}
"""Tags of launchers that use roslaunch's files (https://wiki.ros.org/openrtm_tools)."""


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    tags = Tags(context.launch_files)
    for problem in problems_of(context, UnknownElement):
        name = problem.kind.tag
        near = nearest(name, problem.kind.allowed)
        message = f"unknown element <{name}> in <{problem.kind.parent}>"
        if not problem.fatal:
            message += "; roslaunch skips it"
        elif near is None:
            message += "; no package here extends launch with it"
        message += did_you_mean(near)
        fixes: tuple[Fix, ...] = ()
        if near is not None:
            tag, writer = tags.named_at(problem.location), context.writer(problem.location.file)
            if tag is not None and writer is not None:
                edits = writer.rename_element(tag.action, near)
            else:
                edits = writer.replace(problem.location.span, near) if writer is not None else ()
            fixes = fix(f"Replace '{name}' with '{near}'", edits, preferred=True)
        launcher = _OF_OTHERS.get(name)
        if launcher is not None:
            message += f"; {launcher} reads it"
        # Another package may extend launch.
        unseen = problem.fatal and near is None
        yield problem_claim(
            rule,
            problem,
            message,
            subject=Subject("element", name),
            kind="near" if near is not None else "invalid",
            effect="style" if launcher is not None else None,
            doubts=doubts(UNSEEN=unseen, NOT_HERE="ROS" if unseen and not has_ros(context) else ""),
            candidates=(near,),
            fixes=fixes,
        )


RULE = Rule(
    id="LCH004",
    name="unknown-element",
    effect="no-effect",
    kind="near",
    sometimes=("stops-launch", "style", Reason.UNSEEN, Reason.NOT_HERE),
    what="Checks for an element that is not valid in its parent. The finding names the nearest valid element.",
    why="`roslaunch` prints one line among many others and skips the element with its content. The parameter is not "
    "set, or the node is not started. `ros2 launch` stops and starts nothing from the file. A package with the entry "
    "point `launch.frontend.launch_extension` can define further tags. The tags of the workspace and of the sourced "
    "ROS are known.",
    example='<node pkg="camera" type="driver" name="camera">\n  <parm name="rate" value="30"/>\n</node>',
    instead='<node pkg="camera" type="driver" name="camera">\n  <param name="rate" value="30"/>\n</node>',
    references=(
        ROSLAUNCH,
        LAUNCH_XML_DESIGN,
    ),
    check=_check,
    problems=(UnknownElement,),
)
