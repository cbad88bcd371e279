"""Texts of files, open editor buffers over the disk, each parsed once for each content."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from typing import TypeVar

from preflight_analysis.documents.python_text import is_python
from preflight_analysis.documents.reading import Unreadable
from preflight_analysis.documents.span import LineIndex
from preflight_analysis.evaluation.files import Files
from preflight_analysis.evaluation.reading import UNDECIDED, launch_file_of
from preflight_analysis.incremental.database import Cancelled
from preflight_analysis.incremental.query import Input
from preflight_analysis.launch.model import LaunchFile
from preflight_analysis.launch.python_source import PythonSource
from preflight_analysis.launch.recognize import Format, launch_format_on_disk

T = TypeVar("T")
MAX_TEXTS_BEFORE = 20
_TRIES = 3
"""A file that is being written all the time is looked at so often, and then again when somebody asks."""


def _no_texts(path: str) -> tuple[str, ...]:
    return ()


TEXTS_BEFORE = Input(_no_texts)
"""Those that an open Python launch file had and that parse, the latest first."""


class Sources(Files):
    """The disk with the open buffers of an editor over it, each text parsed once."""

    def take(self, texts: Mapping[str, str | None]) -> None:
        """As `Disk.take`. What parses of Python launch files is kept: while one is half typed, that counts."""
        super().take(texts)
        for path, text in texts.items():
            if text is not None and is_python(path, text) and PythonSource(text, LineIndex(text)).problem is None:
                kept = TEXTS_BEFORE(self.db, path)
                if kept[:1] != (text,):
                    with self.db.writing() as write:
                        write.set(TEXTS_BEFORE, (text, *kept)[:MAX_TEXTS_BEFORE], path)

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
