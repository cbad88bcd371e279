"""The library that is preloaded into roscpp nodes: compiled with the user's compiler on first use, and kept.

Our own code, so it is compiled outside the sandbox; the wheel holds no compiled one yet. `planned` says
where it is or is going to be and costs nothing; `build` takes half a second the first time. Where it cannot be had,
nodes are seen by the master alone.
"""

from __future__ import annotations

import contextlib
import functools
import hashlib
import logging
import os
import platform
import shutil
import subprocess
import sys
import tempfile
import threading
from dataclasses import dataclass
from pathlib import Path

import platformdirs

_log = logging.getLogger(__name__)

SOURCE = Path(__file__).parent / "agents" / "roscpp_preload.cpp"
COMPILERS = ("g++", "clang++", "c++")
MACHINES = ("x86_64",)
"""Where the layout of arguments and results was tried."""

_FLAGS = ("-shared", "-fPIC", "-O1", "-std=c++17", "-fvisibility=hidden", "-Wl,-z,nodelete")
_EXPORTS = "{ global: _ZN3ros*; _ZNK3ros*; _ZN9actionlib*; local: *; };"
"""Nothing of the C++ library that was compiled into it takes the place of the node's."""
_SECONDS = 30
_ELF = b"\x7fELF\x02"
"""Of 64 bits, as the library is."""


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
    """The library in one cache folder. Usable from several threads at once."""

    def __init__(self, folder: Path | None = None) -> None:
        self._folder = folder or Path(platformdirs.user_cache_dir("ros-preflight")) / "preload"
        self._lock = threading.Lock()
        self._failure: str | None = None

    def planned(self) -> Preload:
        """Where the library is or is going to be; nothing is compiled."""
        if self._failure is not None:
            return Preload(None, self._failure)
        return self._plan

    def build(self) -> Preload:
        """The library, compiled if it was not yet. What fails is not tried again by this process."""
        with self._lock:
            plan = self.planned()
            if plan.path is None or os.path.isfile(plan.path):
                return plan
            try:
                _compile(self._compiler or "", Path(plan.path))
            except subprocess.TimeoutExpired:
                self._failure = f"the C++ compiler did not end within {_SECONDS} s"
            except subprocess.CalledProcessError as error:
                said = error.stderr.decode(errors="replace").strip().splitlines()
                self._failure = "the library for roscpp nodes does not compile" + (f": {said[0][:300]}" if said else "")
            except OSError as error:
                self._failure = f"the library for roscpp nodes cannot be made: {error}"
            if self._failure is not None:
                _log.warning("%s", self._failure)
            return self.planned()

    @functools.cached_property
    def _compiler(self) -> str | None:
        return next((found for found in map(shutil.which, COMPILERS) if found), None)

    @functools.cached_property
    def _plan(self) -> Preload:
        if sys.platform != "linux" or platform.machine() not in MACHINES:
            return Preload(None, f"roscpp nodes are watched on {MACHINES[0]} only")
        if self._compiler is None:
            return Preload(None, "there is no C++ compiler to watch roscpp nodes with: apt install g++")
        compiler = os.path.realpath(self._compiler)
        with contextlib.suppress(OSError):
            info = os.stat(compiler)
            named = (compiler, str(info.st_size), str(info.st_mtime_ns), platform.machine(), *_FLAGS)
            digest = hashlib.sha256("\0".join(named).encode(errors="surrogatepass") + SOURCE.read_bytes()).hexdigest()
            path = str(self._folder.absolute() / f"roscpp-{digest[:32]}.so")
            # ld.so cuts LD_PRELOAD at both, and knows no quotes.
            if any(c.isspace() or c == ":" for c in path):
                return Preload(None, f"{self._folder} cannot be preloaded from: its name has blanks or colons")
            return Preload(path)
        return Preload(None, "the C++ compiler or our own source cannot be read")


@functools.lru_cache(maxsize=1)
def library() -> Library:
    """The one of the user's cache folder."""
    return Library()


def _compile(compiler: str, path: Path) -> None:
    """Compile to a temporary name and rename. Raises `OSError` and the exceptions of `subprocess.run`."""
    path.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
    with tempfile.TemporaryDirectory(dir=path.parent, prefix=".") as folder:
        made = os.path.join(folder, "made.so")
        exports = Path(folder, "exports")
        exports.write_text(_EXPORTS)
        command = [compiler, *_FLAGS, f"-Wl,--version-script={exports}", str(SOURCE), "-o", made, "-ldl"]
        subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, timeout=_SECONDS, check=True, cwd=folder)
        os.replace(made, path)
