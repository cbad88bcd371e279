"""What programs say as they end: what they lacked, and how that is said by Python, shells, roslaunch and the system."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import NamedTuple

_WORD = re.compile(r"\w+")
_NO_MODULE = re.compile(r"No module named '?([\w.]+)'?")
_NO_NAME = re.compile(r"cannot import name '(\w+)' from '([\w.]+)'?")
_NO_FILE = re.compile(r"No such file or directory:? '?([/\w.+-][^\s':]*)")
_FILE_BEFORE = re.compile(r"(?<![^\s:'])([/\w.+-][^\s':]*): No such file or directory")
_NO_PARAM = re.compile(r"(?i)\b(?:could not|cannot|can't|failed to|no|not|missing|without)\b.*\bparam(?:eter)?s?\b")
_WANTS = re.compile(r"(?i)\busage\b|\bargument|\bfile|\bpath\b|\bIndexError\b|\brequired\b|\bopen\b|\binput\b|\boption")
_KILLED = re.compile(
    r": line \d+: +\d+ (?:Trace/breakpoint trap|Segmentation fault|Illegal instruction|Bus error|Aborted|Killed)"
    r"(?: +\(core dumped\))? +([^\s]+)"
)
_CONFLICT = re.compile(r"\s*(?:<{7} |={7}$|>{7} )")
_BY_ANOTHER = (
    "The traceback for the exception was written to the log file", "CalledProcessError", "returned non-zero exit status"
)  # fmt: skip
_BEFORE_CAUSE = re.compile(r"(?:it ended with exit code \d+: )?(?:(?:\w+\.)+\w+: (?=\S))?")


class MissingName(NamedTuple):
    """A name that a module does not have."""

    name: str
    module: str


def words_of(said: str) -> frozenset[str]:
    """The words of a text, as names of parameters and arguments are."""
    return frozenset(_WORD.findall(said))


def missing_module(said: str) -> str | None:
    """The module that Python did not find."""
    found = _NO_MODULE.search(said)
    return found[1] if found is not None else None


def missing_name(said: str) -> MissingName | None:
    """The name that Python did not find in a module."""
    found = _NO_NAME.search(said)
    return MissingName(found[1], found[2]) if found is not None else None


def missing_file(said: str) -> str | None:
    """The file that was not there, relative to wherever the program was started or not."""
    found = _NO_FILE.search(said) or _FILE_BEFORE.search(said)
    return found[1] if found is not None else None


def lacks_param(said: str) -> bool:
    """Whether it says that a parameter is not set, whose name it may not say."""
    return _NO_PARAM.search(said) is not None


def asks_for_input(said: str) -> bool:
    """Whether it says that it is not told what to read."""
    return _WANTS.search(said) is not None


def killed_program(said: str) -> str | None:
    """The program that a signal killed, as a shell says."""
    found = _KILLED.search(said)
    return found[1] if found is not None else None


def is_of_called(said: str) -> bool:
    """Whether it is the last line of a roslaunch that a node starts, whose launch file is checked as others are, or of
    a node in Python for which another program failed: what that lacked (a repository, a device) is not said."""
    return any(each in said for each in _BY_ANOTHER)


def shows_conflict(said: Iterable[str]) -> bool:
    """Whether lines of a source have marks of a merge conflict."""
    return any(_CONFLICT.match(line) is not None for line in said)


def cause_of(reason: str) -> str:
    """The line that says why, if the reason has one: without the exit code, and without the package of an exception."""
    return _BEFORE_CAUSE.sub("", reason, count=1)
