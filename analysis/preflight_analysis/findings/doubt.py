"""Why a claim may not hold, or not matter: a closed list of reasons, in words for users."""

from __future__ import annotations

from enum import Enum
from typing import NamedTuple


class Reason(Enum):
    """A reason: what is not known, or speaks against it, and what would remove it ("" where nothing does). `{of}`
    stands for what the doubt is about. What each does to a finding says `policy.py`."""

    # Nobody knows until the robot is looked at.
    NOT_HERE = "this machine does not have it", "install {of}"
    OTHER_LAUNCH = "another launch may start the other end", "launch both together (`roots` in .ros-preflight.yaml)"
    OUTSIDE = "something outside of this launch may do it", "describe it in .ros-preflight.yaml (`external`, `nodes`)"
    ON_ROBOT = "it speaks of another machine than this one", "check it on the robot"
    MADE_BY_BUILD = "the build of the package may create it", "build the package"
    MADE_ELSEWHERE = "another program may create it", "create it, or commit it"
    NOT_SET = "a value is empty or a placeholder", "set {of}"
    WHERE_STARTED = "it depends on the folder where the launch is started", "write the path from its package"
    OTHER_ARGUMENTS = "it applies with other arguments only", "launch with {of}"
    NOT_GIVEN = "no node of this launch gets the file", "launch the node that gets it"
    # What is known is of something like it.
    CATALOGUE = "it is known from the catalogue, not from this machine", "install the package"
    OTHER_DISTRIBUTION = (
        "it is known from the catalogue of another distribution",
        "source the ROS that is used, or install the package",
    )
    OTHER_VERSION = "it is known of another version or distribution", "source the ROS that is used"
    LIBRARY = "what the libraries in use do with it was not seen running", ""
    MEANT_FOR_OTHER = (
        "the workspace says that it is for another distribution of ROS, where it is otherwise",
        "check it with {of}, or name the one that is used: `distribution` in .ros-preflight.yaml",
    )
    # What was not looked at as a whole.
    NOT_ANALYSED = "nodes of this launch were not analysed as a whole", "build their packages, or annotate them"
    FROM_SOURCE = "it was read from a source, not seen running", "let the node run: `ros-preflight trace`"
    LATER = "a run shows what the node does before its event loop, not after it", "annotate the node"
    ASSUMED = "the node's part in it is assumed, not seen", "annotate the node"
    DEPENDS = "whether the node does it depends on its parameters", "annotate the node"
    COMPUTED = "a name in it is made at run time", "annotate the node"
    PARTLY_READ = "not all that it depends on is known", ""
    BRANCHES = "the launch file is a program, and not all of its branches are known", ""
    SANDBOX = "the sandbox may be the cause", "annotate the node"
    # What speaks against it.
    LIKE_NAMES = "only the names are alike", ""
    IN_USE = "other files of the workspace use the name", ""
    SHARED = "it is written for several nodes, and one may want it", ""
    INTENDED = "it looks intended", ""
    SIBLINGS = "only those that are written alike say so", ""
    NO_DIFFERENCE = "it makes no difference here", ""
    EXPLAINED = "another finding names the cause", "fix that one first"
    SET_ASIDE = "nobody starts the file as it is", ""
    UNSEEN = "what is not on this machine may change it", ""

    @property
    def sentence(self) -> str:
        """What speaks against the claim."""
        return self.value[0]

    @property
    def remedy(self) -> str:
        """What to do so that the doubt goes; "" where nothing is known."""
        return self.value[1]


class Doubt(NamedTuple):
    """A reason, and what it is about: the argument to set, the node that was not analysed."""

    reason: Reason
    of: str = ""

    @property
    def remedy(self) -> str:
        """What to do so that it goes, in words; "" where nothing is known."""
        return "" if "{of}" in self.reason.remedy and not self.of else self.reason.remedy.format(of=self.of)


def doubts(**reasons: object) -> tuple[Doubt, ...]:
    """The reasons for which a condition holds: `doubts(SHARED=is_for_all, NOT_ANALYSED=not complete)`; a text is what
    the doubt is about."""
    return tuple(
        Doubt(Reason[name], holds if isinstance(holds, str) else "") for name, holds in reasons.items() if holds
    )
