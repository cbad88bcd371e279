"""Texts of files, open editor buffers over the disk, each parsed once for each content."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable
from contextlib import suppress
from typing import TypeVar

from preflight_analysis.documents.reading import Unreadable
from preflight_analysis.evaluation.files import Files
from preflight_analysis.evaluation.reading import UNDECIDED, launch_file_of
from preflight_analysis.incremental.database import Cancelled
from preflight_analysis.launch.model import LaunchFile
from preflight_analysis.launch.recognize import Format, launch_format_on_disk

T = TypeVar("T")
_TRIES = 3
"""A file that is being written all the time is looked at so often, and then again when somebody asks."""


class Sources(Files):
    """The disk with the open buffers of an editor over it, each text parsed once."""

    @property
    def undecided(self) -> int:
        """The generation of ROS that a launch file is of which shows none: that of the environment."""
        return UNDECIDED(self.db)

    @undecided.setter
    def undecided(self, generation: int) -> None:
        with self.db.writing() as write:
            write.set(UNDECIDED, generation, durable=True)

    def launch_file(self, path: str, generation: int | None = None) -> LaunchFile | Unreadable:
        """The launch file at `path`, read as that generation of ROS reads it; None: as the file looks."""
        return launch_file_of(self.db, self._looked_at(os.path.normpath(path)), generation)

    def launch_format(self, path: str) -> Format | None:
        """The format of the launch file at `path`; None where it is none."""
        return launch_format_on_disk(self.db, self._looked_at(os.path.normpath(path)))

    def in_one_revision(
        self,
        work: Callable[[], T],
        files: Callable[[T], Iterable[str]],
        likely: Iterable[str],
        pause: Callable[[], object] = lambda: None,
    ) -> T:
        """What `work` gives while no text changes, with the files that it read, `files(result)`, as they are on the
        disk now. It begins again where one changes meanwhile, after a `pause`; `likely` are those that it probably
        reads."""
        self.look(likely)
        for _ in range(_TRIES):
            while True:
                with suppress(Cancelled), self.db.reading():
                    result = work()
                    break
                pause()
            if not self.look(files(result)):
                break
        return result
