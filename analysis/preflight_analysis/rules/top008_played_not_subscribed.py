"""TOP008: a player of a recording is given the name of a topic that nobody subscribes to."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.findings.claim import Subject, say
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding
from preflight_analysis.graph.build import effective_remaps
from preflight_analysis.model.context import Context
from preflight_analysis.model.places import argument_location, related_endpoint
from preflight_analysis.model.problems import include_chain, rename
from preflight_analysis.model.reach import meant_by_text
from preflight_analysis.rules.further_reading import ROSBAG, ROSBAG2
from preflight_analysis.rules.rule import Rule
from preflight_analysis.tracing.request import split_args

_SAID = (
    "played topic '{name}' has no subscriber in this launch; did you mean '{near}' (subscriber: {node}, no publisher)?"
)
_PREFIX = ("-p", "--prefix")
"""Of a text that goes in front of all names (ROS 1)."""
_REMAPS = ("-m", "--remap")
"""Before names of the recording with others for them (ROS 2); in ROS 1 these may stand anywhere."""


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    graph, nodes = context.graph, context.tree.nodes
    if graph is None:
        return
    for node, played in zip(nodes, context.each(_played, nodes, context.tree.generation), strict=True):
        for written, topic in played:
            consumer = meant_by_text(context, topic, "subscriber")
            if consumer is None:
                continue
            place = argument_location(context, node, written)
            known = graph.likely_complete_beside(node)
            yield rule.claim(
                say(_SAID, name=topic, near=consumer.name, node=consumer.node.name),
                place,
                subject=Subject("topic", topic),
                doubts=doubts(OUTSIDE=not known, NOT_ANALYSED=not known),
                candidates=(consumer.name,),
                related=(related_endpoint(consumer, "subscribes to"), *include_chain(node.origin)),
                fixes=rename(context, place, written.lstrip("/"), consumer.name.lstrip("/")),
            )


def _played(node: LaunchNode, generation: int) -> tuple[tuple[str, str], ...]:
    """The topics that a player is told to play, as written and in full: those after `--topics`, by the names that they
    are played under, and the names that topics of the recording are given."""
    words = split_args(node.args)
    if (
        node.unknowns
        or "play" not in (node.executable, *words[1:2])
        or any(word.partition("=")[0] in _PREFIX for word in words)
    ):
        return ()
    if (node.package, node.executable) == ("rosbag", "play"):
        renamed = _renamed(words)
        outer = {source: target for source, (_, target) in effective_remaps(node, generation).items()}
    elif node.kind == "process" and (node.executable, *words[:2]) == ("ros2", "bag", "play"):
        words = words[2:]
        renamed = _renamed(_after(words, _REMAPS))
        outer = {}
    else:
        return ()
    topics = [topic for topic in _after(words, ("--topics",)) if topic not in renamed]
    full = (
        (word, names.resolve(word, node.name)) for word in (*topics, *renamed.values()) if word and names.is_legal(word)
    )
    return tuple((word, outer.get(name, name)) for word, name in full)


def _renamed(words: Sequence[str]) -> Mapping[str, str]:
    """Names with what they are played under; private ones are parameters."""
    pairs = (word.split(":=", 1) for word in words if ":=" in word)
    return {source: target for source, target in pairs if not source.startswith("_")}


def _after(words: Sequence[str], options: Sequence[str]) -> list[str]:
    """The words that follow one of the options up to the next one."""
    found: list[str] = []
    listed = False
    for word in words:
        if word.startswith("-"):
            listed = word in options
        elif listed and (":=" in word) == (options is _REMAPS):
            found.append(word)
    return found


RULE = Rule(
    id="TOP008",
    name="played-not-subscribed",
    effect="misbehaves",
    kind="near",
    always=(Reason.UNSEEN,),
    sometimes=(Reason.OUTSIDE, Reason.NOT_ANALYSED),
    what="Checks for a topic in the arguments of `rosbag play` or `ros2 bag play` that no node of the launch "
    "subscribes to. A node subscribes to a topic of a similar name that has no publisher.",
    why="The recording is played and the node waits for its messages. No tool reports that the names differ.",
    example='<node pkg="rosbag" type="play" name="play" args="run.bag laser:=/scna"/>',
    instead='<node pkg="rosbag" type="play" name="play" args="run.bag laser:=/scan"/>',
    references=(
        ROSBAG,
        ROSBAG2,
    ),
    settings=(
        "external",
        "nodes",
    ),
    check=_check,
    needs_graph=True,
    every_root=True,
)
