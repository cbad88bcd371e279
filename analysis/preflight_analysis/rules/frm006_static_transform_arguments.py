"""FRM006: arguments that a static transform publisher refuses, or from which it publishes something else.

https://github.com/ros2/geometry2/blob/humble/tf2_ros/src/static_transform_broadcaster_program.cpp,
https://github.com/ros/geometry2/blob/noetic-devel/tf2_ros/src/static_transform_broadcaster_program.cpp,
https://github.com/ros/geometry/blob/noetic-devel/tf/src/static_transform_publisher.cpp
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

from preflight_analysis.findings.claim import Effect, Subject, say
from preflight_analysis.findings.finding import Finding
from preflight_analysis.graph.tf_frames import begins_with_number, static_transform_words
from preflight_analysis.model.context import Context
from preflight_analysis.model.nearest import did_you_mean, nearest
from preflight_analysis.model.places import argument_location, attribute_location
from preflight_analysis.model.problems import include_chain
from preflight_analysis.rules.further_reading import FRAMES, TF2
from preflight_analysis.rules.rule import Rule

_EULER, _QUATERNION = ("--roll", "--pitch", "--yaw"), ("--qx", "--qy", "--qz", "--qw")
_FRAMES = ("--frame-id", "--child-frame-id")
_OPTIONS = (*_FRAMES, "--x", "--y", "--z", *_EULER, *_QUATERNION)
_HELP = ("--help", "-h")
_WITHOUT_OPTIONS = frozenset(("ardent", "bouncy", "crystal", "dashing", "eloquent", "foxy", "galactic"))
_OPTIONS_ALONE = frozenset(("lyrical", "rolling"))
"""https://github.com/ros2/geometry2/pull/790"""
_NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?\Z", re.IGNORECASE)
_CUT_OFF = re.compile(r"([-+]?\d*\.\d*)\.")
"""What is read of `0.0.3`."""
_TOLERANCE = 10e-3
"""How far the square of a quaternion's length may be from 1 (`QUATERNION_NORMALIZATION_TOLERANCE` of tf2)."""
_FORM = "'x y z yaw pitch roll frame_id child_frame_id'"
_WHOLE_FORM = f"{_FORM}, or a quaternion 'qx qy qz qw' for the angles"
_WHOLE_FORM_OF_TF = "'x y z yaw pitch roll frame_id child_frame_id period', or a quaternion for the angles"


class _Fault(NamedTuple):
    """What is wrong. `word` is the argument that has it, empty where it is all of them."""

    why: str
    word: str = ""
    effect: Effect = "stops-node"


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for node in context.tree.nodes:
        words = static_transform_words(node) if not node.unknowns else None
        if words is None:
            continue
        if not context.tree.ros.own_parameters:
            fault = _of_tf(words) if node.package == "tf" else _of_tf2(words)
        else:
            fault = _of_ros2(words, context.environment.distro) if node.package == "tf2_ros" else None
        if fault is not None:
            yield rule.claim(
                say("{node} {why}", node=node.name, why=fault.why),
                argument_location(context, node, fault.word)
                if fault.word
                else attribute_location(context, node, "args"),
                subject=Subject("node", node.name),
                effect=fault.effect,
                related=include_chain(node.origin),
            )


def _of_tf(words: Sequence[str]) -> _Fault | None:
    """ROS 1, package tf: the last word is a period."""
    if len(words) not in (9, 10):
        lacks = "the period in milliseconds is missing" if len(words) == 8 else f"expected {_WHOLE_FORM_OF_TF}"
        return _Fault(f"exits: static_transform_publisher of tf gets {len(words)} arguments; {lacks}")
    *numbers, parent, child, period = words
    if not begins_with_number(period):
        return _Fault(
            f"publishes the frame '{child}' below '{parent}': the period in milliseconds is missing behind '{period}'",
            period,
            "breaks",
        )
    return _of_numbers(numbers) or _of_frames(parent, child)


def _of_tf2(words: Sequence[str]) -> _Fault | None:
    """ROS 1, package tf2_ros."""
    if len(words) == 1:
        return None  # the name of a parameter that has the transform
    if len(words) not in (8, 9):
        expected = f"tf2 has no period, remove '{words[-1]}'" if len(words) == 10 else f"expected {_WHOLE_FORM}"
        return _Fault(f"exits: static_transform_publisher gets {len(words)} arguments; {expected}")
    *numbers, parent, child = words
    if len(words) == 9 and not begins_with_number(words[6]) and begins_with_number(child):
        return _Fault(
            f"publishes the frame '{child}' below '{parent}': tf2 has no period, so it takes '{words[6]}' for a number "
            "of a quaternion",
            child,
            "breaks",
        )
    return _of_numbers(numbers) or _of_frames(parent, child)


