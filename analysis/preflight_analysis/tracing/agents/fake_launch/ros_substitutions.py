"""`launch_ros.substitutions`."""

from __future__ import annotations

import os
from typing import Any

from .ament import get_package_share_directory, prefix_of
from .base import LaunchContext
from .worded import Parts, SubstitutionFailure, Worded, is_scalar


class FindPackage(Worded):
    """What finds a package in one way or another: classes made from it say where."""

    def find(self, package_name: str) -> str:
        raise NotImplementedError

    def perform(self, context: LaunchContext) -> str:
        return self.find(self._text(context, 0))


class FindPackageShare(FindPackage):
    def find(self, package_name: str) -> str:
        return get_package_share_directory(package_name)


class FindPackagePrefix(FindPackage):
    def find(self, package_name: str) -> str:
        return prefix_of(package_name, get_package_share_directory(package_name))


class ExecutableInPackage(FindPackagePrefix):
    def perform(self, context: LaunchContext) -> str:
        package = self._text(context, 1)
        return os.path.join(self.find(package), "lib", package, self._text(context, 0))


class Parameter(Worded, declared="launch_ros.substitutions.Parameter"):
    def preflight_take(self, given: Any, left: Any) -> None:
        default = str(given.default) if is_scalar(given.default) else given.default
        self._words(*((given.name,) if default is None else (given.name, default)))

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
