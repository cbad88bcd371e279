"""How many children the nodes of behaviour trees have.

`VerifyXML` in src/xml_parsing.cpp of BehaviorTree/BehaviorTree.CPP, tags 3.8.6, 4.5.2, 4.7.3 and 879522c; what nodes of
several children throw at their first tick: their `tick` in src/controls and include/.../controls there, and in
nav2_behavior_tree/plugins/control of the commits that `known_nodes.py` names.
"""

from __future__ import annotations

import re
from typing import NamedTuple

from preflight_analysis.trees.known_nodes import BUILT_IN, NAV_NODES
from preflight_analysis.trees.read import Used


class Number(NamedTuple):
    """How many children a node may have; `most` None: any number."""

    least: int
    most: int | None

    @property
    def text(self) -> str:
        """What it must have, as messages say it."""
        if self.most is None:
            return "must have children"
        if self.most == 0:
            return "must not have children"
        if self.least == self.most:
            return f"must have {self.most} {'child' if self.most == 1 else 'children'}"
        return f"must have {self.least} to {self.most} children"


_NONE, _ONE, _SOME, _ANY = Number(0, 0), Number(1, 1), Number(1, None), Number(0, None)
_DECORATORS = """
    Inverter RetryUntilSuccesful RetryUntilSuccessful KeepRunningUntilFailure Repeat Timeout Delay RunOnce ForceSuccess
    ForceFailure Precondition LoopInt LoopBool LoopDouble LoopString SkipUnlessUpdated WaitValueUpdate
    BlackboardCheckInt BlackboardCheckDouble BlackboardCheckString BlackboardCheckBool
    DistanceController GoalUpdatedController GoalUpdater PathLongerOnApproach RateController SingleTrigger
    SpeedController
"""
_CONTROLS = """
    Fallback AsyncFallback Sequence AsyncSequence SequenceWithMemory SequenceStar Parallel ParallelAll ReactiveSequence
    ReactiveFallback ManualSelector TryCatch NonblockingSequence PersistentSequence PipelineSequence RoundRobin
"""
_DECORATOR_NAMES, _CONTROL_NAMES = frozenset(_DECORATORS.split()), frozenset(_CONTROLS.split())
_EXACT = {
    "RecoveryNode": Number(2, 2),
    "IfThenElse": Number(2, 3),
    "WhileDoElse": Number(2, 3),
    "PauseResumeController": Number(1, 4),
}
_SWITCH = re.compile(r"Switch([2-6])\Z")
_NEVER_EMPTY = frozenset({"Sequence", "Fallback"})
"""What every version refuses without children."""
_BY_TAG = {"Action": _NONE, "Condition": _NONE, "Decorator": _ONE, "Control": _SOME}


def children_of(used: Used, *, is_version_4: bool) -> Number | None:
    """How many children the node may have; None where that is not known of it. `is_version_4`: the tree is surely for
    version 4 of BehaviorTree.CPP."""
    switch = _SWITCH.match(used.name)
    if switch is not None:
        return Number(int(switch[1]) + 1, int(switch[1]) + 1)
    if used.name in _EXACT:
        return _EXACT[used.name]
    if used.name in _CONTROL_NAMES:
        return _SOME if is_version_4 or used.name in _NEVER_EMPTY else _ANY
    if used.name in _DECORATOR_NAMES:
        return _ONE
    if used.name in NAV_NODES or used.name in BUILT_IN:
        return _NONE
    return _BY_TAG.get(used.tag)
