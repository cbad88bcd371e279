"""Files at the places where they will be installed.

The share folder of a package of the workspace is that of its source. What CMake or `setup.py` installs under another
name is not there; where a launch file or a node opens it or looks for it, it gets the file of the source.
"""

from __future__ import annotations

import builtins
import functools
import io
import os
from typing import Any, Iterator, Optional


class _Entries:
    """Those of a folder that have one of some names, as `os.scandir` gives them."""

    def __init__(self, entries: Any, names: Any) -> None:
        self._entries, self._names = entries, names

    def __iter__(self) -> Iterator[Any]:
        return (each for each in self._entries if each.name in self._names)

    def __enter__(self) -> Any:
        return self

    def __exit__(self, *args: Any) -> None:
        self._entries.close()

    close = __exit__


def install(pairs: Any) -> None:
    """From now on what is at neither place is missing, and nothing else. `pairs` are paths in share folders, and the
    files and folders of the source that they lead to."""
    known = [(str(where), str(source)) for where, source in pairs]
    if not known:
        return
    folders: dict[str, dict[str, str]] = {}
    """What single files are installed in, by name, with the files of the source."""
    for where, source in known:
        if os.path.isfile(source):
            folder, name = os.path.split(where)
            folders.setdefault(folder, {})[name] = source
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

    def made(path: Any) -> Optional[dict[str, str]]:
        """What is in a folder that the build makes."""
        if not isinstance(path, (str, os.PathLike)):
            return None
        text = os.path.normpath(os.fspath(path))
        return folders[text] if text in folders and not exists(text) else None

    def folder_of(path: Any) -> Any:
        inside = made(path)
        return os.path.dirname(next(iter(inside.values()))) if inside else source_of(path)

    def listed(path: Any = ".") -> Any:
        inside = made(path)
        return list(inside) if inside else list_folder(source_of(path))

    def scanned(path: Any = ".") -> Any:
        inside = made(path)
        return _Entries(scan(folder_of(path)), inside) if inside else scan(source_of(path))

    list_folder, scan = os.listdir, os.scandir

    def redirected(function: Any) -> Any:
        @functools.wraps(function)
        def called(path: Any = ".", *args: Any, **kwargs: Any) -> Any:
            return function(folder_of(path), *args, **kwargs)

        return called

    def opened(file: Any, mode: str = "r", *args: Any, **kwargs: Any) -> Any:
        return open_file(source_of(file) if set("wax+").isdisjoint(mode) else file, mode, *args, **kwargs)

    open_file = io.open
    for name in ("stat", "access"):
        setattr(os, name, redirected(getattr(os, name)))
    os.listdir, os.scandir = listed, scanned
    for module in (builtins, io):
        module.open = opened  # type: ignore[attr-defined]
