"""How the library that is preloaded into roscpp nodes is compiled. The standard library alone: building a wheel does it
as well.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import tempfile
from pathlib import Path

SOURCE = Path(__file__).parent / "agents" / "roscpp_preload.cpp"
PREBUILT = SOURCE.with_suffix(".so")
"""The one that a wheel brings, of x86-64; absent where nothing was built."""
COMPILERS = ("g++", "clang++", "c++")
MACHINES = ("x86_64",)
"""Where the layout of arguments and results was tried."""
SECONDS = 30
FLAGS = ("-shared", "-fPIC", "-O1", "-std=c++17", "-fvisibility=hidden", "-Wl,-z,nodelete")
_PORTABLE = ("-DPREFLIGHT_PORTABLE", "-s", "-Wl,--no-as-needed", "-l:libdl.so.2")
"""For the libraries of other machines, older ones too: see the source. The C++ library stays the node's own: a second
one in the same process would not know the strings and exceptions of the first."""
_FILES = "open; open64; openat; openat64; __open_2; __open64_2; fopen; fopen64;"
_EXPORTS = "{ global: _ZN3ros*; _ZNK3ros*; _ZN9actionlib*; _ZNK3tf2*; _ZNK7tf2_ros*; " + _FILES + " local: *; };"
"""Nothing of the C++ library that was compiled into it takes the place of the node's."""


def compiler() -> str | None:
    """The path of a C++ compiler."""
    return next((found for found in map(shutil.which, COMPILERS) if found), None)


def compile_library(compiler: str, source: Path, path: Path, *, portable: bool = False) -> None:
    """Compile to a temporary name and rename. Raises `OSError` and the exceptions of `subprocess.run`."""
    path.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
    with tempfile.TemporaryDirectory(dir=path.parent, prefix=".") as folder:
        made = os.path.join(folder, "made.so")
        exports = Path(folder, "exports")
        exports.write_text(_EXPORTS)
        command = [compiler, *FLAGS, f"-Wl,--version-script={exports}", str(source), "-o", made]
        command += _PORTABLE if portable else ["-ldl"]
        subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, timeout=SECONDS, check=True, cwd=folder)
        os.replace(made, path)
