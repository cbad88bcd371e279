"""The user's ROS environment as data. It is not the server's own interpreter, which needs no ROS."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Package:
    """A package found by its `package.xml`. `share` is the folder that `$(find)` gives."""

    name: str
    share: str
    manifest: str
    dependencies: frozenset[str] = frozenset()


@dataclass(frozen=True, slots=True)
class Environment:
    """What launch files and nodes see. Immutable; a new one is detected when package folders or settings change.

    `packages` has, for each name, the first package in the order of the package path; `shadowed` the others.
    `variables` is what `$(env)` reads and what nodes get (before the sandbox filters it).
    """

    generation: int
    distro: str | None
    variables: Mapping[str, str]
    package_path: tuple[str, ...]
    packages: Mapping[str, Package]
    shadowed: Mapping[str, tuple[Package, ...]]
    devel_spaces: tuple[str, ...]
    """catkin devel and install spaces whose `lib/<pkg>` and `share/<pkg>` hold executables, first wins."""
    system_prefixes: tuple[str, ...]
    """Prefixes such as `/usr` and `/opt/ros/noetic`."""
    python: str | None
    """The interpreter that has rospy, None when there is none."""
    workspace: str | None = None
    problems: tuple[str, ...] = ()
    """What is missing, in sentences that say what to install."""
