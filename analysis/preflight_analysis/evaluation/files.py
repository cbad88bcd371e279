"""What the evaluation may read. The workspace implements it, with open editor buffers over the disk."""

from __future__ import annotations

import os
from abc import abstractmethod
from typing import Protocol

from preflight_analysis.documents.disk import Disk
from preflight_analysis.documents.reading import Unreadable
from preflight_analysis.environment.model import Executable
from preflight_analysis.launch.model import LaunchFile


class Files(Disk):
    """The disk with the launch files on it. Nothing raises."""

    @abstractmethod
    def launch_file(self, path: str, generation: int | None = None) -> LaunchFile | Unreadable:
        """The launch file at `path`, parsed as that generation of ROS reads it; None: as the file looks."""


class Executables(Protocol):
    """Finds what `pkg` and `type` of a node lead to."""

    def find(self, package: str, name: str) -> Executable:
        """The executable as roslaunch finds it."""

    def component(self, package: str, plugin: str) -> Executable:
        """The library that a container of ROS 2 loads for a class."""


def without_dots(disk: Disk, path: str) -> str | None:
    """`path` without `..`, None where that goes up from a folder that is not there.

    As the system reads it: behind a symbolic link `..` is the folder of what the link points to.
    """
    plain = os.path.normpath(path)
    if ".." not in path:
        return plain
    if not disk.is_folder(os.path.dirname(path)):
        return None
    real = disk.real_path(path)
    return plain if disk.real_path(plain) == real else real
