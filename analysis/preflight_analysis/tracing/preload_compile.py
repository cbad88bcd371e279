"""How the libraries that are preloaded into nodes in C++ are compiled. The standard library alone: building a wheel
does it as well.
"""

from __future__ import annotations

import os
import platform
import shutil
import subprocess
import tempfile
from pathlib import Path
from typing import NamedTuple

_AGENTS = Path(__file__).parent / "agents"
_COMMON = _AGENTS / "preload.hpp"
"""What both of them include."""


class Watched(NamedTuple):
    """A client library, and what is preloaded into the nodes that use it. `exports` are the functions of its that are
    intercepted: nothing of the C++ library that was compiled into ours takes the place of the node's."""

    name: str
    source: Path
    exports: str

    @property
    def files(self) -> tuple[Path, ...]:
        """All that it is compiled of: the source has the functions that are intercepted, the headers in the folder of
        its name what they do."""
        return (self.source, _COMMON, *sorted(self.source.with_suffix("").glob("*.hpp")))

    def prebuilt(self, machine: str) -> Path:
        """The one for a processor that a wheel brings; absent where nothing was built."""
        return self.source.with_suffix(f".{machine}.so")


ROSCPP = Watched(
    "roscpp",
    _AGENTS / "roscpp_preload.cpp",
    "_ZN3ros*; _ZNK3ros*; _ZN9actionlib*; _ZNK3tf2*; _ZNK7tf2_ros*; _ZN7nodelet6Loader4load*;",
)
RCL = Watched("rcl", _AGENTS / "rcl_preload.cpp", "rcl_*;")
WATCHED = (ROSCPP, RCL)

COMPILERS = ("g++", "clang++", "c++")
MACHINES = ("x86_64", "aarch64")
"""Where the layout of arguments and results was tried, as `platform.machine` has them: all nodes of the tests on
x86-64, four of Debian's roscpp nodes on arm64 (docs/tracing.md)."""
SECONDS = 180
"""At most for the compiler, which takes some 5 s: on a machine that is busy with other things many times that, and who
gives up sees less of all nodes in C++."""
FLAGS = ("-shared", "-fPIC", "-O1", "-std=c++17", "-fvisibility=hidden", "-Wl,-z,nodelete")
_PORTABLE = ("-DPREFLIGHT_PORTABLE", "-s", "-Wl,--no-as-needed", "-l:libdl.so.2")
"""For the libraries of other machines, older ones too: see the source. The C++ library stays the node's own: a second
one in the same process would not know the strings and exceptions of the first."""
_FILES = "open; open64; openat; openat64; __open_2; __open64_2; fopen; fopen64; statvfs; statvfs64;"


def compiler(machine: str | None = None) -> str | None:
    """The path of a C++ compiler for a processor: without one, or for that of this machine, the one that is installed
    for it; for another one a cross compiler, as Debian names them."""
    own = machine in (None, platform.machine())
    names = COMPILERS if own else tuple(f"{machine}-linux-gnu-{name}" for name in COMPILERS)
    return next((found for found in map(shutil.which, names) if found), None)


def exports(watched: Watched) -> str:
    """The linker's version script: which functions are intercepted."""
    return f"{{ global: {watched.exports} {_FILES} local: *; }};"


def compile_library(compiler: str, watched: Watched, path: Path, *, portable: bool = False) -> None:
    """Compile to a temporary name and rename. Raises `OSError` and the exceptions of `subprocess.run`."""
    path.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
    with tempfile.TemporaryDirectory(dir=path.parent, prefix=".") as folder:
        made = os.path.join(folder, "made.so")
        script = Path(folder, "exports")
        script.write_text(exports(watched))
        command = [compiler, *FLAGS, f"-Wl,--version-script={script}", str(watched.source), "-o", made]
        command += _PORTABLE if portable else ["-ldl"]
        subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, timeout=SECONDS, check=True, cwd=folder)
        os.replace(made, path)
