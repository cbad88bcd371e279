"""Where the Python packages lie before they are built that `ament_python_install_package()` installs.

https://github.com/ament/ament_cmake/blob/jazzy/ament_cmake_python/cmake/ament_python_install_package.cmake. Those of a
`setup.py` are imported from the folder of that.
"""

from __future__ import annotations

import os

from preflight_analysis.documents.disk import Disk
from preflight_analysis.environment.installed_paths import cmake_build
from preflight_analysis.environment.model import Environment
from preflight_analysis.incremental.database import Database
from preflight_analysis.incremental.query import query


def module_folders(disk: Disk, environment: Environment) -> tuple[str, ...]:
    """The folders of the module search path once the workspace is built, as they are in the source. A package that its
    folder has another name than is not found by them."""
    return _module_folders(disk.db, environment)


@query
def _module_folders(db: Database, environment: Environment) -> tuple[str, ...]:
    disk = Disk(db)
    installed = tuple(os.path.join(prefix, "") for prefix in environment.ament_prefixes)
    found: dict[str, None] = {}
    for package in environment.packages.values():
        if package.is_ament and package.build_type != "ament_python" and not package.share.startswith(installed):
            for name, folder in cmake_build(disk, package).python_packages.items():
                if os.path.basename(folder) == name:
                    found[os.path.dirname(folder)] = None
    return tuple(found)
