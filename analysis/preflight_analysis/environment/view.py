"""An environment as one launch file sees it: with the packages of its generation of ROS, and of several of one name the
one that is meant."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from dataclasses import replace

from preflight_analysis.environment.model import Environment, Package
from preflight_analysis.environment.packages import OF_ROS1
from preflight_analysis.generation import ros


def of_generation(environment: Environment, generation: int) -> Environment:
    """The environment with what the tools of that generation see of it."""
    installed = _below(os.path.join(prefix, "share") for prefix in environment.system_prefixes)
    prefixes, path = _below(environment.ament_prefixes), _below(environment.package_path)
    packages: dict[str, Package] = {}
    shadowed: dict[str, tuple[Package, ...]] = {}
    for name, first in environment.packages.items():
        candidates = tuple(each.built_for(generation) for each in (first, *environment.shadowed.get(name, ())))
        if ros(generation).ament:
            candidates = by_generation(p for p in candidates if not is_installed_ros1(p, installed, prefixes))
        else:  # rospkg takes what its path has, whatever it is built with
            candidates = tuple(p for p in candidates if p.share.startswith(path) or not p.share.startswith(prefixes))
            # Of two sources of one name that of catkin is the one that it is built with.
            candidates = tuple(sorted(candidates, key=lambda package: package.is_ament))
        if candidates:
            packages[name] = candidates[0]
        if len(candidates) > 1:
            shadowed[name] = candidates[1:]
    problems = environment.problems if generation == environment.generation else ()  # they are of the other ROS
    return replace(environment, generation=generation, packages=packages, shadowed=shadowed, problems=problems)


def meant_by(environment: Environment, file: str) -> tuple[Package, ...]:
    """The packages that a launch file means by their names where it means others than most do.

    Of packages of one name the one that holds the file is meant, else that of the nearest workspace, else the first.
    """
    if not environment.shadowed:
        return ()
    sources = tuple(_source_folders(file))
    meant: list[Package] = []
    for name, others in environment.shadowed.items():
        first = environment.packages[name]
        chosen = _nearest([p for p in (first, *others) if p.generation == first.generation], file, sources)
        if chosen is not first:
            meant.append(chosen)
    return tuple(meant)


def meaning(environment: Environment, packages: Iterable[Package]) -> Environment:
    """The environment of launch files that mean these packages by their names."""
    meant = {package.name: package for package in packages}
    shares = {name: package.share for name, package in meant.items()}
    return replace(environment, packages={**environment.packages, **meant}, meant=shares)


def by_generation(packages: Iterable[Package]) -> tuple[Package, ...]:
    """Those that ROS 2 builds first."""
    return tuple(sorted(packages, key=lambda package: package.build_type in OF_ROS1))


def is_installed_ros1(package: Package, installed: tuple[str, ...], prefixes: tuple[str, ...]) -> bool:
    """Whether it came with a ROS 1 that is installed there, which `ros2 launch` sees nothing of."""
    below = package.share.startswith(installed) and not package.share.startswith(prefixes)
    return below and not package.is_ament


def _nearest(packages: Sequence[Package], file: str, sources: Sequence[str]) -> Package:
    around = (p for p in packages if file.startswith(p.share + "/"))
    beside = (p for source in sources for p in packages if p.share.startswith(source))
    return next(around, None) or next(beside, None) or packages[0]


def _source_folders(file: str) -> Iterable[str]:
    """The `src` folders around a file, from the inside: those of its workspaces."""
    folder = os.path.dirname(file)
    while folder != os.path.dirname(folder):
        if os.path.basename(folder) == "src":
            yield os.path.join(folder, "")
        folder = os.path.dirname(folder)


def _below(folders: Iterable[str]) -> tuple[str, ...]:
    """What paths below the folders begin with."""
    return tuple(os.path.join(folder, "") for folder in folders)
