"""Where packages are."""

from __future__ import annotations

from typing import Any

import rospkg  # type: ignore[import-not-found]


class ROSPkgException(Exception):
    """Something is wrong with a package."""


class InvalidROSPkgException(ROSPkgException):
    """There is no such package."""


def get_pkg_dir(package: str, required: bool = True, ros_root: Any = None, ros_package_path: Any = None) -> Any:
    """Its folder."""
    try:
        return rospkg.RosPack().get_path(package)
    except rospkg.ResourceNotFound:
        if required:
            raise InvalidROSPkgException(f"Cannot locate installation of package {package}") from None
        return None
