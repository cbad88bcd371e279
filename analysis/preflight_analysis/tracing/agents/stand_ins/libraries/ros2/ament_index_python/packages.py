"""Where packages are."""

from __future__ import annotations

import json
import os
import pathlib
from typing import Any


class PackageNotFoundError(KeyError):
    """There is no such package."""


def _packages() -> dict[str, str]:
    with open(os.environ["PREFLIGHT_STAND_INS"], encoding="utf-8") as file:
        return dict(json.load(file)["packages"])


def get_package_share_directory(package_name: str, print_warning: bool = True) -> str:
    """Its share folder. Raises `PackageNotFoundError`."""
    found = _packages().get(package_name)
    if found is None:
        raise PackageNotFoundError(f"package '{package_name}' not found, searching: []")
    return found


def get_package_share_path(package_name: str, print_warning: bool = True) -> Any:
    return pathlib.Path(get_package_share_directory(package_name))


def get_package_prefix(package_name: str) -> str:
    share = get_package_share_directory(package_name)
    above, _, _ = share.rpartition("/share/")
    return above or share


def get_packages_with_prefixes() -> dict[str, str]:
    return {name: get_package_prefix(name) for name in _packages()}