def _of_numbers(numbers: Sequence[str]) -> _Fault | None:
    """ROS 1 takes what is no number for 0, and as much as it can read of the rest."""
    for word in numbers:
        if not begins_with_number(word):
            return _Fault(f"uses 0 for '{word}', which is not a number", word, "misbehaves")
        if (cut := _CUT_OFF.match(word)) is not None:
            return _Fault(f"uses {cut[1]} for '{word}', which is not a number", word, "misbehaves")
    return _of_quaternion(numbers[3:]) if len(numbers) == 7 else None


def _of_quaternion(words: Sequence[str]) -> _Fault | None:
    if not all(_NUMBER.match(word) for word in words):
        return None
    square = sum(float(word) ** 2 for word in words)
    if abs(square - 1) <= _TOLERANCE:
        return None
    why = f"publishes a transform that tf2 ignores: the length of the quaternion '{' '.join(words)}' is not 1"
    return _Fault(why, words[0], "breaks")


def _of_frames(parent: str, child: str) -> _Fault | None:
    same = parent == child and bool(parent)
    why = f"publishes nothing: '{parent}' is both the parent and the child frame"
    return _Fault(why, parent, "breaks") if same else None


def _of_ros2(words: Sequence[str], distro: str | None) -> _Fault | None:
    given, rest = dict[str, str](), list[str]()
    names = iter(words)
    for word in names:
        if word in _HELP:
            return None
        if word not in _OPTIONS:
            rest.append(word)
            continue
        value = next(names, None)
        if value is None:
            return _Fault(f"exits: '{word}' lacks its value", word)
        given[word] = value
    if given and distro in _WITHOUT_OPTIONS:
        return _Fault(
            f"exits: static_transform_publisher of {distro.capitalize()} has no option '{next(iter(given))}'; "
            f"write {_FORM}",
            next(iter(given)),
        )
    if distro in _OPTIONS_ALONE and rest and not given:
        return _Fault(
            f"exits: static_transform_publisher of {distro.capitalize()} takes options alone, such as "
            "'--frame-id' and '--child-frame-id'",
            rest[0],
        )
    return _of_options(given, rest) if given or len(rest) not in (8, 9) else _of_positions(rest)


def _of_options(given: Mapping[str, str], rest: Sequence[str]) -> _Fault | None:
    if rest and not given:
        if all(len(word) == 1 for word in rest):
            return None  # a text where a list belongs, LCH041 reports it
        return _Fault(f"exits: static_transform_publisher gets {len(rest)} arguments; expected {_WHOLE_FORM}")
    if rest:
        near = nearest(rest[0], _OPTIONS) if rest[0].startswith("-") and rest[0] != "--" else None
        return _Fault(f"exits: static_transform_publisher has no argument '{rest[0]}'{did_you_mean(near)}", rest[0])
    for name, value in given.items():
        if name not in _FRAMES and not begins_with_number(value):
            return _Fault(f"exits: '{value}' is not a number ('{name}')", value)
    euler = next((name for name in _EULER if name in given), None)
    quaternion = next((name for name in _QUATERNION if name in given), None)
    if euler is not None and quaternion is not None:
        return _Fault(f"exits: it gets both a quaternion ('{quaternion}') and angles ('{euler}')", quaternion)
    lacking = next((name for name in _FRAMES if not given.get(name)), None)
    if lacking is not None:
        return _Fault(f"exits: '{lacking}' is missing")
    if quaternion is not None:
        defaults = ("0", "0", "0", "1")
        found = _of_quaternion([given.get(name, default) for name, default in zip(_QUATERNION, defaults, strict=True)])
        if found is not None:
            return found._replace(word=quaternion)
    return _of_same(given[_FRAMES[0]], given[_FRAMES[1]])


def _of_positions(words: Sequence[str]) -> _Fault | None:
    *numbers, parent, child = words
    wrong = next((word for word in numbers if not begins_with_number(word)), None)
    if wrong is not None:
        period = "; tf2 has no period" if len(numbers) == 7 and begins_with_number(child) else ""
        return _Fault(f"exits: '{wrong}' is not a number{period}", wrong)
    found = _of_quaternion(numbers[3:]) if len(numbers) == 7 else None
    return found or _of_same(parent, child)


def _of_same(parent: str, child: str) -> _Fault | None:
    same = parent == child
    return _Fault(f"exits: '{parent}' is both the parent and the child frame", parent) if same else None


RULE = Rule(
    id="FRM006",
    name="static-transform-arguments",
    effect="stops-node",
    kind="invalid",
    sometimes=("breaks", "misbehaves"),
    what="Checks for arguments of `static_transform_publisher` that it refuses, or that make it publish another "
    "transform. These are their number, options, values, the length of a quaternion, or two frames with the same name.",
    why="The process exits, or a frame such as '100' is published, and nothing publishes the intended frame.",
    example='<node pkg="tf2_ros" type="static_transform_publisher" name="mount"\n'
    '      args="0 0 1 0 0 0 base_link laser 100"/>',
    instead='<node pkg="tf2_ros" type="static_transform_publisher" name="mount"\n'
    '      args="0 0 1 0 0 0 base_link laser"/>',
    references=(TF2, FRAMES),
    check=_check,
    in_branches=True,
)
