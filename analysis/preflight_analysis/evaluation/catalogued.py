"""The launch files of packages that are not here, as the catalogue has them."""

from __future__ import annotations

import os
import re

from preflight_analysis.catalogue.launches import CataloguedFile, launch_files_of, path_of
from preflight_analysis.catalogue.packages import distribution_of
from preflight_analysis.environment.model import Environment

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


def data_of(file: CataloguedFile) -> str | None:
    """The path of the data of a launch file; None where there is none."""
    return path_of(file) if file.below in launch_files_of(file.package, file.distro) else None
