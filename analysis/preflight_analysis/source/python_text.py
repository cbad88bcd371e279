"""Python text to a syntax tree, also where the text is not quite what this interpreter reads."""

from __future__ import annotations

import ast
import re
import threading
import warnings

MAX_CHARACTERS = 500_000
_MAX_REPAIRS = 60
_OLD_EXCEPT = re.compile(r"^(\s*except\b.*?),\s*(\w+)\s*:", re.DOTALL)
_INDENT = re.compile(r"\s*")
_warnings = threading.Lock()


def parse(text: str) -> ast.Module | None:
    """The tree; lines that do not parse (Python 2's `print x`, one being typed) are left out. None if none is left."""
    if len(text) > MAX_CHARACTERS:
        return None
    lines = text.expandtabs().splitlines() if "\t" in text else text.splitlines()
    for _ in range(_MAX_REPAIRS):
        try:
            with _warnings, warnings.catch_warnings():
                warnings.simplefilter("ignore")
                return ast.parse("\n".join(lines) + "\n")
        except SyntaxError as error:
            if not _repair(lines, error):
                return None
        except (ValueError, RecursionError, MemoryError):
            return None
    return None


def _repair(lines: list[str], error: SyntaxError) -> bool:
    """Make the line in error harmless; False if that is not possible or it was tried already."""
    at = min(error.lineno or 0, len(lines)) - 1
    while at >= 0 and not lines[at].strip():
        at -= 1
    if at < 0:
        return False
    line = lines[at]
    found = _OLD_EXCEPT.match(line)
    if found:
        lines[at] = f"{found[1]} as {found[2]}:{line[found.end() :]}"
        return True
    if line.strip() == "pass":
        lines[at] = ""
        return True
    indent = _INDENT.match(line)
    lines[at] = f"{indent[0] if indent else ''}pass"
    return True
