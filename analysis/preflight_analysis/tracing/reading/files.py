"""Files as a launch file sees them that is read: those of the workspace and of packages, and what it writes itself."""

from __future__ import annotations

import io
import os
from collections.abc import Callable, Iterator, Sequence
from pathlib import PurePosixPath
from typing import Any, ClassVar, Protocol

from preflight_analysis.tracing.agents.anything import MARKS, Anything, UnknownText, is_unknown, readable, unknown_text
from preflight_analysis.tracing.reading.values import NotRead, check_size

MAX_FILES = 50
_TEMPORARY = "/tmp/preflight-"  # noqa: S108 - a name in answers, no file


class Disk(Protocol):
    """What there is, as `documents.disk.Disk` tells."""

    def exists(self, path: str) -> bool:
        """Whether there is anything."""

    def is_file(self, path: str) -> bool:
        """Whether it is a regular file."""

    def is_folder(self, path: str) -> bool:
        """Whether it is a folder."""

    def names(self, folder: str) -> tuple[str, ...]:
        """What is in a folder."""

    def real_path(self, path: str) -> str:
        """Without links."""

    def content(self, path: str) -> str | None:
        """The text of a file."""


Unknown = Callable[[str, str], Any]
Installed = Callable[[], Sequence[tuple[str, str]]]


