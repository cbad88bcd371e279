"""The words of command lines."""

import shlex


def words_of(text: str) -> list[str]:
    """The words of a command line; split at blanks where a quote is left open."""
    try:
        return shlex.split(text)
    except ValueError:
        return text.split()
