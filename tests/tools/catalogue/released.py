"""The names of released packages, from the distributions' public index (github:ros/rosdistro)."""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path

import yaml
from preflight_analysis.catalogue.released import DISTRIBUTIONS, RELEASED, ROSDEP

from tools.catalogue.repositories import Snapshot

REPOSITORY = "ros/rosdistro"
_KEYS = ("rosdep/base.yaml", "rosdep/python.yaml", "rosdep/ruby.yaml")


def write_released(sources: Path, only: Collection[str]) -> None:
    """Write the data anew, where the index is there."""
    for snapshot in Snapshot.of_all(sources, {REPOSITORY: "HEAD"}, only):
        _write(snapshot)


def _write(snapshot: Snapshot) -> None:
    letters: dict[str, list[str]] = {}
    for distro, letter in (each for of in DISTRIBUTIONS.values() for each in of.items()):
        index = yaml.load(snapshot.text(f"{distro}/distribution.yaml"), yaml.CSafeLoader)
        for name, repository in index["repositories"].items():
            release = repository.get("release")
            if release is not None and release.get("version"):
                for package in release.get("packages", [name]):
                    letters.setdefault(package, []).append(letter)
    lines = [f"# github:{REPOSITORY} {snapshot.commit} {snapshot.date}"]
    lines += [f"# {letter} {distro}" for of in DISTRIBUTIONS.values() for distro, letter in of.items()]
    lines += [f"{name} {''.join(of)}" for name, of in sorted(letters.items())]
    RELEASED.parent.mkdir(parents=True, exist_ok=True)
    RELEASED.write_text("\n".join(lines) + "\n")
    keys = sorted({key for file in _KEYS for key in yaml.load(snapshot.text(file), yaml.CSafeLoader)})
    ROSDEP.write_text("\n".join([lines[0], *keys]) + "\n")
    print(f"{RELEASED.name}: {len(letters)} packages of {snapshot.commit[:12]}; {ROSDEP.name}: {len(keys)} keys")
