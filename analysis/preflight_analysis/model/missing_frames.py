"""Frames that a node asks for and nothing is known to publish: what may be meant."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Mapping
from collections.abc import Set as AbstractSet
from typing import NamedTuple

from preflight_analysis.frames.edges import is_state_publisher, prefix_of
from preflight_analysis.frames.model import Edge, Frames, Mention, Use
from preflight_analysis.frames.uses import OF_SENSOR
from preflight_analysis.incremental.derived import derived
from preflight_analysis.model.context import Context
from preflight_analysis.model.frames import frames_of
from preflight_analysis.model.nearest import nearest_slip

_LAST_WORDS = re.compile(r"(?:_?(?:link|frame|optical|sensor|id))+\Z")


_BASES = frozenset(("base", "base_footprint", "base_link"))
"""Frames of REP 105 and REP 120 that a robot description has."""


class MissingFrame(NamedTuple):
    """A frame that is asked for where nothing publishes it. `elsewhere` has it with or without a prefix, or in another
    namespace of `/tf`; `near` is a frame of which it is a slip; `alike`, of a sensor, the only one with the same
    name but for its last words (`laser_frame`, `laser_link`); `root`, of the base of a robot, the one that its
    description has."""

    use: Use
    elsewhere: Edge | None
    near: str | None
    alike: str | None = None
    root: str | None = None


def missing_frames(context: Context) -> tuple[MissingFrame, ...]:
    """Each use once; the same objects each time."""
    return _missing(context)


@derived
def _missing(context: Context) -> tuple[MissingFrame, ...]:
    frames = frames_of(context)
    if not frames.edges:
        return ()
    prefixes = _prefixes(context)
    found: dict[tuple[str, int, str], MissingFrame] = {}
    for use in frames.uses:
        if not (use.looked_up or use.of_sensor) or use.frame in frames.names(use.space):
            continue
        elsewhere = next(_elsewhere(frames, use, prefixes), None)
        near = _near(frames, use) if elsewhere is None else None
        alike = _alike(frames, use) if use.of_sensor and elsewhere is None and near is None else None
        root = _root(frames, use) if elsewhere is None and near is None else None
        found.setdefault((use.frame, id(use.node), use.what), MissingFrame(use, elsewhere, near, alike, root))
    return tuple(found.values())


def mentioned_slips(context: Context) -> Iterator[tuple[Mention, str]]:
    """The frames of sensors in the parameters of nodes of which nothing is known, that are a slip of a link or of its
    like, each with that. Who broadcasts the frame itself may call it so."""
    frames = frames_of(context)
    links: dict[str, set[str]] = {}
    for edge in frames.edges:
        if edge.how == "urdf":
            links.setdefault(edge.space, set()).add(edge.child)
    if not links:
        return
    counts = Counter([mention.frame for mention in frames.mentions])
    for mention, near in zip(frames.mentions, context.each(_meant_link, frames.mentions, links), strict=True):
        # What two nodes name is no slip of the keyboard.
        if near is not None and counts[mention.frame] == 1 and mention.frame not in frames.names(mention.space):
            yield mention, near


def _meant_link(mention: Mention, links: Mapping[str, AbstractSet[str]]) -> str | None:
    """The link that the frame of a sensor is a slip of."""
    is_of_sensor = mention.parameter.rpartition(".")[2] in OF_SENSOR
    return nearest_slip(mention.frame, links.get(mention.space, ())) if is_of_sensor else None


def _prefixes(context: Context) -> frozenset[str]:
    tree = context.tree
    prefixes = (prefix_of(node, tree) for node in tree.nodes if is_state_publisher(node))
    return frozenset(filter(None, prefixes))


def _elsewhere(frames: Frames, use: Use, prefixes: frozenset[str]) -> Iterator[Edge]:
    """The transforms that have the frame under another prefix, or elsewhere."""
    own = {f"{prefix}{use.frame}" for prefix in prefixes}
    # Without the prefix; a whole namespace may be one.
    own |= {use.frame.removeprefix(prefix) for prefix in prefixes} | {use.frame.partition("/")[2]}
    # A prefix stands before the name as it is given.
    own |= {f"{prefix}{name}" for prefix in prefixes if (name := use.frame.removeprefix(f"{prefix}/")) != use.frame}
    for edge in frames.edges:
        ends = (edge.child, edge.parent)
        if edge.sure and ((edge.space == use.space and not own.isdisjoint(ends)) or use.frame in ends):
            yield edge


def _near(frames: Frames, use: Use) -> str | None:
    return nearest_slip(use.frame, frames.names(use.space))


def _root(frames: Frames, use: Use) -> str | None:
    """The root of the robot description, where a parameter asks for another frame of the robot's base."""
    root = frames.robot_root(use.space)
    return root if root is not None and use.looked_up and not use.call and is_base_beside(use.frame, root) else None


def is_base_beside(frame: str, root: str) -> bool:
    """Whether a frame is the base of a robot by its name, with the prefix that the root of the description has."""
    prefix, _, name = frame.rpartition("/")
    return name in _BASES and prefix == root.rpartition("/")[0]


def _alike(frames: Frames, use: Use) -> str | None:
    stem = _LAST_WORDS.sub("", use.frame.lower())
    found = [each for each in frames.names(use.space) if stem and _LAST_WORDS.sub("", each.lower()) == stem]
    return found[0] if len(found) == 1 else None
