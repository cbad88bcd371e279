"""The environment as rows for the `doctor` verb."""

from __future__ import annotations

import os
from collections import Counter

from preflight_analysis.environment.model import Environment


def describe(environment: Environment) -> tuple[tuple[str, str], ...]:
    """`(what, value)` rows in the order in which to show them; a `what` may come several times.

    The rows of `what` "problem" are sentences that say what is missing; without one, nothing is.
    """
    none = "none found"
    generation = f"ROS {environment.generation}"
    distro = f"{generation} {environment.distro.capitalize()}" if environment.distro else f"{generation}, {none}"
    distro += f", by {environment.distro_by}; not installed" if environment.distro_by else ""
    rows = [("distribution", distro), ("workspace", environment.workspace or "none")]
    counts = _counts(environment)
    rows += [("package path", f"{folder} ({_packages(counts[folder])})") for folder in environment.package_path]
    if not environment.package_path:
        rows.append(("package path", "empty: no packages found"))
    for name, others in sorted(environment.shadowed.items()):
        hidden = ", ".join(package.share for package in others)
        rows.append(("shadowed package", f"{name}: {environment.packages[name].share} hides {hidden}"))
    rows += [("devel space", space) for space in environment.devel_spaces or (none,)]
    rows += [("system prefix", prefix) for prefix in environment.system_prefixes or (none,)]
    rows.append(("interpreter", environment.python or none))
    if environment.ros.needs_rclpy or environment.ros2_python:
        rows.append(("interpreter with rclpy", environment.ros2_python or none))
    rows += [("problem", problem) for problem in environment.problems]
    return tuple(rows)


def _packages(count: int) -> str:
    return "1 package" if count == 1 else f"{count} packages"


def _counts(environment: Environment) -> Counter[str]:
    """How many packages each folder of the package path contributes."""
    counts: Counter[str] = Counter()
    for package in environment.packages.values():
        for folder in environment.package_path:
            if package.share == folder or package.share.startswith(folder.rstrip(os.sep) + os.sep):
                counts[folder] += 1
                break
    return counts
