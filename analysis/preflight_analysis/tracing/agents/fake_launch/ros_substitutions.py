"""`launch_ros.substitutions`."""

from __future__ import annotations

import os
from typing import Any

from .ament import get_package_share_directory, prefix_of
from .base import LaunchContext
from .worded import Parts, SubstitutionFailure, Worded, is_scalar


class FindPackage(Worded):
    """What finds a package in one way or another: classes made from it say where."""

    command = "find-pkg"

    def __init__(self, package: Any) -> None:
        self._words(package)

    @property
    def package(self) -> Parts:
        return self.words[0]

    def find(self, package_name: str) -> str:
        raise NotImplementedError

    def perform(self, context: LaunchContext) -> str:
        return self.find(self._text(context, 0))


class FindPackageShare(FindPackage):
    command = "find-pkg-share"

    def find(self, package_name: str) -> str:
        return get_package_share_directory(package_name)


class FindPackagePrefix(FindPackage):
    command = "find-pkg-prefix"

    def find(self, package_name: str) -> str:
        return prefix_of(package_name, get_package_share_directory(package_name))


class ExecutableInPackage(FindPackagePrefix):
    command = "exec-in-pkg"

    def __init__(self, executable: Any, package: Any) -> None:
        self._words(executable, package)

    @property
    def executable(self) -> Parts:
        return self.words[0]

    def perform(self, context: LaunchContext) -> str:
        package = self._text(context, 1)
        return os.path.join(self.find(package), "lib", package, self._text(context, 0))


class Parameter(Worded):
    command = "param"

    def __init__(self, name: Any, *, default: Any = None) -> None:
        self._words(*((name,) if default is None else (name, str(default) if is_scalar(default) else default)))

    @property
    def name(self) -> Parts:
        return self.words[0]

    def perform(self, context: LaunchContext) -> str:
        name = self._text(context, 0)
        for pair in context.launch_configurations.get("global_params", ()):
            if isinstance(pair, (list, tuple)) and pair[0] == name:
                return str(pair[1])
        if len(self.words) == 2:
            return self._text(context, 1)
        raise SubstitutionFailure(f"parameter '{name}' not found")
