"""Programs that a launch file starts and that are not installed here.

`xacro` prints what our own one makes of the file; whatever else is missing prints something that is not known. A
program that is there is started as it is.
"""

from __future__ import annotations

import importlib
import os
import re
import shlex
import shutil
import sys
import tempfile
from typing import Any

from .. import anything
from ..anything import unknown_text
from ..missing_modules import provided_for
from .base import OURS, RECORDER, is_own

PRINTED = "preflight_printed"
"""The folder, in the one of temporary files, that has what such programs print."""
_ERRORS = ("FileNotFoundError", "OSError")
_ERRORS_OF_SHELLS = (*_ERRORS, "CalledProcessError")
_OF_SHELLS = frozenset("|&;<>$`(){}*?~#\n")
_JOINS = re.compile(r"[|&;\n]+")
_INTO_FILE = re.compile(r"(?<=\S)\s*(?<![\d&>])>\s*([^\s|&;<>]+)\s*\Z")
"""What a shell prints into a file at last, which for xacro is an option."""
_PROGRAM = re.compile(r"\s*(?:\w+=\S*\s+)*([A-Za-z][\w.+-]*)(?=\s|$)")
_BUILT_IN = frozenset(
    ("cd", "eval", "exec", "exit", "export", "for", "if", "read", "set", "source", "then", "unset", "while")
)
_THROUGH = ("subprocess", "os")
"""Modules that start programs for others."""


def install(subprocess: Any) -> None:
    """From now on they print; `subprocess` is the module."""
    real: Any = subprocess.Popen

    class Popen(real):  # type: ignore[misc]
        def __init__(self, args: Any, *more: Any, **kwargs: Any) -> None:
            super().__init__(_there(args, sys._getframe(1)), *more, **kwargs)

    subprocess.Popen = Popen
    system: Any = os.system

    def called(command: Any) -> int:
        if not is_own(sys._getframe(1)) or not _is_missing(command, sys._getframe(1)):
            return int(system(command))
        return int(subprocess.call(command, shell=True)) << 8  # noqa: S604 - as `os.system` does; inside the sandbox

    os.system = called


def is_unknown(line: Any, frame: Any) -> bool:
    """Whether a command line names a program that is not installed here, of which nobody knows what it prints, and
    nobody provides for that."""
    return not _is_own_xacro(_words(line)) and _is_missing(line, frame)


def _is_own_xacro(words: list[str]) -> bool:
    return bool(words) and words[0] == "xacro" and bool(RECORDER.own_xacro)


def _is_missing(line: Any, frame: Any) -> bool:
    words = _words(line)
    missing = bool(words) and os.sep not in words[0] and shutil.which(words[0]) is None
    errors = _ERRORS_OF_SHELLS if isinstance(line, str) else _ERRORS
    return (missing or _shell_lacks(line)) and not provided_for(frame, errors)


def _shell_lacks(line: Any) -> bool:
    """Whether a text that only a shell understands names a program that is not installed here."""
    if not isinstance(line, str) or _OF_SHELLS.isdisjoint(line):
        return False
    programs = [found[1] for found in map(_PROGRAM.match, _JOINS.split(line)) if found is not None]
    return any(each not in _BUILT_IN and shutil.which(each) is None for each in programs)


def _words(line: Any) -> list[str]:
    """Those of a command line; none of one that only a shell understands."""
    if not isinstance(line, str):
        return [os.fspath(each) for each in line] if isinstance(line, (list, tuple)) else []
    line = _INTO_FILE.sub(r" -o \1", line)
    try:
        return [] if not _OF_SHELLS.isdisjoint(line) else shlex.split(line)
    except ValueError:
        return []


def _there(line: Any, frame: Any) -> Any:
    """A command line that prints what the one that is given would."""
    words = _words(line)
    while frame.f_back is not None and _starts_for_others(frame):
        frame = frame.f_back  # `check_output` and the like
    if not is_own(frame) or not _is_missing(line, frame):
        return line
    text = _of_xacro(words[1:]) if _is_own_xacro(words) else None
    if text is None:
        RECORDER.unknown = True
        text = unknown_text(f"{words[0]} ..." if words else str(line))
    folder = os.path.join(tempfile.gettempdir(), PRINTED)
    os.makedirs(folder, exist_ok=True)
    handle, path = tempfile.mkstemp(dir=folder)
    with open(handle, "w", encoding="utf-8", errors="surrogatepass") as file:
        file.write(text)
    prints = ["cat", path]
    return shlex.join(prints) if isinstance(line, str) else prints


def _starts_for_others(frame: Any) -> bool:
    return frame.f_globals.get("__name__") in _THROUGH or frame.f_code.co_filename.startswith(OURS)


def _of_xacro(words: list[str]) -> Any:
    """What it prints; None if that is not known."""
    if any(map(anything.is_unknown, words)):
        return None
    given = dict(word.split(":=", 1) for word in words if ":=" in word)
    output = next((after for option, after in zip(words, words[1:]) if option == "-o"), None)
    files = [word for word in words if ":=" not in word and not word.startswith("-") and word != output]
    try:
        (file,) = files
        text = importlib.import_module("xacro").process_file(file, mappings=given).toprettyxml(indent="  ")
        if output is None:
            return text
        with open(output, "w", encoding="utf-8") as made:
            made.write(text)
        return ""
    except Exception:
        return None
