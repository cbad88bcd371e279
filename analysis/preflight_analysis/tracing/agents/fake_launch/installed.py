"""Files at the places where they will be installed.

The share folder of a package of the workspace is that of its source. What CMake or `setup.py` installs under another
name is not there; where the launch file opens it or looks for it, it gets the file of the source.
"""

from __future__ import annotations

import builtins
import functools
import io
import os
from typing import Any


def install(pairs: Any) -> None:
    """From now on what is at neither place is missing, and nothing else. `pairs` are paths in share folders, and the
    files and folders of the source that they lead to."""
    known = [(str(where), str(source)) for where, source in pairs]
    if not known:
        return
    exists = os.path.lexists
    lstat = os.lstat

    def source_of(path: Any) -> Any:
        try:
            text = os.fspath(path)
        except TypeError:
            return path
        if not isinstance(text, str) or not os.path.isabs(text):
            return path
        text = os.path.normpath(text)
        for where, source in known:
            if text == where or text.startswith(where + os.sep):
                try:
                    lstat(text)
                except OSError:
                    found = source + text[len(where) :]
                    if exists(found):
                        return found
        return path

    def redirected(function: Any) -> Any:
        @functools.wraps(function)
        def called(path: Any = ".", *args: Any, **kwargs: Any) -> Any:
            return function(source_of(path), *args, **kwargs)

        return called

    def opened(file: Any, mode: str = "r", *args: Any, **kwargs: Any) -> Any:
        return open_file(source_of(file) if set("wax+").isdisjoint(mode) else file, mode, *args, **kwargs)

    open_file = io.open
    for module, name in ((os, "stat"), (os, "listdir"), (os, "scandir"), (os, "access")):
        setattr(module, name, redirected(getattr(module, name)))
    for module in (builtins, io):
        module.open = opened  # type: ignore[attr-defined]
