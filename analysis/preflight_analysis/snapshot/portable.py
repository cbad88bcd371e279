"""Texts without the folders of one machine."""

from __future__ import annotations

import os
import re
from typing import Any

from preflight_analysis.environment.model import Environment
from preflight_analysis.generation import ros

_PATH = re.compile(r"/[\w.+@~-]+(?:/[\w.+@~-]+)*")


class Portable:
    """Writes the folders of packages as `$(find ...)`, that of the workspace as `<workspace>` and that of the user as
    `~`, so that two machines, or two checkouts of one repository, say the same."""

    def __init__(self, environment: Environment, generation: int) -> None:
        find = ros(generation).find
        self._names: dict[str, str] = {}
        home = os.path.expanduser("~")
        for folder, name in (
            (home, "~"),
            (environment.workspace, "<workspace>"),
            *((package.share, f"$({find} {package.name})") for package in environment.packages.values()),
        ):
            if folder and folder != "/":
                self._names[folder.rstrip("/")] = name

    def text(self, text: str) -> str:
        """The text with each absolute path in it told by the innermost folder that has a name."""
        return _PATH.sub(lambda found: self._path(found[0]), text)

    def value(self, value: Any) -> Any:
        """The same for all texts in a value of plain data."""
        if isinstance(value, str):
            return self.text(value)
        if isinstance(value, list):
            return [self.value(each) for each in value]
        if isinstance(value, dict):
            return {key: self.value(each) for key, each in value.items()}
        return value

    def _path(self, path: str) -> str:
        folder = path
        while folder:
            name = self._names.get(folder)
            if name is not None:
                return name + path[len(folder) :]
            folder = folder.rpartition("/")[0]
        return path
