"""The libraries that are preloaded into nodes of roscpp and of rcl: those that came with the wheel, else compiled with
the user's compiler on first use, and kept.

Our own code, so it is compiled outside the sandbox. `planned` says where it is or is going to be and costs nothing;
`build` takes a second the first time. Where it cannot be had, nodes of roscpp are seen by the master alone, and those
of rcl are not run.
"""

from __future__ import annotations

import contextlib
import functools
import hashlib
import logging
import os
import platform
import re
import shutil
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

from preflight_analysis.dataclass import dataclass
from preflight_analysis.tracing import preload_compile
from preflight_analysis.tracing.cache_folder import cache_folder, make_private
from preflight_analysis.tracing.intact import Intact, seal, seal_of
from preflight_analysis.tracing.once_per_process import once_per_process
from preflight_analysis.tracing.preload_compile import (
    FLAGS,
    MACHINES,
    RCL,
    ROSCPP,
    SECONDS,
    WATCHED,
    Watched,
    compile_library,
    exports,
)
from preflight_analysis.tracing.store import ABANDONED

_log = logging.getLogger(__name__)

_ELF = b"\x7fELF\x02"
"""Of 64 bits, as the library is."""
_PROBE = "/bin/true"
_NAME = re.compile(rf"({'|'.join(watched.name for watched in WATCHED)})-[0-9a-f]{{32}}\.so")
MOST_KEPT = 8
"""How many libraries stay in the folder: of versions of this program and of compilers."""


@dataclass(frozen=True, slots=True)
class Preload:
    """Where the library is. Without one `reason` is a sentence that says why and what to do about it."""

    path: str | None
    reason: str | None = None


def applies(executable: str) -> bool:
    """Whether the executable is a program that a library can be loaded into."""
    try:
        with open(executable, "rb") as file:
            return file.read(len(_ELF)) == _ELF
    except OSError:
        return False


