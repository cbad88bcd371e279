"""Programs that a launch file starts and that are not installed here.

`xacro` prints what our own one makes of the file; whatever else is missing prints something that is not known. A
program that is there is started as it is.
"""

from __future__ import annotations

import importlib
import os
import shlex
import shutil
import sys
import tempfile
from typing import Any

from ..anything import is_unknown, unknown_text
from ..missing_modules import provided_for
from .base import RECORDER, is_own

PRINTED = "preflight_printed"
"""The folder, in the one of temporary files, that has what such programs print."""
_ERRORS = ("FileNotFoundError", "OSError", "CalledProcessError")
_OF_SHELLS = frozenset("|&;<>$`(){}*?~#\n")


def install(subprocess: Any) -> None:
    """From now on they print; `subprocess` is the module."""
    real: Any = subprocess.Popen

    class Popen(real):  # type: ignore[misc]
        def __init__(self, args: Any, *more: Any, **kwargs: Any) -> None:
            super().__init__(_there(args, sys._getframe(1)), *more, **kwargs)

    subprocess.Popen = Popen


def is_missing(line: Any, frame: Any) -> bool:
    """Whether a command line names a program that is not installed here, and nobody provides for that."""
    words = _words(line)
    missing = bool(words) and os.sep not in words[0] and shutil.which(words[0]) is None
    return missing and not provided_for(frame, _ERRORS)


def _words(line: Any) -> list[str]:
    """Those of a command line; none of one that only a shell understands."""
    if not isinstance(line, str):
        return [os.fspath(each) for each in line] if isinstance(line, (list, tuple)) else []
    try:
        return [] if not _OF_SHELLS.isdisjoint(line) else shlex.split(line)
    except ValueError:
        return []


def _there(line: Any, frame: Any) -> Any:
    """A command line that prints what the one that is given would."""
    words = _words(line)
    is_xacro = bool(words) and words[0] == "xacro" and bool(RECORDER.own_xacro)
    while is_xacro and frame.f_back is not None and not is_own(frame):
        frame = frame.f_back  # `check_output` and the like
    if not is_own(frame) or not is_missing(line, frame):
        return line
    text = _of_xacro(words[1:]) if is_xacro else None
    if text is None:
        RECORDER.unknown = True
        text = unknown_text(f"{words[0]} ...")
    folder = os.path.join(tempfile.gettempdir(), PRINTED)
    os.makedirs(folder, exist_ok=True)
    handle, path = tempfile.mkstemp(dir=folder)
    with open(handle, "w", encoding="utf-8", errors="surrogatepass") as file:
        file.write(text)
    prints = ["cat", path]
    return shlex.join(prints) if isinstance(line, str) else prints


def _of_xacro(words: list[str]) -> Any:
    """What it prints; None if that is not known."""
    if any(map(is_unknown, words)):
        return None
    given = dict(word.split(":=", 1) for word in words if ":=" in word)
    files = [word for word in words if ":=" not in word and not word.startswith("-")]
    try:
        (file,) = files
        return importlib.import_module("xacro").process_file(file, mappings=given).toprettyxml(indent="  ")
    except Exception:
        return None
