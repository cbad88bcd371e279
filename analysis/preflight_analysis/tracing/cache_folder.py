"""The folder of everything that is kept from one call to the next. It holds programs and what is believed of nodes, so
it has to be the user's own."""

from __future__ import annotations

import logging
import os
import stat
import tempfile
from pathlib import Path

import platformdirs

from preflight_analysis.tracing.once_per_process import once_per_process

VARIABLE = "ROS_PREFLIGHT_CACHE_DIR"
"""Names another folder: one that a CI keeps, for instance."""
_log = logging.getLogger(__name__)


def cache_folder(name: str) -> Path:
    """A folder in the one that the environment names, else in the one in the user's cache. Where either is not the
    user's own, nothing is kept beyond this process, and the log says so."""
    named = os.environ.get(VARIABLE)
    whole = Path(os.path.abspath(named)) if named else Path(platformdirs.user_cache_dir("ros-preflight"))
    refused = _refusal(whole) or _refusal(whole / name)
    return Path(_in_place_of(refused).name if refused is not None else whole) / name


def make_private(folder: Path) -> None:
    """Make a folder and those above it that are missing, for nobody else, whatever the umask. Raises `OSError`."""
    missing = []
    while not folder.is_dir():
        missing.append(folder)
        folder = folder.parent
    for each in reversed(missing):
        each.mkdir(mode=0o700, exist_ok=True)


@once_per_process
def _in_place_of(refused: str) -> tempfile.TemporaryDirectory[str]:
    _log.warning("%s, so nothing is kept: remove it, or name another one in %s", refused, VARIABLE)
    return tempfile.TemporaryDirectory(prefix="ros-preflight-cache-")


def _refusal(folder: Path) -> str | None:
    """Why what lies in a folder is not believed, None where it is the user's own or not there."""
    for look in (os.lstat, os.stat):
        try:
            found = look(folder)
        except OSError:
            return None
        if found.st_uid != os.geteuid():
            return f"the cache folder {folder} belongs to another user"
        if stat.S_ISDIR(found.st_mode) and found.st_mode & stat.S_IWOTH:
            return f"everybody can write to the cache folder {folder}"
    return None
