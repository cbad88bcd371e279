"""Our own code as the sandbox gets to see it: a copy in the user's cache folder, with compiled modules beside it.

Inside nothing can be written beside the sources, so each run would compile them anew. They are compiled in the sandbox
by the interpreter that is going to read them, which may be a workspace's own; so each has a copy for itself. Where none
can be made the sources are used as they are.
"""

from __future__ import annotations

import base64
import contextlib
import hashlib
import logging
import os
import shutil
import tempfile
import threading
import time
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from preflight_analysis.tracing import run
from preflight_analysis.tracing.agents.compiling import TOPS
from preflight_analysis.tracing.backend import AGENTS, Agents, Visible
from preflight_analysis.tracing.cache_folder import cache_folder, make_private
from preflight_analysis.tracing.intact import Intact, seal
from preflight_analysis.tracing.once_per_process import once_per_process

_log = logging.getLogger(__name__)

KEPT_SECONDS = 7 * 86_400
"""How long a copy that nobody uses any more stays."""


class Copies:
    """The copies in one cache folder, one an interpreter. Usable from several threads at once."""

    def __init__(self, folder: Path | None = None) -> None:
        self._folder = folder or cache_folder("agents")
        self._lock = threading.Lock()
        self._intact = Intact()
        self._found: dict[str, Agents] = {}

    def of(self, interpreter: str, visible: Visible) -> Agents:
        """The copy for an interpreter, made if there is none yet, or if it is not whole any more. What fails is not
        tried again by this process."""
        with self._lock:
            found = self._found.get(interpreter)
            if found is None or not (found is AGENTS or self._intact(found.site.parent)):
                try:
                    found = self._copy(interpreter, visible)
                except (OSError, ValueError) as error:
                    _log.warning("our code in the sandbox is not kept compiled: %s", error)
                    found = AGENTS
                self._found[interpreter] = found
            return found

    def _copy(self, interpreter: str, visible: Visible) -> Agents:
        place = self._folder / _digest(interpreter)
        if not self._intact(place):
            make_private(self._folder)
            with tempfile.TemporaryDirectory(dir=self._folder, prefix=".") as folder:
                made = Path(folder, "made")
                for name, path in _sources():
                    (made / name / "__pycache__").mkdir(parents=True, exist_ok=True)
                    shutil.copy(path, made / name)
                for name, path in _data():
                    shutil.copy(path, made / name)
                raw = run.compile_agents(interpreter, visible, _within(made))
                kept = sum(_keep(record.get("own"), made) for record in raw.records)
                if kept != len(_sources()):
                    raise ValueError(raw.stderr.decode(errors="replace")[-500:] or "not all of it was compiled")
                seal(made)
                if not self._intact(place):  # unless another process was first
                    with contextlib.suppress(OSError):
                        place.rename(Path(folder, "old"))
                    with contextlib.suppress(OSError):
                        made.rename(place)
            self._sweep()
        os.utime(place)
        return _within(place)

    def _sweep(self) -> None:
        for left in self._folder.iterdir():
            with contextlib.suppress(OSError):
                if left.stat().st_mtime < time.time() - KEPT_SECONDS:
                    shutil.rmtree(left)


@once_per_process
def copies() -> Copies:
    """Those of the user's cache folder."""
    return Copies()


def _keep(record: object, made: Path) -> bool:
    """Write one compiled module into a copy. Raises `ValueError` if it is none of ours."""
    if not isinstance(record, Mapping) or record.get("ev") != "compiled":
        return False
    path: Any = record.get("path")
    folder, _, name = str(path).rpartition("/__pycache__/")
    source = name.partition(".")[0] + ".py"
    if (
        ".." in folder
        or not folder.startswith(TOPS)
        or "/" in name
        or not name.endswith(".pyc")
        or not (made / folder / source).is_file()
    ):
        raise ValueError(f"{str(path)[:100]!r} is none of our modules")
    (made / folder / "__pycache__" / name).write_bytes(base64.b64decode(str(record.get("data")), validate=True))
    return True


def _within(place: Path) -> Agents:
    return Agents(place / "lib/preflight_agents", place / "lib/aspectlib", place / "site")


def _sources() -> list[tuple[str, Path]]:
    """Our modules, each with the folder of the copy that it goes to."""
    ours, woven = AGENTS.library, AGENTS.aspectlib
    agents = [(str(Path(TOPS[0], path.parent.relative_to(ours))), path) for path in sorted(ours.rglob("*.py"))]
    aspectlib = [(TOPS[1], path) for path in sorted(woven.glob("*.py"))]
    return [*agents, *aspectlib, (TOPS[2], AGENTS.site / "sitecustomize.py")]


def _data() -> list[tuple[str, Path]]:
    """What our modules read, likewise."""
    ours = AGENTS.library
    return [(str(Path(TOPS[0], path.parent.relative_to(ours))), path) for path in sorted(ours.rglob("*.json"))]


def _digest(interpreter: str) -> str:
    """Of our sources and of which interpreter it is."""
    where = os.path.realpath(interpreter)
    info = os.stat(where)
    digest = hashlib.sha256(f"{where}\0{info.st_size}\0{info.st_mtime_ns}".encode(errors="surrogatepass"))
    for name, path in (*_sources(), *_data()):
        digest.update(f"{name}/{path.name}".encode() + b"\0" + path.read_bytes())
    return digest.hexdigest()[:32]
