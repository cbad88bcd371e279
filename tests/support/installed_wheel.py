"""The wheel as users have it: installed with what it needs, in an environment that nothing of the checkout is in."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from importlib.metadata import Distribution, distribution
from pathlib import Path

from packaging.requirements import Requirement

from support.build_once import build_once

ROOT = Path(__file__).parents[2]
_PIP = [sys.executable, "-m", "pip", "--quiet", "--disable-pip-version-check"]
_NOT_NEEDED = shutil.ignore_patterns("site-packages", "dist-packages", "test", "idlelib", "config-*", "__pycache__")


def wheel() -> Path:
    """The wheel of this checkout, with the libraries for nodes in C++ compiled."""
    (found,) = build_once("wheel", _build).glob("*.whl")
    return found


def install(place: Path, python: Path | None = None) -> Path:
    """Make an environment at `place` by an interpreter of this version (none: the one that the tests' own was made by),
    with the wheel in it. Its interpreter."""
    made_by = str(python or Path(sys.base_prefix, "bin", f"python3.{sys.version_info.minor}"))
    subprocess.run([made_by, "-I", "-m", "venv", "--without-pip", str(place)], check=True)
    inside = place / "bin" / "python"
    command = [*_PIP, "--python", str(inside), "install", "--no-deps", "--no-index", "--no-compile", str(wheel())]
    subprocess.run(command, check=True)
    (site,) = place.glob("lib/python3*/site-packages")
    for needed in _requirements("ros-preflight"):
        for file in needed.files or ():
            if ".." not in file.parts and file.suffix != ".pyc":
                (site / file).parent.mkdir(parents=True, exist_ok=True)
                shutil.copyfile(file.locate(), site / file)
    return inside


def copy_interpreter(place: Path) -> Path:
    """Make `place` the prefix of an interpreter as this one, as pyenv and uv have them in the home folder."""
    version = f"python3.{sys.version_info.minor}"
    (place / "bin").mkdir(parents=True)
    python = place / "bin" / version
    shutil.copy(os.path.realpath(Path(sys.base_prefix, "bin", version)), python)
    shutil.copytree(Path(sys.base_prefix, "lib", version), place / "lib" / version, ignore=_NOT_NEEDED)
    (python.with_name("python3")).symlink_to(version)
    return python


def _build(folder: Path) -> None:
    command = [*_PIP, "wheel", "--no-deps", "--no-build-isolation", "--no-index", "--wheel-dir", str(folder), str(ROOT)]
    subprocess.run(command, env={**os.environ, "ROS_PREFLIGHT_PREBUILT": "1"}, check=True)


def _requirements(name: str) -> Iterator[Distribution]:
    """What a distribution needs, and what that needs, without extras."""
    waiting, seen = [name], {name}
    while waiting:
        for each in map(Requirement, distribution(waiting.pop()).requires or ()):
            needed = each.name.lower()
            if needed not in seen and (each.marker is None or each.marker.evaluate({"extra": ""})):
                seen.add(needed)
                waiting.append(needed)
                yield distribution(needed)