class Files:
    """The disk within `roots`. `unknown` makes a stand-in for what only a run tells."""

    def __init__(
        self,
        disk: Disk,
        roots: tuple[str, ...],
        shares: tuple[str, ...],
        unknown: Unknown,
        installed: Installed,
        name: str,
    ) -> None:
        self._disk, self.unknown, self._name = disk, unknown, name
        self._installed = installed
        self._pairs: Sequence[tuple[str, str]] | None = None
        self.looked_in_vain = False
        self._roots, self._shares = roots, shares
        self._real: tuple[str, ...] | None = None
        self.written: dict[str, str] = {}
        self.given: dict[str, str] = {}
        """What earlier runs have written."""
        self.variables: dict[str, str] = {}
        """Of the environment, as the program has it."""

    def _is_within(self, path: str) -> bool:
        """Whether a path is of the workspace, where links lead nowhere else either, or of a package that is installed:
        what that links to is what the user has built."""
        plain = os.path.normpath(path)
        if not plain.startswith("/"):
            return False
        if not _is_below(plain, self._roots):
            return ".." not in path.split("/") and _is_below(plain, self._shares)
        if self._real is None:
            self._real = tuple(self._disk.real_path(root) for root in (*self._roots, *self._shares))
        return _is_below(self._disk.real_path(path), self._real)

    def _path(self, path: Any) -> str | None:
        """A path that may be looked at; None for any other."""
        if isinstance(path, (PurePosixPath, str)):
            text = str(path)
            if not is_unknown(text) and "\0" not in text and self._is_within(text):
                return self._source_of(text)
        return None

    def _source_of(self, path: str) -> str:
        """The file of the source that will be installed there, where there is none yet."""
        if self._disk.exists(path):
            return path
        if self._pairs is None:
            self._pairs = self._installed()
        plain = os.path.normpath(path)
        for where, source in self._pairs:
            if plain == where or plain.startswith(where + "/"):
                found = source + plain[len(where) :]
                if self._is_within(found) and self._disk.exists(found):
                    return found
            elif where.startswith(plain + "/"):
                self.unknown(f"the folder {plain!r}", "the build makes it")
        return path

    def _ask(self, name: str, path: Any, ask: Callable[[str], Any]) -> Any:
        text = os.fspath(path) if isinstance(path, (str, os.PathLike)) else path
        if not isinstance(text, str):
            raise TypeError(f"stat: path should be string, bytes, os.PathLike or integer, not {type(text).__name__}")
        if os.path.normpath(text) in self.made:
            return name != "isdir"
        if is_unknown(text):
            return Anything(f"{name}({readable(text)})")
        found = self._path(text)
        if found is None:
            return self.unknown(f"{name}({readable(text)!r})", "what is outside of the workspace is not looked at")
        answer = ask(found)
        self.looked_in_vain = self.looked_in_vain or answer is False
        return answer

    @property
    def made(self) -> dict[str, str]:
        """The files that were written, by earlier runs too."""
        return {**self.given, **self.written}

    def exists(self, path: Any) -> Any:
        """`os.path.exists`."""
        return self._ask("exists", path, self._disk.exists)

    def isfile(self, path: Any) -> Any:
        """`os.path.isfile`."""
        return self._ask("isfile", path, self._disk.is_file)

    def has(self, path: str) -> bool:
        """The same for what Python itself looks for."""
        found = self._path(path)
        return found is not None and self._disk.is_file(found)

    def isdir(self, path: Any) -> Any:
        """`os.path.isdir`."""
        return self._ask("isdir", path, self._disk.is_folder)

    def listdir(self, path: Any = ".") -> Any:
        """`os.listdir`."""
        found = self.names(path)
        if isinstance(found, list) and len(found) > 1:
            self.unknown("listdir()", "the order of files in a folder is another one on each disk")
        return found

    def names(self, path: Any) -> Any:
        """What is in a folder, for whom the order does not matter."""

        def of(folder: str) -> Any:
            if not self._disk.is_folder(folder):
                raise FileNotFoundError(2, "No such file or directory", folder)
            return list(self._disk.names(folder))

        return self._ask("listdir", path, of)

    def realpath(self, path: Any, **_: Any) -> Any:
        """`os.path.realpath`."""
        text = os.fspath(path)
        if is_unknown(text):
            return text
        found = text if self._path(text) is not None else None
        if found is None:
            return self.unknown(f"realpath({readable(text)!r})", "what is outside of the workspace is not looked at")
        return self._disk.real_path(found)

    def abspath(self, path: Any) -> Any:
        """`os.path.abspath`."""
        text = os.fspath(path)
        if not text.startswith("/") and not MARKS.match(text):
            return self.unknown(f"abspath({readable(text)!r})", "the folder that it is launched in is not known")
        return os.path.normpath(text) if text.startswith("/") else text

    def expanduser(self, text: str) -> Any:
        """`os.path.expanduser`."""
        home = dict.get(self.variables, "HOME")
        if text.startswith("~") and (not home or text[1:2] not in ("", "/")):
            return self.unknown("expanduser()", "the home folder is the user's")
        return home.rstrip("/") + text[1:] if home and text.startswith("~") else text

    def is_of_workspace(self, path: str) -> bool:
        """Whether a file is one of the user's own."""
        return _is_below(os.path.normpath(path), self._roots)

    def text(self, path: Any) -> Any:
        """What a file holds; a stand-in where only a run tells. Raises what `open` does."""
        name = os.fspath(path)
        if not isinstance(name, str):
            raise NotRead("a file by a number")
        if is_unknown(name):
            return UnknownText(name)  # as in a run it holds the name of what is not known
        made = self.made.get(os.path.normpath(name))
        if made is not None:
            return made
        found = self._path(name)
        if found is None:
            return self.unknown(f"open({readable(name)!r})", "what is outside of the workspace is not read")
        if self._disk.is_folder(found):
            raise IsADirectoryError(21, "Is a directory", name)
        if not self._disk.exists(found):
            raise FileNotFoundError(2, "No such file or directory", name)
        if not self._disk.is_file(found):
            return self.unknown(f"open({name!r})", "it is no regular file")
        text = self._disk.content(found)
        return self.unknown(f"open({name!r})", "the file cannot be read as text") if text is None else text

    def open(self, file: Any, mode: str = "r", *_: Any, **__: Any) -> Any:
        """`open`."""
        if isinstance(file, Anything):
            file = str(file)
        if isinstance(mode, str) and "w" in mode and str(file) in self.written:
            self.written[str(file)] = ""
            return Writing(self, str(file))
        if not isinstance(mode, str) or set(mode) - set("rtU"):
            self.unknown("open()", "the file is written")
            return Writing(self, None)
        text = self.text(file)
        known = isinstance(text, str) and not is_unknown(os.fspath(file))
        return Reading(text, os.fspath(file)) if known else UnknownFile(text)

    def temporary(self, mode: str = "w+b", *_: Any, suffix: Any = None, **__: Any) -> Any:
        """`tempfile.NamedTemporaryFile`."""
        if len(self.written) >= MAX_FILES:
            raise NotRead("too many files are written")
        name = f"{_TEMPORARY}{self._name}-{len(self.written)}{suffix or ''}"
        self.written[name] = ""
        return Writing(self, name)


