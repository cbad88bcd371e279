"""FRM001: a frame that a node asks for and nothing publishes."""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.findings.claim import Subject, say
from preflight_analysis.findings.doubt import Doubt, Reason, doubts
from preflight_analysis.findings.finding import Finding
from preflight_analysis.frames.model import Frames
from preflight_analysis.frames.uses import OF_LOCALIZATION
from preflight_analysis.model.context import Context
from preflight_analysis.model.frames import frames_of, in_words, place_of_mention, place_of_use
from preflight_analysis.model.missing_frames import MissingFrame, mentioned_slips, missing_frames
from preflight_analysis.model.nearest import did_you_mean
from preflight_analysis.model.problems import include_chain, rename
from preflight_analysis.rules.further_reading import FRAMES, TF2
from preflight_analysis.rules.rule import Rule

_SAID = "frame '{frame}' has no publisher: {node}{does}{near}{root}{aside}"


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    frames = frames_of(context)
    mentioned = {mention.frame for mention in frames.mentions}
    for missing in missing_frames(context):
        use, near = missing.use, missing.near or missing.alike
        why = _doubts(frames, missing, use.frame in mentioned)
        if missing.elsewhere is not None or why is None:
            continue
        place, meant, root, gaps = place_of_use(context, use), did_you_mean(near), "", ""
        if missing.root is not None:
            root = f"; the robot description begins with '{missing.root}'"
        elif frames.gaps and near is None:
            gaps = f"; {frames.gaps[0]}"
        yield rule.claim(
            say(_SAID, frame=use.written, near=meant, root=root, aside=gaps, **in_words(use)),
            place,
            subject=Subject("frame", use.frame),
            kind="absent" if near is None else "near",
            doubts=why,
            candidates=(near or missing.root,),
            related=include_chain(use.node.origin) if use.param is None else (),
            fixes=rename(context, place, use.written, missing.near) if missing.near and use.param is not None else (),
        )
    yield from _of_drivers(rule, context)


def _of_drivers(rule: Rule, context: Context) -> Iterator[Finding]:
    for mention, near in mentioned_slips(context):
        place, written = place_of_mention(context, mention), str(mention.param.value)
        does, meant = f" has it (parameter '{mention.parameter}')", did_you_mean(near)
        yield rule.claim(
            say(_SAID, frame=written, node=mention.node.name, does=does, near=meant, root="", aside=""),
            place,
            subject=Subject("frame", mention.frame),
            doubts=doubts(ASSUMED=True),
            candidates=(near,),
            fixes=rename(context, place, written, near),
        )


def _doubts(frames: Frames, missing: MissingFrame, is_mentioned: bool) -> tuple[Doubt, ...] | None:
    """None where too much is unknown to speak."""
    use, complete = missing.use, frames.complete
    if missing.near is not None:
        # What a robot includes and that is not here may have the frame itself.
        in_part = any(edge.robot is not None and edge.robot.description.lacks for edge in frames.edges)
        # What the text of a node tells is believed where all others are known.
        in_doubt = not use.sure or ((use.call or use.of_sensor) and not complete)
        return doubts(PARTLY_READ=in_part, ASSUMED=is_mentioned or in_doubt, NOT_ANALYSED=not complete)
    if missing.alike is not None:
        return doubts(ASSUMED=True)
    if is_mentioned or not any(edge.how == "urdf" and edge.sure for edge in frames.edges):
        return None  # what has no robot in it is started beside another launch
    if missing.root is not None and use.sure:
        # Whoever publishes it would have to join it with the root of the description.
        return doubts(PARTLY_READ=not complete, NOT_ANALYSED=not complete)
    if complete:
        # Localization is mostly started by itself.
        return doubts(OTHER_LAUNCH=use.frame.rpartition("/")[2] in OF_LOCALIZATION, OUTSIDE=True)
    in_launch = use.param is not None and not use.call and not use.of_sensor
    known = in_launch and use.frame not in OF_LOCALIZATION
    return doubts(OTHER_LAUNCH=True, NOT_ANALYSED=True) if known else None


RULE = Rule(
    id="FRM001",
    name="frame-not-published",
    effect="breaks",
    kind="near",
    always=(Reason.LIBRARY,),
    sometimes=(Reason.OTHER_LAUNCH, Reason.OUTSIDE, Reason.NOT_ANALYSED, Reason.ASSUMED, Reason.PARTLY_READ),
    what="Checks for a frame that a node looks up, or that a sensor writes into its messages, and that nothing in the "
    "launch publishes. A launch without a robot description is checked for similar names only.",
    why="The node waits for the transform, drops its data, or repeats `Could not transform ... frame does not exist`.",
    example="amcl:\n  ros__parameters:\n    base_frame_id: base_lnk",
    instead="amcl:\n  ros__parameters:\n    base_frame_id: base_link",
    references=(TF2, FRAMES),
    check=_check,
    of_robot=True,
    needs_graph=True,
    every_root=True,
)
