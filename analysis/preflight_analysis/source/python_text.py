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
_TYPE_STATEMENT = re.compile(r"^(\s*)type\s+(\w+)(?:\[[^=]*\])?\s*=(?!=)")
"""An alias of a type, as Python has it since 3.12 (PEP 695)."""
_OPEN_F_STRING = re.compile(r"""(?<![\w"'])(?:[rR]?[fF]|[fF][rR])(["'])(?!\1)""")
_QUOTES = {'"': "'", "'": '"'}
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
    newer = requoted(_TYPE_STATEMENT.sub(r"\1\2 =", line))
    if newer != line:
        lines[at] = newer
        return True
    if line.strip() == "pass":
        lines[at] = ""
        return True
    indent = _INDENT.match(line)
    lines[at] = f"{indent[0] if indent else ''}pass"
    return True


def requoted(line: str) -> str:
    """A line in which no f-string has its own quotes within its expressions, as Python allows it since 3.12 (PEP 701):
    those within are exchanged for the other ones, where nothing speaks against it."""
    at = 0
    while found := _OPEN_F_STRING.search(line, at):
        exchanged = _exchanged(line, found.end(), found[1])
        if exchanged is None:
            at = found.end()
        else:
            line, at = exchanged
    return line


def _exchanged(line: str, start: int, quote: str) -> tuple[str, int] | None:
    """The line with other quotes in the expressions of the f-string whose text begins at `start`, and where that ends.
    None where it has no end, or where other quotes are no help."""
    at, depth, letters = start, 0, list(line)
    while at < len(line):
        letter = line[at]
        if depth == 0 and letter == "\\":
            at += 1
        elif depth == 0 and letter == quote:
            return "".join(letters), at + 1
        elif letter in "{([" and (depth or letter == "{"):
            depth += 1
        elif letter in "})]" and depth:
            depth -= 1
        elif depth and letter in _QUOTES:
            end = line.find(letter, at + 1)
            within = line[at + 1 : end]
            if end < 0 or "\\" in within or (letter == quote and _QUOTES[quote] in within):
                return None
            letters[at] = letters[end] = _QUOTES[quote]
            at = end
        at += 1
    return None
