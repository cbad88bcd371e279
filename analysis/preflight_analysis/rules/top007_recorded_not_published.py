"""TOP007: a recorder is given the name of a topic that nobody publishes."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.findings.claim import Subject, say
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding
from preflight_analysis.graph.build import effective_remaps
from preflight_analysis.graph.model import Graph
from preflight_analysis.model.context import Context
from preflight_analysis.model.nearest import is_slip
from preflight_analysis.model.places import argument_location, related_endpoint
from preflight_analysis.model.problems import include_chain, rename
from preflight_analysis.model.reach import meant_by_text
from preflight_analysis.rules.further_reading import ROSBAG, ROSBAG2
from preflight_analysis.rules.rule import Rule
from preflight_analysis.tracing.request import split_args

_SAID = "recorded topic '{name}' has no publisher in this launch; did you mean '{near}', published by {node}?"
_FLAG = re.compile(
    r"-[ahqpj]+|--(?:all(?:-topics|-services|-actions)?|bz2|lz4|quiet|publish|split|tcpnodelay|udp|repeat-latched|help"
    r"|include-\S+|no-discovery|use-sim-time|snapshot|snapshot-mode|start-paused|topics)"
)
"""Options without a value, after which topics may follow."""
_SEVERAL = ("--services", "--actions", "--topic-types")
"""Options that take all words up to the next one."""
_CONVENTIONS = ("compressed", "compressedDepth", "theora", "camera_info", "parameter_descriptions", "parameter_updates")
"""Last parts of names that image_transport, drivers of cameras and dynamic_reconfigure make."""
_PATTERNS = ("-e", "--regex")


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    graph, nodes = context.graph, context.tree.nodes
    if graph is None:
        return
    for node, recorded in zip(nodes, context.each(_recorded, nodes, context.tree.generation), strict=True):
        for written, topic in recorded:
            provider = meant_by_text(context, topic, "publisher") if not node.unknowns else None
            if provider is None:
                yield from _of_convention(rule, context, graph, node, written, topic)
                continue
            place, known = argument_location(context, node, written), graph.likely_complete_beside(node)
            near = provider.name
            yield rule.claim(
                say(_SAID, name=topic, near=near, node=provider.node.name),
                place,
                subject=Subject("topic", topic),
                doubts=doubts(OUTSIDE=not known, NOT_ANALYSED=not known),
                candidates=(near,),
                related=(related_endpoint(provider, "publishes"), *include_chain(node.origin)),
                fixes=rename(context, place, written.lstrip("/"), near.lstrip("/")) if written == topic else (),
            )


def _of_convention(
    rule: Rule, context: Context, graph: Graph, node: LaunchNode, written: str, topic: str
) -> Iterator[Finding]:
    """Of a name that ends in a slip of what libraries always call so, whoever publishes it."""
    leaf = names.leaf(topic)
    meant = next((each for each in _CONVENTIONS if leaf != each and is_slip(leaf, each)), None)
    if meant is None or leaf in _CONVENTIONS or topic in graph.topics:
        return
    place = argument_location(context, node, written)
    yield rule.claim(
        f"recorded topic '{topic}' ends in '{leaf}'; did you mean '{meant}'?",
        place,
        subject=Subject("topic", topic),
        candidates=(meant,),
        related=include_chain(node.origin),
        fixes=rename(context, place, leaf, meant),
    )


def _recorded(node: LaunchNode, generation: int) -> tuple[tuple[str, str], ...]:
    return tuple(_recorded_by(node, generation))


def _recorded_by(node: LaunchNode, generation: int) -> Iterator[tuple[str, str]]:
    """The topics that a recorder is given, as written and in full: `rosbag record`, or a process `ros2 bag record`."""
    words = split_args(node.args)
    if "record" not in (node.executable, *words[1:2]):
        return
    if (node.package, node.executable) == ("rosbag", "record"):
        remaps = {source: target for source, (_, target) in effective_remaps(node, generation).items()}
        for word in _topics(words):
            full = names.resolve(word, node.name)
            yield word, remaps.get(full, full)
    elif node.kind == "process" and (node.executable, *words[:2]) == ("ros2", "bag", "record"):
        yield from ((word, names.canonicalize(f"/{word}")) for word in _topics(words[2:]) if not word.startswith("~"))


def _topics(words: Sequence[str]) -> Iterator[str]:
    """The topics among the arguments; patterns and all topics name none."""
    if any(word in _PATTERNS for word in words):
        return
    skipped, several = False, False
    for word in words:
        if word.startswith("-"):
            several = word in _SEVERAL or word.startswith("--exclude-")
            skipped = not several and "=" not in word and _FLAG.fullmatch(word) is None
        elif skipped:
            skipped = False
        elif not several and word and names.is_legal(word):
            yield word


RULE = Rule(
    id="TOP007",
    name="recorded-not-published",
    effect="misbehaves",
    kind="near",
    always=(Reason.UNSEEN,),
    sometimes=(Reason.OUTSIDE, Reason.NOT_ANALYSED),
    what="Checks for a recorded topic of `rosbag record` or `ros2 bag record` that the launch lacks, while a node "
    "publishes one of a similar name. It also checks for a typo in a last part that libraries give.",
    why="The recorder waits for the topic without an error, and the recording lacks it.",
    example='<node pkg="rosbag" type="record" name="record" args="/scna /odom"/>',
    instead='<node pkg="rosbag" type="record" name="record" args="/scan /odom"/>',
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