def _is_below(path: str, folders: Sequence[str]) -> bool:
    return any(path == folder or path.startswith(folder + "/") for folder in folders)


class _File:
    """What a `with` block gets."""

    def __enter__(self) -> Any:
        return self

    def __exit__(self, *_: Any) -> None:
        return None

    def close(self) -> None:
        """Nothing is open."""


class Reading(_File):
    """A file that is read."""

    def __init__(self, text: str, name: str) -> None:
        self._text, self.name = io.StringIO(text), name

    def read(self, size: int = -1) -> str:
        """The rest."""
        return self._text.read(size)

    def readline(self) -> str:
        """The next line."""
        return self._text.readline()

    def readlines(self) -> list[str]:
        """The lines that are left."""
        return self._text.readlines()

    def __iter__(self) -> Iterator[str]:
        return iter(self._text.readlines())


class UnknownFile(_File):
    """A file of which nobody knows what is in it."""

    def __init__(self, of: Any) -> None:
        self._of = of

    def read(self, size: int = -1) -> Any:
        """A text that is not known."""
        return str(self._of)

    readline = read

    def readlines(self) -> Any:
        """Lines that are not known."""
        return self._of

    def __iter__(self) -> Any:
        return iter([str(self._of)])


class Writing(_File):
    """A file that is written; `name`: None where that is not kept."""

    def __init__(self, files: Files, name: str | None) -> None:
        self._files, self._name = files, name

    @property
    def name(self) -> str:
        """Its path."""
        return self._name or unknown_text("the file")

    def write(self, text: Any) -> int:
        """Add to it."""
        if self._name is not None and isinstance(text, str):
            self._files.written[self._name] += text
            check_size(self._files.written[self._name])
        return len(text) if isinstance(text, str) else 0

    def flush(self) -> None:
        """It is there already."""


class Path(PurePosixPath):
    """`pathlib.Path`."""

    _files: ClassVar[Files]
    """Of the reading that goes on."""

    def __init__(self, *parts: Any) -> None:
        super().__init__() if PurePosixPath.__init__ is object.__init__ else super().__init__(*parts)

    def exists(self, **_: Any) -> Any:
        """Whether there is anything."""
        return self._files.exists(str(self))

    def is_file(self) -> Any:
        """Whether it is a file."""
        return self._files.isfile(str(self))

    def is_dir(self) -> Any:
        """Whether it is a folder."""
        return self._files.isdir(str(self))

    def read_text(self, *_: Any, **__: Any) -> Any:
        """What it holds."""
        text = self._files.text(str(self))
        return text if isinstance(text, str) else str(text)

    def open(self, mode: str = "r", *_: Any, **__: Any) -> Any:
        """As `open`."""
        return self._files.open(str(self), mode)

    def resolve(self, strict: bool = False) -> Any:
        """Without links."""
        found = self._files.realpath(str(self))
        return type(self)(str(found))

    def absolute(self) -> Any:
        """With the folder."""
        return type(self)(str(self._files.abspath(str(self))))

    def expanduser(self) -> Any:
        """With the home folder of the user."""
        return type(self)(str(self._files.expanduser(str(self))))

    def glob(self, pattern: str) -> Any:
        """Files by a pattern."""
        return self._files.unknown(f"glob({pattern!r})", "the order of files in a folder is another one on each disk")

    rglob = glob

    def iterdir(self) -> Any:
        """What is in the folder."""
        return [self / name for name in self._files.listdir(str(self))]

    @classmethod
    def cwd(cls) -> Any:
        """The folder that it is launched in."""
        return cls(str(cls._files.unknown("Path.cwd()", "the folder that it is launched in is not known")))

    @classmethod
    def home(cls) -> Any:
        """The home folder."""
        return cls(str(cls._files.expanduser("~")))


Path.__name__ = Path.__qualname__ = "PosixPath"
Path.__module__ = "pathlib"
