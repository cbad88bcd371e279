"""FRM001: a frame that a node asks for and nothing publishes."""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.findings.finding import Confidence, Finding, Severity
from preflight_analysis.frames.model import Frames
from preflight_analysis.frames.uses import OF_LOCALIZATION
from preflight_analysis.rules.frames import frames_of, place_of_mention, place_of_use
from preflight_analysis.rules.further_reading import FRAMES, TF2
from preflight_analysis.rules.missing_frames import MissingFrame, mentioned_slips, missing_frames
from preflight_analysis.rules.nearest import did_you_mean
from preflight_analysis.rules.problems import include_chain, rename
from preflight_analysis.rules.rule import Context, Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    frames = frames_of(context)
    mentioned = {mention.frame for mention in frames.mentions}
    for missing in missing_frames(context):
        use, near = missing.use, missing.near or missing.alike
        judged = _judged(frames, missing, use.frame in mentioned)
        if missing.elsewhere is not None or judged is None:
            continue
        severity, confidence = judged
        place = place_of_use(context, use)
        gaps = f"; {frames.gaps[0]}" if frames.gaps and near is None else ""
        if missing.root is not None:
            gaps = f"; the robot description begins with '{missing.root}'"
        yield rule.finding(
            f"frame '{use.written}' has no publisher: {use.does}{did_you_mean(near)}{gaps}",
            place,
            severity=severity,
            confidence=confidence,
            related=include_chain(use.node.origin) if use.param is None else (),
            fixes=rename(context, place, use.written, missing.near) if missing.near and use.param is not None else (),
        )
    yield from _of_drivers(rule, context)


def _of_drivers(rule: Rule, context: Context) -> Iterator[Finding]:
    for mention, near in mentioned_slips(context):
        place, written = place_of_mention(context, mention), str(mention.param.value)
        yield rule.finding(
            f"frame '{written}' has no publisher: {mention.node.name} has it (parameter '{mention.parameter}')"
            f"{did_you_mean(near)}",
            place,
            severity="info",
            confidence="possible",
            fixes=rename(context, place, written, near),
        )


def _judged(frames: Frames, missing: MissingFrame, is_mentioned: bool) -> tuple[Severity, Confidence] | None:
    """Severity and confidence; None where too much is unknown to speak."""
    use = missing.use
    if missing.near is not None:
        # What a robot includes and that is not here may have the frame itself.
        in_part = any(edge.robot is not None and edge.robot.description.lacks for edge in frames.edges)
        # What the text of a node tells is believed where all others are known.
        in_doubt = not use.sure or ((use.call or use.of_sensor) and not frames.complete)
        if is_mentioned or in_doubt or in_part:
            return "info", "possible"
        return "warning", "likely" if frames.complete else "possible"
    if missing.alike is not None:
        return "info", "possible"
    if is_mentioned or not any(edge.how == "urdf" and edge.sure for edge in frames.edges):
        return None  # what has no robot in it is started beside another launch
    if missing.root is not None and use.sure:
        # Whoever publishes it would have to join it with the root of the description.
        return ("warning", "likely") if frames.complete else ("info", "possible")
    if frames.complete and use.frame.rpartition("/")[2] in OF_LOCALIZATION:
        return "hint", "possible"  # localization is mostly started by itself
    if frames.complete:
        return "info", "likely" if use.sure and not use.call else "possible"
    in_launch = use.param is not None and not use.call and not use.of_sensor
    return ("hint", "possible") if in_launch and use.frame not in OF_LOCALIZATION else None


RULE = Rule(
    id="FRM001",
    name="frame-not-published",
    severity="warning",
    what="Checks for a frame that a node looks up and that nothing in the launch publishes: no robot description, no "
    "static transform, no node. A frame that is nearly the name of a published one is a warning. Otherwise it is "
    "information if all nodes are known, and a hint if not, or for `map` and `odom`. There is no finding in a launch "
    "without a robot description, which another launch file provides. `base_link` beside a description that begins "
    "with `base_footprint`, or the other way round, is a warning if all nodes are known, and information otherwise. "
    "The frame that a sensor writes into its messages counts, too: of a driver, of a simulated sensor, or in the "
    "source of a node. It is a warning if it is nearly the name of a published one and all nodes are known, and "
    "information otherwise. `laser_frame` beside `laser_link` is information.",
    why="The node waits for the transform, drops its data, or repeats `Could not transform ... frame does not exist`.",
    example="amcl:\n  ros__parameters:\n    base_frame_id: base_lnk",
    instead="amcl:\n  ros__parameters:\n    base_frame_id: base_link",
    references=(TF2, FRAMES),
    check=_check,
    of_robot=True,
    needs_graph=True,
    every_root=True,
)
