"""What the command says when it cannot do what was asked."""

from __future__ import annotations

import os

CLEAN, FOUND, FAILED, BROKEN = 0, 1, 2, 3
"""Exit codes: nothing to report, findings at or above `--fail-on`, could not do what was asked, an error of ours that
costs part of the result."""


class CannotDoError(Exception):
    """Ends the command with `FAILED` and its text on standard error."""


def require(given: str) -> str:
    """The absolute path of what was given on the command line. Raises `CannotDoError` if it is not there, or cannot be
    looked at."""
    path = os.path.abspath(given)
    try:
        os.stat(path)
    except (FileNotFoundError, NotADirectoryError, ValueError):
        raise CannotDoError(f"{given} does not exist") from None
    except OSError as error:
        raise CannotDoError(f"{given} cannot be read: {str(error.strerror).lower()}") from None
    return path
