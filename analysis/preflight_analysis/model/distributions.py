"""What is so in some distributions of ROS only."""

from __future__ import annotations

from collections.abc import Collection

from preflight_analysis.environment.model import Environment
from preflight_analysis.findings.doubt import Doubt, doubts

BEFORE_NOETIC = ("groovy", "hydro", "indigo", "jade", "kinetic", "lunar", "melodic")
"""Releases of ROS 1, which have Python 2."""
BEFORE_MELODIC = BEFORE_NOETIC[:-1]
BEFORE_GALACTIC = ("crystal", "dashing", "eloquent", "foxy")
"""Releases of ROS 2."""


def otherwise_in(environment: Environment, distributions: Collection[str]) -> tuple[Doubt, ...]:
    """The doubt about what is not so in these: the workspace says that it is for one of them, and not for the one that
    is used here."""
    used = environment.distro
    meant = (used,) if used in environment.meant_for else environment.meant_for
    names = " and ".join(name.capitalize() for name in meant if name in distributions)
    return doubts(MEANT_FOR_OTHER=f"ROS {names}" if names else "")
