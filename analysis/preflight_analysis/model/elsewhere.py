"""Paths that may be right elsewhere: on another machine, or where the launcher is started in another folder."""

from __future__ import annotations

import re

from preflight_analysis.documents.disk import Disk
from preflight_analysis.documents.document import Document
from preflight_analysis.documents.span import Location
from preflight_analysis.environment.installed_paths import package_around
from preflight_analysis.model.context import Context

_MISSING = re.compile(
    r"(?i)no such file|file ?not ?found|(?<!command )not found|does(?: not|n't) exist|bad file|error opening|"
    r"(?:can(?:not|'t)|could not|failed to|unable to) (?:be )?(?:open|read|find|load)|"
    r"invalid (?:\w+ )?(?:directory|folder|file|path)"
)
_PATH = re.compile(r"(?<![\w/.:~$})-])(/[\w.+-]+)/[\w.+/-]+")
_OF_OTHERS = re.compile(r"(/(?:home|Users|mnt|media)/[\w.+-]+)(?=/)")
"""Folders that are of one user, and where disks are mounted."""
_SCRIPT = re.compile(r"(?<!\S)/[^\s:]+: (?=(?:line )?\d+: )")
"""How a shell begins what it says: with the script, which is there."""
_RECORDING = re.compile(r"[\w+-]\.(?:bag|db3|mcap)(?:\.active)?\b")
_NO_RECORDING = "Error reading version line"
"""What rosbag says of a file that is none, as Git LFS leaves it where it has not fetched the recording."""
_SHARE = re.compile(r"\b(?:get_package_(?:share_directory|share_path|prefix)|FindPackage(?:Share|Prefix))\b")
_OF_BUILD = re.compile(r"""['"][\^(]?(?:\.[*+]\??|\(\.[*+]\??\))?/?(?:install|devel)\b""")
"""A text that begins with the name of a folder of what is built, or an expression for all that is before it: not one
that has all of a path."""
_ABOVE = re.compile(r"""['"][^'"\n]{0,200}(?<!\.)\.\.(?!\.)|\bpardir\b|\.parents?\b""")
"""How a program goes up from a folder."""
_WORKING_FOLDER = re.compile(r"\bPWD\b|\bgetcwd\(|\bcwd\(\)")


def absent_top(disk: Disk, path: str) -> str | None:
    """The top folder of a path where this machine has none of that name: the path is of another one, or of a container
    (`/sim_ws/src/...`)."""
    found = _PATH.match(path)
    return found[1] if found is not None and not disk.exists(found[1]) else None


def absent_top_said(disk: Disk, said: str) -> str | None:
    """Likewise of a file that a program did not find, as it said, and of the folder of a user or of a disk that is not
    here (`/home/somebody`)."""
    tops = [absent_top(disk, path) or absent_folder_of_others(disk, path) for path in paths_said(said)]
    return tops[0] if tops and all(tops) else None


def absent_folder_of_others(disk: Disk, path: str) -> str | None:
    """The folder of a user, or of a disk, that a path is below and that is not here (`/home/somebody`)."""
    found = _OF_OTHERS.match(path)
    return found[1] if found is not None and not disk.exists(found[1]) else None


def paths_said(said: str) -> tuple[str, ...]:
    """The absolute paths of files that a program did not find, as it said."""
    said = _SCRIPT.sub("", said)
    return tuple(found[0] for found in _PATH.finditer(said)) if _MISSING.search(said) is not None else ()


def lacks_recording(said: str) -> bool:
    """Whether a program says that it did not find a recording, which nobody keeps with the sources."""
    return _NO_RECORDING in said or (_MISSING.search(said) is not None and _RECORDING.search(said) is not None)


def depends_on_working_folder(context: Context, location: Location) -> bool:
    """Whether what is written at a place asks for the folder in which the launcher is started."""
    return _WORKING_FOLDER.search(context.text(location)) is not None


def asks_for_unbuilt_package(context: Context, file: str) -> bool:
    """Whether a Python launch file asks where a package is, and its own is not installed: such packages lie in their
    sources then, and not in `install/<name>/share/<name>`."""
    document = context.disk.text(file) if file.endswith(".py") else None
    owner = package_around(context.environment, file)
    if not isinstance(document, Document) or owner is None or context.environment.is_installed(owner):
        return False
    return _SHARE.search(document.text) is not None


def names_folder_of_build(text: str) -> bool:
    """Whether a text of the program is the name of a folder of what is built, or begins with it."""
    return _OF_BUILD.search(text) is not None


def depends_on_build(context: Context, path: str, file: str) -> bool:
    """Whether a Python launch file of a package that is not built makes a path by the place that packages are installed
    at: it goes up from there and out of the package, or takes that path apart."""
    if not asks_for_unbuilt_package(context, file):
        return False
    document = context.disk.text(file)
    text = document.text if isinstance(document, Document) else ""
    is_outside = package_around(context.environment, path) is None and path.split("/")[:2] == file.split("/")[:2]
    return (is_outside and _ABOVE.search(text) is not None) or names_folder_of_build(text)
