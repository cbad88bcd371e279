"""FRM003: a frame whose prefix or namespace differs between its publisher and its user."""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.findings.finding import Finding, Related
from preflight_analysis.rules.frames import place_of_edge, place_of_use
from preflight_analysis.rules.further_reading import FRAMES, TF2
from preflight_analysis.rules.missing_frames import missing_frames
from preflight_analysis.rules.problems import include_chain
from preflight_analysis.rules.rule import Context, Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for missing in missing_frames(context):
        use, edge = missing.use, missing.elsewhere
        if edge is None or use.of_sensor:
            continue
        if edge.space != use.space:
            message = (
                f"frame '{use.frame}' is published on '{edge.space}/tf', and {use.node.name} listens to "
                f"'{use.space}/tf' ({use.what})"
            )
        else:
            ends = (edge.child, edge.parent)
            published = next(end for end in ends if end.endswith(use.frame) or _ends_with(use.frame, end))
            message = f"frame '{use.frame}' is published as '{published}': {use.node.name} uses it ({use.what})"
            if len(published) == len(use.frame) - 1:
                message += "; 'frame_prefix' lacks the '/' at its end"
        known = use.sure and not use.call
        yield rule.finding(
            message,
            place_of_use(context, use),
            confidence="likely" if known else "possible",
            severity=None if known else "info",
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
    severity="warning",
    what="Checks for a frame that a node looks up without the prefix under which it is published, or with one: "
    "`frame_prefix` of `robot_state_publisher` in ROS 2, `tf_prefix` in ROS 1. It also checks for a frame that is "
    "published in another namespace of `/tf`, by a remap of `/tf` to `tf`. `frame_prefix` needs a slash at its end: "
    "with `robot1` instead of `robot1/` the link is `robot1base_link`.",
    why="`base_link` and `robot1/base_link` are different frames, and `/tf` and `/robot1/tf` are different topics. The "
    "node finds no transform.",
    example="# robot_state_publisher has frame_prefix: robot1/\namcl:\n  ros__parameters:\n"
    "    base_frame_id: base_link",
    instead="amcl:\n  ros__parameters:\n    base_frame_id: robot1/base_link",
    references=(TF2, FRAMES),
    check=_check,
    every_root=True,
)
