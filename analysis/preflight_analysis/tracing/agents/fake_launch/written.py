"""Files that a launch file writes where the sandbox lets none be written: into the share folder of a package, for
instance. They lie in a folder of temporary files, and whoever asks for them by their own path gets them from there.
"""

from __future__ import annotations

import errno
import functools
import os
import pathlib
import tempfile
from typing import Any

FOLDER = "preflight_written"
"""In the folder of temporary files."""
_WRITES = frozenset("wax+")


def install(open_file: Any) -> Any:
    """From now on folders can be made and asked for anywhere; `open` that does likewise."""
    for of, names in (
        (os.path, ("exists", "lexists", "isfile", "isdir", "getsize")),
        (os, ("listdir", "stat", "chmod")),
    ):
        for name in names:
            setattr(of, name, _elsewhere(getattr(of, name)))
    for name in ("exists", "is_file", "is_dir"):
        setattr(pathlib.Path, name, _of_path(getattr(pathlib.Path, name)))
    os.mkdir = _made(os.mkdir)
    os.symlink = _linked(os.symlink)

    def opened(file: Any, mode: Any = "r", *args: Any, **kwargs: Any) -> Any:
        if _is_path(file):
            return _open(open_file, os.fspath(file), mode, args, kwargs)
        return open_file(file, mode, *args, **kwargs)

    return opened


def place(path: str) -> str:
    """Where a file lies: at its path, or where it was written instead."""
    other = _other(path)
    return other if other in _moved else path


def own_path(path: str) -> str:
    """The path of a file that lies in our folder, as the launch file has it."""
    folder = _folder()
    return path[len(folder) :] if path.startswith(folder + os.sep) else path


_moved: set[str] = set()
"""What lies in our folder."""
_exists = os.path.lexists


def _folder() -> str:
    return os.path.join(tempfile.gettempdir(), FOLDER)


def _other(path: str) -> str:
    return _folder() + os.path.abspath(path)


def _is_path(file: Any) -> bool:
    return isinstance(file, str) or (isinstance(file, os.PathLike) and isinstance(os.fspath(file), str))


def _open(open_file: Any, path: str, mode: Any, args: Any, kwargs: Any) -> Any:
    other = _other(path)
    if other not in _moved:
        is_written = isinstance(mode, str) and not _WRITES.isdisjoint(mode)
        try:
            if not is_written or os.path.dirname(other) not in _moved:
                return open_file(path, mode, *args, **kwargs)
        except OSError as error:
            keeps = _exists(path) and not {"a", "+"}.isdisjoint(mode)  # what is there would be lost
            if error.errno != errno.EROFS or not is_written or keeps:
                raise
        _make(os.path.dirname(other))
        _moved.add(other)
    return open_file(other, mode, *args, **kwargs)


def _made(mkdir: Any) -> Any:
    @functools.wraps(mkdir)
    def called(path: Any, *args: Any, **kwargs: Any) -> None:
        try:
            mkdir(path, *args, **kwargs)
        except OSError as error:
            other = _other(os.fspath(path)) if _is_path(path) else ""
            is_within = error.errno == errno.ENOENT and os.path.dirname(other) in _moved
            if not other or not (error.errno == errno.EROFS or is_within):
                raise
            if other in _moved:
                raise FileExistsError(errno.EEXIST, os.strerror(errno.EEXIST), path) from None
            _make(other)

    return called


def _linked(symlink: Any) -> Any:
    @functools.wraps(symlink)
    def called(source: Any, path: Any, *args: Any, **kwargs: Any) -> None:
        other = _other(os.fspath(path)) if _is_path(path) else ""
        try:
            symlink(source, path, *args, **kwargs)
        except OSError as error:
            if error.errno not in (errno.EROFS, errno.ENOENT) or os.path.dirname(other) not in _moved:
                raise
            symlink(source, other, *args, **kwargs)
            _moved.add(other)

    return called


def _make(folder: str) -> None:
    os.makedirs(folder, exist_ok=True)
    while folder != _folder():
        _moved.add(folder)
        folder = os.path.dirname(folder)


def _elsewhere(function: Any) -> Any:
    @functools.wraps(function)
    def called(*args: Any, **kwargs: Any) -> Any:
        if _moved and args and isinstance(args[0], str):
            return function(place(args[0]), *args[1:], **kwargs)
        return function(*args, **kwargs)

    return called


def _of_path(function: Any) -> Any:
    @functools.wraps(function)
    def called(self: Any, *args: Any, **kwargs: Any) -> Any:
        return function(type(self)(place(os.fspath(self))) if _moved else self, *args, **kwargs)

    return called
