"""`ament_index_python`, from the packages that the host knows."""

from __future__ import annotations

import os
import pathlib
from typing import Any

from ..anything import unknown_text
from ..missing_modules import provided_for
from .base import RECORDER, caller

_NOT_FOUND = ("PackageNotFoundError", "KeyError", "LookupError")


class PackageNotFoundError(KeyError):
    def __str__(self) -> str:
        return " ".join(repr(a) for a in self.args)


def get_package_share_directory(package_name: str, print_warning: bool = True) -> str:
    """That of a package which is not here is not known, and noted, unless the file says what it does without."""
    try:
        return RECORDER.packages[package_name]
    except (KeyError, TypeError):
        if not isinstance(package_name, str) or provided_for(caller(), _NOT_FOUND):
            searched = f"package '{package_name}' not found, searching: {get_search_paths()}"
            raise PackageNotFoundError(searched) from None
    RECORDER.miss("package", package_name)
    return unknown_text(f"the share folder of {package_name}")


def get_package_share_path(package_name: str, print_warning: bool = True) -> pathlib.Path:
    return pathlib.Path(get_package_share_directory(package_name))


def get_package_prefix(package_name: str) -> str:
    return prefix_of(package_name, get_package_share_directory(package_name))


def get_packages_with_prefixes() -> dict[str, str]:
    return {name: prefix_of(name, share) for name, share in RECORDER.packages.items()}


def get_search_paths() -> list[str]:
    return [path for path in os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep) if path]


def has_resource(resource_type: str, resource_name: str) -> Any:
    found = resource_type == "packages" and resource_name in RECORDER.packages
    return get_package_prefix(resource_name) if found else False


def get_resource(resource_type: str, resource_name: str) -> tuple[str, str]:
    if has_resource(resource_type, resource_name):
        return "", get_package_prefix(resource_name)
    raise LookupError(f"Could not find the resource '{resource_name}' of type '{resource_type}'")


def get_resources(resource_type: str) -> dict[str, str]:
    return get_packages_with_prefixes() if resource_type == "packages" else {}


def prefix_of(package: str, share: str) -> str:
    """The install prefix of a share folder; a package that is only source has none, and counts as its own."""
    end = os.path.join("share", package)
    return share[: -len(end)].rstrip("/") if share.endswith("/" + end) else share
