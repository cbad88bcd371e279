"""What the command says when it cannot do what was asked."""

from __future__ import annotations

CLEAN, FOUND, FAILED, BROKEN = 0, 1, 2, 3
"""Exit codes: nothing to report, findings at or above `--fail-on`, could not do what was asked, an error of ours that
costs part of the result."""


class CannotDoError(Exception):
    """Ends the command with `FAILED` and its text on standard error."""
