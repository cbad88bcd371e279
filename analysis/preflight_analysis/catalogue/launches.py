"""Which launch files of packages are known: a file for each, which `launch/catalogued.py` reads."""

from __future__ import annotations

import os
from functools import lru_cache
from typing import NamedTuple

from preflight_analysis.catalogue.packages import DATA, is_name

LAUNCHES = DATA / "launches"
"""`DISTRIBUTION/PACKAGE/` and below it, at the places of the share folder, the launch files with `SUFFIX` behind."""
SUFFIX = ".json"
_KEPT = 256


class CataloguedFile(NamedTuple):
    """A launch file as the catalogue has it: of which distribution and package, and where in its share folder."""

    distro: str
    package: str
    below: str

    def __str__(self) -> str:
        """As a message shows it."""
        return f"{self.package}/{self.below}"

    @property
    def label(self) -> str:
        """As a list of files shows it."""
        return f"{self} (catalogue of {self.distro})"


@lru_cache(maxsize=_KEPT)
def launch_files_of(package: str, distro: str) -> tuple[str, ...]:
    """The places, in its share folder, of the launch files of a package that are known; none where nothing is."""
    folder = LAUNCHES / distro / package
    if not is_name(package):
        return ()
    found = (path.relative_to(folder).as_posix().removesuffix(SUFFIX) for path in folder.rglob(f"*{SUFFIX}"))
    return tuple(sorted(found))


def path_of(file: CataloguedFile) -> str:
    """The path of the data of a launch file, whether there is any or not."""
    return os.path.join(LAUNCHES, file.distro, file.package, file.below + SUFFIX)


def catalogued_file(path: str) -> CataloguedFile | None:
    """The launch file that a path is the data of; None for any other path."""
    folder = f"{LAUNCHES}{os.sep}"
    if not path.startswith(folder):
        return None
    distro, package, *below = path.removeprefix(folder).removesuffix(SUFFIX).split(os.sep)
    return CataloguedFile(distro, package, "/".join(below))
