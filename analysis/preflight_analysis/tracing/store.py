"""What runs gave, on disk: entries that are valid for as long as nothing that they depended on has changed.

A file per entry, JSON, its name begins with the recipe's; the entries of what belongs together (the runs of one
executable) share a folder, which so is an index that cannot be out of date. An entry is written to a temporary name and
renamed, so that any number of processes can share the folder. Whatever cannot be read, is cut off or was written by
another version is a miss.
"""

from __future__ import annotations

import contextlib
import functools
import hashlib
import json
import os
import stat
import tempfile
import threading
import time
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any, NamedTuple

from preflight_analysis.tracing.cache_folder import cache_folder, make_private

MAX_BYTES = 64 << 20
VARIANTS = 32
"""How many entries one recipe may have: nodes of one executable with different parameters or names, files in
different states."""

_HASHED_BYTES = 8 << 20
"""Larger files count by size and time."""
_SYSTEM = ("/usr/", "/lib/", "/lib64/", "/opt/", "/etc/", "/bin/", "/sbin/")
_SWEEP_EVERY = 32
_TRIES = 20
_DEPTH = 3
"""How far below the store's folder its entries are."""
ABANDONED = 3600.0
"""Seconds after which a file that was being written belongs to a process that is gone."""


class Place(NamedTuple):
    """Where the entries of a recipe are: those files of `folder` whose names begin with `recipe`."""

    folder: Path
    recipe: str


class Store:
    """Entries below `folder`; together they stay below about `max_bytes`, least recently used first out.

    `schema` is the version of the entries, `name` the folder's name in the user's cache where none is given.
    """

    variants = VARIANTS

    def __init__(self, name: str, schema: str, entry_bytes: int, folder: Path | None, max_bytes: int) -> None:
        self.folder = folder or cache_folder(name)
        self.max_bytes = max_bytes
        self._schema = schema
        self._entry_bytes = entry_bytes
        self._stores = 0
        self._lock = threading.Lock()

    def _entries(self, place: Place) -> Iterator[tuple[Path, dict[str, Any]]]:
        """The readable entries of a recipe."""
        for path in _files(place):
            entry = self._read(path)
            if entry is not None:
                yield path, entry

    def _used(self, path: Path) -> None:
        """Note that an entry was of use."""
        with contextlib.suppress(OSError):
            os.utime(path)

    def _keep(self, place: Place, conditions: Any, entry: Mapping[str, Any]) -> bool:
        """Write an entry; one under the same conditions is replaced. False if it is too large or the disk refused."""
        try:
            data = json.dumps({"schema": self._schema, **entry}, sort_keys=True).encode()
        except (TypeError, ValueError):
            return False
        # The check sum tells a truncated or overwritten file; the content is nobody's secret.
        data = hashlib.sha256(data).hexdigest().encode() + b"\n" + data
        if len(data) > self._entry_bytes:
            return False
        name = hashlib.sha256(json.dumps(conditions, sort_keys=True).encode()).hexdigest()
        path = place.folder / f"{place.recipe}-{name[:32]}.json"
        try:
            _write(path, data)
            self._trim(place)
            self._sweep()
        except OSError:
            return False
        return True

    def _place_of(self, recipe: Mapping[str, Any], folder: Path | None = None) -> Place:
        """Where the entries of a recipe are: in `folder`, which it shares with others, or in one of its own."""
        digest = digest_of({"agents": _agents_digest(), "schema": self._schema, **recipe})
        return Place(folder or self._folder_of(digest), digest[:32])

    def _folder_of(self, digest: str) -> Path:
        """A folder of entries that belong together, or of those of one recipe."""
        return self.folder / digest[:2] / digest

    def _read(self, path: Path) -> dict[str, Any] | None:
        try:
            info = path.stat()
            if not stat.S_ISREG(info.st_mode) or info.st_size > self._entry_bytes:
                return None
            checksum, _, data = path.read_bytes().partition(b"\n")
            if hashlib.sha256(data).hexdigest().encode() != checksum:
                return None
            entry = json.loads(data)
        except (OSError, ValueError, RecursionError):
            return None
        return entry if isinstance(entry, dict) and entry.get("schema") == self._schema else None

    def _trim(self, place: Place) -> None:
        entries = sorted(_files(place), key=_last_used)
        for path in entries[: max(0, len(entries) - self.variants)]:
            path.unlink(missing_ok=True)

    def _sweep(self) -> None:
        with self._lock:
            self._stores += 1
            if self._stores % _SWEEP_EVERY != 1:
                return
        self.sweep()

    def clear(self) -> tuple[int, int]:
        """Remove all entries; how many there were, and their bytes. Files that are none of ours stay."""
        entries, freed = 0, 0
        for path in _below(self.folder, _DEPTH):
            if path.suffix == ".json":
                with contextlib.suppress(OSError):
                    size = path.lstat().st_size
                    path.unlink()
                    entries, freed = entries + 1, freed + size
                    path.parent.rmdir()
        return entries, freed

    def sweep(self) -> None:
        """Remove the least recently used entries until the rest fits, and what interrupted writes left behind. Files
        that are none of ours stay."""
        entries: list[tuple[float, int, Path]] = []
        for path in _below(self.folder, _DEPTH):
            unfinished = path.name.startswith(".") and path.suffix == ".tmp"
            if not unfinished and path.suffix != ".json":
                continue
            with contextlib.suppress(OSError):
                info = path.lstat()
                if unfinished:
                    if time.time() - info.st_mtime > ABANDONED:
                        path.unlink()
                elif stat.S_ISREG(info.st_mode):
                    entries.append((info.st_mtime, info.st_size, path))
        total = sum(size for _, size, _ in entries)
        for _, size, path in sorted(entries):
            if total <= self.max_bytes:
                break
            with contextlib.suppress(OSError):
                path.unlink()
                total -= size
                path.parent.rmdir()


