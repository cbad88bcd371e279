"""What is known of packages: a file for each of a distribution."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path
from typing import Any

DATA = Path(__file__).with_name("data")
INTERFACES = DATA / "interfaces"
"""`DISTRIBUTION/PACKAGE.json`: what the executables, components, nodelets, controllers and plugins of a package do."""
_KNOWN: Mapping[int, tuple[str, ...]] = {1: ("noetic",), 2: ("jazzy",)}
"""The distributions of each generation of which packages are known. The first stands for those that are not."""
_NAME = re.compile(r"\w[\w-]*\Z")
_KEPT = 256


def distribution_of(generation: int, distro: str | None) -> str:
    """The distribution whose packages stand for those of `distro`."""
    known = _KNOWN[generation]
    return distro if distro is not None and distro in known else known[0]


def is_name(package: str) -> bool:
    """Whether it is the name of a package, and no path."""
    return _NAME.match(package) is not None


@lru_cache(maxsize=_KEPT)
def interfaces_of(package: str, distro: str) -> Mapping[str, Any]:
    """What is known of the nodes of a package: `source` (repository, commit, date), and by name `executables`,
    `components`, `nodelets`, `controllers` and `plugins`; empty where nothing is, or the file is broken."""
    if not is_name(package):
        return {}
    try:
        found = json.loads((INTERFACES / distro / f"{package}.json").read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError):
        return {}
    return found if isinstance(found, dict) else {}
