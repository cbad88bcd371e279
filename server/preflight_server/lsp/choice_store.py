"""The roots that the user chose in a workspace, kept from one start to the next."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from preflight_analysis.tracing.store import MAX_BYTES, Place, Store, digest_of
from preflight_analysis.workspace.index import Root

_SCHEMA = "1"
_MAX_ENTRY_BYTES = 4 << 20


class ChoiceStore(Store):
    """One entry for each workspace folder."""

    variants = 1

    def __init__(self, folder: Path | None = None, max_bytes: int = MAX_BYTES) -> None:
        super().__init__("choices", _SCHEMA, _MAX_ENTRY_BYTES, folder, max_bytes)

    def load(self, folder: str) -> dict[Root, frozenset[str]]:
        """The roots, the latest choice first, with the files that each reached; nothing is ever raised."""
        for path, entry in self._entries(self._place(folder)):
            self._used(path)
            try:
                return dict(_read(each) for each in entry["roots"])
            except (KeyError, TypeError, ValueError, AttributeError):
                break
        return {}

    def save(self, folder: str, chosen: Mapping[Root, frozenset[str]]) -> bool:
        """Keep what was chosen. False if it is too large or the disk refused."""
        roots = [[root.path, root.args, sorted(files)] for root, files in chosen.items()]
        return self._keep(self._place(folder), None, {"roots": roots})

    def _place(self, folder: str) -> Place:
        return Place(self._folder_of(digest_of({"workspace": folder})), "choices")


def _read(entry: Any) -> tuple[Root, frozenset[str]]:
    path, args, files = entry
    return Root.of(str(path), {str(name): str(value) for name, value in args}), frozenset(map(str, files))
