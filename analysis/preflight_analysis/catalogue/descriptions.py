"""The structure of robot descriptions in packages: what our own xacro has of them where they are not installed.

`tracing/agents/partial_xacro.py` reads the files, in the sandbox.
"""

from __future__ import annotations

import os
from collections.abc import Collection
from functools import lru_cache
from typing import Any

from preflight_analysis.catalogue.packages import DATA

DESCRIPTIONS = DATA / "descriptions"
"""`DISTRIBUTION/PACKAGE/` and below it, at the places of the share folder, xacro and URDF files, `SUFFIX` behind."""
SUFFIX = ".json"


def known_descriptions(distro: str, installed: Collection[str]) -> dict[str, Any]:
    """What is known of packages that are not installed: `folder`, that of the `distro`, and `packages`."""
    packages = [package for package in _described(distro) if package not in installed]
    return {"folder": str(DESCRIPTIONS / distro), "distro": distro, "packages": packages}


def folder_of(package: str, distro: str) -> str | None:
    """What stands for the share folder of a package in the command lines of our own xacro; None where nothing is known
    of it."""
    return str(DESCRIPTIONS / distro / package) if package in _described(distro) else None


def is_described(path: str) -> bool:
    """Whether a path is below such a folder."""
    return distribution_of(path) is not None


def distribution_of(path: str) -> str | None:
    """The distribution of a path below such a folder; None for any other path."""
    folder = f"{DESCRIPTIONS}{os.sep}"
    return path.removeprefix(folder).partition(os.sep)[0] if path.startswith(folder) else None


@lru_cache(maxsize=4)
def _described(distro: str) -> tuple[str, ...]:
    """The packages of a distribution of which descriptions are known, sorted."""
    try:
        return tuple(sorted(os.listdir(DESCRIPTIONS / distro)))
    except OSError:
        return ()
