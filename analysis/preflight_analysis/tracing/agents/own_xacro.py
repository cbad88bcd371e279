"""xacro, where ROS has none: the one from PyPI, with `$(find)` by the packages that the host knows."""

from __future__ import annotations

import importlib
import json
import os
import sys
import types

from . import old_xacro, partial_xacro
from .skeletons import Skeletons
from .variables import DESCRIPTIONS, SHARES


class PackageNotFoundError(KeyError):
    """As that of `ament_index_python`."""


def main(*, old: bool = False) -> None:
    """The program, with its arguments in those of the process. The `old` one reads tags as before ROS Jade.
    What it makes of a file that this fails at is not known, nor what is made of a file that only the catalogue has."""
    sys.argv[0] = "xacro"
    shares = json.loads(os.environ.get(SHARES, "{}"))
    lacking = partial_xacro.Lacking(Skeletons(json.loads(os.environ.get(DESCRIPTIONS, "{}"))))

    def get_package_share_directory(package_name: str) -> str:
        if package_name in shares:
            return str(shares[package_name])
        return lacking.share_of(package_name)

    for name in ("ament_index_python", "ament_index_python.packages"):
        module = types.ModuleType(name)
        vars(module).update(
            get_package_share_directory=get_package_share_directory, PackageNotFoundError=PackageNotFoundError
        )
        module.__path__ = []
        sys.modules[name] = module
    importlib.import_module("xml.parsers.expat")  # xacro catches its error, and imports it only once it parses
    xacro = importlib.import_module("xacro")
    if partial_xacro.can_install(xacro):
        partial_xacro.install(xacro, lacking)
    if old:
        old_xacro.install(xacro)
    packages = ["xacro"] if old else list(filter(None, map(lacking.skeletons.package_of, sys.argv[1:])))
    try:
        xacro.main()
    except SystemExit as end:
        if not (end.code and packages):
            raise
        print(f"<!--{partial_xacro.INCOMPLETE}{packages[0]} --><robot/>")
