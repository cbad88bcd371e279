"""What the evaluation may read. The workspace implements it, with open editor buffers over the disk."""

from __future__ import annotations

import os
from typing import Protocol

from preflight_analysis.documents.document import Document
from preflight_analysis.documents.reading import Unreadable
from preflight_analysis.environment.model import Executable
from preflight_analysis.launch.model import LaunchFile


class Files(Protocol):
    """Reads by absolute path; nothing raises."""

    def launch_file(self, path: str, generation: int | None = None) -> LaunchFile | Unreadable:
        """The launch file at `path`, parsed as that generation of ROS reads it; None: as the file looks."""

    def text(self, path: str) -> Document | Unreadable:
        """Any text file, not parsed: a Document without children."""

    def digest(self, path: str) -> str:
        """Names the content of a file as it is now; "" where there is none."""

    def data(self, path: str) -> bytes | Unreadable:
        """The bytes of a file (`binfile`)."""


class Executables(Protocol):
    """Finds what `pkg` and `type` of a node lead to."""

    def find(self, package: str, name: str) -> Executable:
        """The executable as roslaunch finds it."""


def without_dots(path: str) -> str | None:
    """`path` without `..`, None where that goes up from a folder that is not there.

    As the system reads it: behind a symbolic link `..` is the folder of what the link points to.
    """
    plain = os.path.normpath(path)
    if ".." not in path:
        return plain
    if not os.path.isdir(os.path.dirname(path)):
        return None
    real = os.path.realpath(path)
    return plain if os.path.realpath(plain) == real else real
