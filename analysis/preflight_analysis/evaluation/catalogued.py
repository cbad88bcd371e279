"""The launch files and robot descriptions of packages that are not here, as the catalogue has them."""

from __future__ import annotations

import os
import re

from preflight_analysis.catalogue.descriptions import folder_of
from preflight_analysis.catalogue.launches import CataloguedFile, launch_files_of, path_of
from preflight_analysis.catalogue.packages import distribution_of
from preflight_analysis.environment.model import Environment
from preflight_analysis.environment.own_programs import own_arguments

_FIND = re.compile(r"\$\(find +([\w-]+) *\)")
_BELOW = re.compile(r"\$\(find ([\w-]+)\)/+([^$]+)\Z")


def folder_of_missing(package: str) -> str:
    """What stands for the share folder of a package that is not here."""
    return f"$(find {package})"


def in_catalogue(path: str, generation: int, environment: Environment) -> CataloguedFile | None:
    """The launch file that a path below such a folder leads to; None where the catalogue has none of the package. It
    need not have that file. What is here is what it is here."""
    found = _BELOW.match(path)
    if found is None or found[1] in environment.packages:
        return None
    file = CataloguedFile(distribution_of(generation, environment.distro), found[1], os.path.normpath(found[2]))
    return file if launch_files_of(file.package, file.distro) else None


def described_share(package: str, generation: int, environment: Environment) -> str | None:
    """What stands for the share folder of a package that is not here, where xacro is to read a robot description of it;
    None where the catalogue has none."""
    if package in environment.packages:
        return None
    return folder_of(package, distribution_of(generation, environment.distro))


def with_described_shares(line: str, generation: int, environment: Environment) -> str | None:
    """A command line in which `$(find package)` is left of packages that are not here, as our own xacro understands it.
    None where that is not called, or one of them is not known."""
    words = line.split()
    if own_arguments(words) is None:
        return None
    found = _FIND.sub(lambda match: described_share(match[1], generation, environment) or match[0], line)
    return found if "$(" not in found else None


def data_of(file: CataloguedFile) -> str | None:
    """The path of the data of a launch file; None where there is none."""
    return path_of(file) if file.below in launch_files_of(file.package, file.distro) else None