class Library:
    """The library for one client library, in one cache folder. Usable from several threads at once. `prebuilt` is the
    one to take, where there is such a file and it can be loaded."""

    def __init__(self, folder: Path | None = None, prebuilt: Path | None = None, watched: Watched = ROSCPP) -> None:
        self._folder = folder or cache_folder("preload")
        self._prebuilt = prebuilt or watched.prebuilt(platform.machine())
        self._watched = watched
        self._lock = threading.Lock()
        self._intact = Intact()
        self._unfit = False
        self._failure: str | None = None

    def planned(self) -> Preload:
        """Where the library is or is going to be; nothing is compiled."""
        if self._copied is not None and not self._unfit:
            return self._copied
        if self._failure is not None:
            return Preload(None, self._failure)
        return self._compiled

    def build(self) -> Preload:
        """The library, made if it is not there as a whole. What fails is not tried again by this process."""
        with self._lock:
            plan = self.planned()
            if plan is self._copied and plan.path is not None and not self._intact(Path(plan.path)):
                self._unfit = not _copy(self._prebuilt, Path(plan.path))
                plan = self.planned()
                self._tidy()
            if plan.path is None or self._intact(Path(plan.path)):
                _used(plan.path)
                return plan
            try:
                make_private(Path(plan.path).parent)
                compile_library(self._compiler or "", self._watched, Path(plan.path))
                seal(Path(plan.path))
                self._tidy()
            except subprocess.TimeoutExpired:
                self._failure = f"the C++ compiler did not end within {SECONDS} s"
            except subprocess.CalledProcessError as error:
                said = error.stderr.decode(errors="replace").strip().splitlines()
                self._failure = f"the library for {self._watched.name} nodes does not compile"
                self._failure += f": {said[0][:300]}" if said else ""
            except OSError as error:
                self._failure = f"the library for {self._watched.name} nodes cannot be made: {error}"
            if self._failure is not None:
                _log.warning("%s", self._failure)
            return self.planned()

    def _tidy(self) -> None:
        """Remove the libraries of other versions and compilers that were not used for longest, and what making one
        left behind that was interrupted. A process that still wants one makes it again."""
        dated: list[tuple[float, Path]] = []
        with contextlib.suppress(OSError):
            for path in self._folder.iterdir():
                with contextlib.suppress(OSError):
                    made = path.lstat().st_mtime
                    if _NAME.fullmatch(path.name):
                        dated.append((made, path))
                    elif path.name.startswith(".") and time.time() - made > ABANDONED:
                        shutil.rmtree(path)
        for _, path in sorted(dated, reverse=True)[MOST_KEPT:]:
            with contextlib.suppress(OSError):
                path.unlink()
                seal_of(path).unlink()

    @functools.cached_property
    def _compiler(self) -> str | None:
        return preload_compile.compiler()

    @functools.cached_property
    def _copied(self) -> Preload | None:
        """The prebuilt one is used from the cache folder: where it was installed may be no name for LD_PRELOAD."""
        if not _supported():
            return None
        try:
            return self._at(hashlib.sha256(self._prebuilt.read_bytes()).hexdigest())
        except OSError:
            return None

    @functools.cached_property
    def _compiled(self) -> Preload:
        if not _supported():
            return Preload(None, f"{self._watched.name} nodes are watched on {' and '.join(MACHINES)} only")
        if self._compiler is None:
            return Preload(None, f"there is no C++ compiler to watch {self._watched.name} nodes with: apt install g++")
        compiler = os.path.realpath(self._compiler)
        with contextlib.suppress(OSError):
            info = os.stat(compiler)
            named = (compiler, str(info.st_size), str(info.st_mtime_ns), platform.machine(), *FLAGS)
            made_of = b"".join(file.read_bytes() for file in self._watched.files) + exports(self._watched).encode()
            return self._at(hashlib.sha256("\0".join(named).encode(errors="surrogatepass") + made_of).hexdigest())
        return Preload(None, "the C++ compiler or our own source cannot be read")

    def _at(self, digest: str) -> Preload:
        path = str(self._folder.absolute() / f"{self._watched.name}-{digest[:32]}.so")
        # ld.so cuts LD_PRELOAD at both, and knows no quotes.
        if any(c.isspace() or c == ":" for c in path):
            return Preload(None, f"{self._folder} cannot be preloaded from: its name has blanks or colons")
        return Preload(path)


_WATCHED = {1: ROSCPP, 2: RCL}


@once_per_process
def library(generation: int) -> Library:
    """The one of the user's cache folder for nodes of a generation of ROS."""
    return Library(watched=_WATCHED[generation])


def _used(path: str | None) -> None:
    with contextlib.suppress(OSError):
        if path is not None:
            os.utime(path)


def _supported() -> bool:
    return sys.platform == "linux" and platform.machine() in MACHINES


def _copy(prebuilt: Path, path: Path) -> bool:
    """Whether the prebuilt library can be loaded here; then it stands at `path`."""
    try:
        make_private(path.parent)
        with tempfile.TemporaryDirectory(dir=path.parent, prefix=".") as folder:
            made = os.path.join(folder, "made.so")
            shutil.copyfile(prebuilt, made)
            # What it lacks (a version of a library), the loader says; of a file that is none it says so and goes on.
            probe = subprocess.run(
                [_PROBE],
                env={"LD_PRELOAD": made, "LC_ALL": "C"},
                stdin=subprocess.DEVNULL,
                capture_output=True,
                timeout=SECONDS,
                check=False,
            )
            if probe.returncode == 0 and not probe.stderr:
                os.replace(made, path)
                seal(path)
                return True
            _log.info("the library %s that was shipped does not fit: %r", prebuilt, probe.stderr[:300])
    except (OSError, subprocess.TimeoutExpired) as error:
        _log.info("the library %s that was shipped cannot be used: %s", prebuilt, error)
    return False
