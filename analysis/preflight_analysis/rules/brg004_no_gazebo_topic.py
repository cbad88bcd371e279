"""BRG004: a bridge to a topic that nothing in Gazebo publishes or subscribes to.

How sensors and plugins name their topics: gz-sim and gz-sensors of gazebosim, by `knowledge/gazebo`.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding, Fix
from preflight_analysis.model.context import Context
from preflight_analysis.model.gazebo_bridges import Bridge
from preflight_analysis.model.gazebo_side import ANY, ENDS, Gazebo, GazeboTopic, gazebo_of, plain, to_gazebo
from preflight_analysis.model.nearest import is_slip
from preflight_analysis.model.problems import enumerated, include_chain, rename
from preflight_analysis.rules.further_reading import ROS_GZ_BRIDGE
from preflight_analysis.rules.rule import Rule

_BY_HAND = frozenset({"Twist", "Int32", "StringMsg", "Empty", "Boolean", "Double", "Float"})
"""What a plugin of Gazebo's window, or a person at a terminal, publishes."""
_SCOPES = ("world", "model", "link", "joint")
"""What the names of worlds, models, ... stand behind in the default names of topics."""
_WORDS = {"publishes": "publisher", "subscribes": "subscriber"}


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    gazebo = gazebo_of(context)
    if gazebo is None:
        return
    given = list(to_gazebo(context))
    bridged = {plain(each.gazebo_topic) for each in given}
    for bridge in given:
        type_ = bridge.gazebo.rpartition(".")[2]
        by_hand = bridge.direction == "GZ_TO_ROS" and type_ in _BY_HAND
        if by_hand or _is_one_of_several(bridge, given, gazebo) or gazebo.named(bridge.gazebo_topic, "BIDIRECTIONAL"):
            continue
        meant = _meant(bridge, type_, gazebo, bridged)
        if meant is None and not gazebo.whole:
            continue
        missing = " or ".join(_WORDS[each] for each in ENDS[bridge.direction])
        offered = f"; {_offered(meant)}" if meant is not None else ""
        yield rule.claim(
            f"'{bridge.gazebo_topic}' has no {missing} in Gazebo{offered}",
            bridge.gazebo_place,
            subject=Subject("topic", bridge.gazebo_topic),
            kind="absent" if meant is None else "near",
            doubts=doubts(PARTLY_READ=enumerated(gazebo.lacks), OUTSIDE=meant is None),
            candidates=(meant.name if meant is not None else None,),
            related=(*gazebo.related, *include_chain(bridge.node.origin)),
            fixes=_fixes(context, bridge, meant),
        )


def _is_one_of_several(bridge: Bridge, given: Sequence[Bridge], gazebo: Gazebo) -> bool:
    """Whether its topic in ROS is bridged to one that Gazebo has, too: a file for several worlds or robots."""
    others = (each for each in given if each.topic == bridge.topic and each.direction == bridge.direction)
    return any(gazebo.named(each.gazebo_topic, each.direction) for each in others if each is not bridge)


def _meant(bridge: Bridge, type_: str, gazebo: Gazebo, bridged: set[str]) -> GazeboTopic | None:
    """The topic of that type with a like name that no bridge carries; None where several are."""
    name = plain(bridge.gazebo_topic)
    found = [
        each
        for each in gazebo.topics
        if each.direction in ENDS[bridge.direction]
        and each.type == type_
        and each.name not in bridged
        and _is_alike(name, each.name)
    ]
    return found[0] if len({each.name for each in found}) == 1 else None


def _is_alike(name: str, other: str) -> bool:
    """Whether one is a slip of the other, or that within a world or model, or in another world, model or link."""
    if is_slip(name, other):
        return True
    mine, theirs = name.strip("/").split("/"), other.strip("/").split("/")
    if len(mine) != len(theirs):
        short, long = sorted((mine, theirs), key=len)
        *above, last = short
        return long[0] in _SCOPES and _is_same_word(last, long[-1]) and above == long[len(long) - len(short) : -1]
    pairs = list(zip(mine, theirs, strict=True))
    return len(mine) > len(_SCOPES) and all(
        a == b or ANY in (a, b) or (at and mine[at - 1] == theirs[at - 1] and mine[at - 1] in _SCOPES)
        for at, (a, b) in enumerate(pairs)
    )


def _is_same_word(word: str, other: str) -> bool:
    return word == other or is_slip(word, other)


def _offered(meant: GazeboTopic) -> str:
    verb = "publishes" if meant.direction == "publishes" else "subscribes to"
    return f"{meant.maker} {verb} '{meant.name}'"


def _fixes(context: Context, bridge: Bridge, meant: GazeboTopic | None) -> tuple[Fix, ...]:
    if meant is None or not meant.is_certain or not bridge.has_own_name:
        return ()
    return rename(context, bridge.gazebo_place, bridge.gazebo_topic, meant.name)


RULE = Rule(
    id="BRG004",
    name="no-gazebo-topic",
    effect="breaks",
    kind="near",
    always=(Reason.LIBRARY,),
    sometimes=(Reason.PARTLY_READ, Reason.OUTSIDE),
    what="Checks for a topic of `ros_gz_bridge` that neither a sensor nor a plugin of Gazebo has. The world and the "
    "robots that the launch spawns tell which topics there are.",
    why="The bridge reports no error, and no message arrives.",
    example="# <plugin filename=\"gz-sim-diff-drive-system\"> without <topic>, in the model 'bot'\n"
    "- ros_topic_name: /cmd_vel\n  gz_topic_name: /cmd_vel\n  ros_type_name: geometry_msgs/msg/Twist\n"
    "  gz_type_name: gz.msgs.Twist\n  direction: ROS_TO_GZ",
    instead="- ros_topic_name: /cmd_vel\n  gz_topic_name: /model/bot/cmd_vel\n"
    "  ros_type_name: geometry_msgs/msg/Twist\n  gz_type_name: gz.msgs.Twist\n  direction: ROS_TO_GZ",
    references=(ROS_GZ_BRIDGE,),
    generations=(2,),
    check=_check,
    every_root=True,
)
