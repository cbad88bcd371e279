"""FRM003: a frame whose prefix or namespace differs between its publisher and its user."""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.findings.claim import Subject, say
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding, Related
from preflight_analysis.model.context import Context
from preflight_analysis.model.frames import place_of_edge, place_of_use
from preflight_analysis.model.missing_frames import missing_frames
from preflight_analysis.model.problems import include_chain
from preflight_analysis.rules.further_reading import FRAMES, TF2
from preflight_analysis.rules.rule import Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for missing in missing_frames(context):
        use, edge = missing.use, missing.elsewhere
        if edge is None or use.of_sensor:
            continue
        if edge.space != use.space:
            told = "published on '{published}/tf', and {node} listens to '{space}/tf' ({what})"
            published = edge.space
        else:
            ends = (edge.child, edge.parent)
            published = next(end for end in ends if end.endswith(use.frame) or _ends_with(use.frame, end))
            told = "published as '{published}': {node} uses it ({what})"
            if len(published) == len(use.frame) - 1:
                told += "; 'frame_prefix' lacks the '/' at its end"
        values = {"frame": use.frame, "node": use.node.name, "space": use.space, "what": use.what}
        yield rule.claim(
            say("frame '{frame}' is " + told, published=published, **values),
            place_of_use(context, use),
            subject=Subject("frame", use.frame),
            doubts=doubts(ASSUMED=not use.sure or bool(use.call)),
            related=(
                Related(f"published by {edge.by}", place_of_edge(context, edge)),
                *(include_chain(use.node.origin) if use.param is None else ()),
            ),
        )


def _ends_with(frame: str, end: str) -> bool:
    """Whether a frame is the other one behind a prefix, or has a slash behind the prefix that the other one lacks."""
    return frame.endswith(end) or frame.replace("/", "", 1) == end


RULE = Rule(
    id="FRM003",
    name="frame-prefix",
    effect="breaks",
    kind="conflict",
    always=(Reason.LIBRARY,),
    sometimes=(Reason.ASSUMED,),
    what="Checks for a frame that a node looks up without the prefix under which it is published, or with one: "
    "`frame_prefix` or `tf_prefix`. So it does for a frame in another namespace of `/tf`.",
    why="`base_link` and `robot1/base_link` are different frames, and `/tf` and `/robot1/tf` are different topics. The "
    "node finds no transform.",
    example="# robot_state_publisher has frame_prefix: robot1/\namcl:\n  ros__parameters:\n"
    "    base_frame_id: base_link",
    instead="amcl:\n  ros__parameters:\n    base_frame_id: robot1/base_link",
    references=(TF2, FRAMES),
    check=_check,
    every_root=True,
)
