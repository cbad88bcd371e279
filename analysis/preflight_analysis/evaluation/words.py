"""The words of command lines."""

import re
import shlex

_PLAIN = re.compile(r"[ \t\r\n!#-&(-\[\]-~]*\Z")
"""ASCII without quotes and backslashes, of which blanks alone make words: most texts, and `shlex` is slow."""


def words_of(text: str) -> list[str]:
    """The words of a command line; split at blanks where a quote is left open."""
    if _PLAIN.match(text) is not None:
        return text.split()
    try:
        return shlex.split(text)
    except ValueError:
        return text.split()
