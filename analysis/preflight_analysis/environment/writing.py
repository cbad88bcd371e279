"""Writing files that a user names: whole or not at all, and not where a link of a project leads out of it.

What is checked out from elsewhere may have a link by any name, so that `--output out/robot.yaml` would replace a file
of the user's home folder. A link that no project has is the user's own, and is followed.
"""

from __future__ import annotations

import contextlib
import errno
import os
import secrets
import stat

from preflight_analysis.environment.detect import project_of


def write_file(path: str | os.PathLike[str], data: bytes) -> None:
    """Replace a file, or make it with the folders that are missing above it. Its mode and owner stay; it has the old
    content or the new one at any moment, and links that lead to it stay. Raises OSError, whose `strerror` is for the
    user."""
    place, before = place_of(path), _status(path)
    if before is not None and not stat.S_ISREG(before.st_mode):
        with open(path, "wb") as stream:  # a terminal or a pipe, such as /dev/stdout
            stream.write(data)
        return
    folder, name = os.path.split(place)
    os.makedirs(folder, exist_ok=True)
    beside = os.path.join(folder, f".{name[:100]}.{secrets.token_hex(4)}.tmp")
    descriptor = os.open(beside, os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_NOFOLLOW | os.O_CLOEXEC, 0o666)
    try:
        with open(descriptor, "wb") as file:
            if before is not None:
                with contextlib.suppress(PermissionError):
                    os.fchown(file.fileno(), before.st_uid, before.st_gid)
                os.fchmod(file.fileno(), stat.S_IMODE(before.st_mode))
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        os.replace(beside, place)
    except BaseException:
        with contextlib.suppress(OSError):
            os.unlink(beside)
        raise


def place_of(path: str | os.PathLike[str]) -> str:
    """The path without links. Raises OSError where one that is part of a project leads out of it."""
    at = "/"
    for part in os.path.abspath(path).split("/")[1:]:
        link = os.path.join(at, part)
        if not os.path.islink(link):
            at = link
            continue
        at, project = os.path.realpath(link), project_of(link)
        if project is not None and os.path.commonpath((at, os.path.realpath(project))) != os.path.realpath(project):
            reason = f"{link} is a link that leads out of the project, to {at}; name the file itself"
            raise OSError(errno.ELOOP, reason, os.fspath(path))
    return at


def _status(path: str | os.PathLike[str]) -> os.stat_result | None:
    try:
        return os.stat(path)
    except FileNotFoundError:
        return None