def _below(folder: Path, depth: int) -> Iterator[Path]:
    """What lies so many levels below a folder, links not followed. Other processes may be taking it away meanwhile."""
    try:
        found = [] if folder.is_symlink() and depth < _DEPTH else os.listdir(folder)
    except OSError:
        return
    for name in found:
        if depth == 1:
            yield folder / name
        else:
            yield from _below(folder / name, depth - 1)


def _files(place: Place) -> list[Path]:
    """The files of a recipe's entries; sorted, so that the order does not depend on the disk."""
    try:
        found = os.listdir(place.folder)
    except OSError:
        return []
    start = f"{place.recipe}-"
    return [place.folder / name for name in sorted(found) if name.startswith(start) and name.endswith(".json")]


def fingerprint(path: str) -> str:
    """What tells that a file is the same: its content's digest, for the system's files time and size; "" if absent.

    Only regular files are opened: the name may come from a node.
    """
    try:
        info = os.stat(path)
    except (OSError, ValueError):
        return ""
    if not stat.S_ISREG(info.st_mode):
        return "no file"
    if not info.st_size:
        # The kernel's own files claim it too, and reading may take away what is there: /proc/kmsg.
        return "empty"
    if path.startswith(_SYSTEM) or info.st_size > _HASHED_BYTES:
        return f"{info.st_mtime_ns}:{info.st_size}"
    return _digest(path, info.st_mtime_ns, info.st_size, info.st_ino, info.st_ctime_ns)


@functools.lru_cache(maxsize=4096)
def _digest(path: str, *_state: int) -> str:
    try:
        with os.fdopen(os.open(path, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC), "rb") as file:
            return hashlib.sha256(file.read(_HASHED_BYTES) or b"").hexdigest()
    except OSError:
        return "unreadable"


def fingerprint_of_text(text: str) -> str:
    """That of a file of the user which has just this text."""
    return hashlib.sha256(text.encode("utf-8", "replace")).hexdigest()


def listing(folder: str) -> str:
    """A digest of the names in a folder that an `import` could find."""
    try:
        found = sorted(n for n in os.listdir(folder) if n.endswith((".py", ".so", ".pth", ".zip")) or n.isidentifier())
    except OSError:
        return ""
    return hashlib.sha256("\0".join(found).encode(errors="surrogatepass")).hexdigest()


def identity(path: str) -> str:
    """What tells before and after a run whether a path led to the same file all the time, but for what was put back
    meanwhile: that `any_changed_since` sees."""
    try:
        info = os.stat(path)
    except (OSError, ValueError):
        return ""
    return repr((os.path.realpath(path), fingerprint(path), info.st_dev, info.st_ino, info.st_ctime_ns))


def any_changed_since(paths: Iterable[str], moment: float) -> bool:
    """Whether a file was written, replaced or removed after a moment (seconds since the epoch), or a link or folder on
    the way to it was: a run that read it may have read either.

    By the time of the inode's change, which nobody can set. A folder has a later one than that of its content when it
    was renamed itself.
    """
    seen: set[str] = set()
    return any(
        _changed_since(at, moment)
        for path in paths
        for given in (path, os.path.realpath(path))
        for at in _way_to(given, seen)
    )


def _way_to(path: str, seen: set[str]) -> Iterator[str]:
    while path not in seen:
        seen.add(path)
        yield path
        path = os.path.dirname(path)


def _changed_since(path: str, moment: float) -> bool:
    try:
        info = os.lstat(path)
    except (OSError, ValueError):
        return False
    if stat.S_ISDIR(info.st_mode):
        return info.st_ctime >= moment and info.st_ctime_ns != info.st_mtime_ns
    return max(info.st_mtime, info.st_ctime) >= moment


@functools.lru_cache(maxsize=1)
def _agents_digest() -> str:
    """Of our own code that makes a trace: another version of it sees other things."""
    digest = hashlib.sha256()
    for path in sorted(p for p in Path(__file__).parent.glob("**/*") if p.suffix in (".py", ".cpp", ".hpp")):
        digest.update(path.read_bytes())
    return digest.hexdigest()


def digest_of(named: Mapping[str, Any]) -> str:
    """What names a recipe, or what entries have in common."""
    return hashlib.sha256(json.dumps(named, sort_keys=True).encode(errors="surrogatepass")).hexdigest()


def _last_used(path: Path) -> float:
    try:
        return path.stat().st_mtime
    except OSError:
        return 0.0


def _write(path: Path, data: bytes) -> None:
    descriptor, temporary = _temporary(path.parent)
    try:
        with os.fdopen(descriptor, "wb") as file:
            file.write(data)
        os.replace(temporary, path)
    except OSError:
        with contextlib.suppress(OSError):
            os.unlink(temporary)
        raise


def _temporary(folder: Path) -> tuple[int, str]:
    """A new file in a folder, which is made. As long as it is empty, another process may sweep it away."""
    for _ in range(_TRIES):
        # `mkdir` says that it exists, too, where it is gone a moment later.
        with contextlib.suppress(FileNotFoundError, FileExistsError):
            make_private(folder)
            return tempfile.mkstemp(dir=folder, prefix=".", suffix=".tmp")
    raise FileNotFoundError(folder)
