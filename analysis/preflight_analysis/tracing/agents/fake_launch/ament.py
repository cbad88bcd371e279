"""`ament_index_python`, from the packages that the host knows."""

from __future__ import annotations

import os
import pathlib
from typing import Any

from .base import RECORDER


class PackageNotFoundError(KeyError):
    def __str__(self) -> str:
        return " ".join(repr(a) for a in self.args)


def get_package_share_directory(package_name: str, print_warning: bool = True) -> str:
    try:
        return RECORDER.packages[package_name]
    except (KeyError, TypeError):
        raise PackageNotFoundError(f"package '{package_name}' not found, searching: {get_search_paths()}") from None


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
