"""Whether what is ours in the user's cache folder is still what was put there: files get lost, or are cut where a disk
is full. What runs with a part of our code sees less, and says nothing of that."""

from __future__ import annotations

import hashlib
import os
import threading
from collections.abc import Iterable, Mapping
from pathlib import Path

_SEAL = ".sha256"


def seal(place: Path) -> None:
    """Note of what a file, or all files of a folder, consist. Raises `OSError`."""
    seal_of(place).write_text(_digest(place, _files(place)))


def seal_of(place: Path) -> Path:
    """Where that is noted: beside the file, or in the folder."""
    return place / _SEAL if place.is_dir() else place.with_name(place.name + _SEAL)


class Intact:
    """Says whether files and folders are as they were sealed: each is read once, and again when one of its files was
    lost, replaced or has another size. Usable from several threads at once."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._known: dict[Path, Mapping[str, tuple[int, int]]] = {}

    def __call__(self, place: Path) -> bool:
        """Whether a file or folder is there as it was sealed."""
        with self._lock:
            try:
                known = self._known.get(place)
                if known is None or any(_state(path) != state for path, state in known.items()):
                    self._known.pop(place, None)
                    states = {path: _state(path) for path in _files(place)}
                    if _digest(place, states) != seal_of(place).read_text():
                        return False
                    self._known[place] = states
                return True
            except OSError:
                self._known.pop(place, None)
                return False


def _files(place: Path) -> list[str]:
    if not place.is_dir():
        return [str(place)]
    return sorted(os.path.join(at, name) for at, _, names in os.walk(place) for name in names if name != _SEAL)


def _digest(place: Path, files: Iterable[str]) -> str:
    digest = hashlib.sha256()
    for path in files:
        content = Path(path).read_bytes()
        digest.update(f"{os.path.relpath(path, place)}\0{len(content)}\0".encode() + content)
    return digest.hexdigest()


def _state(path: str) -> tuple[int, int]:
    info = os.stat(path)
    return info.st_ino, info.st_size
