"""The commands of a `CMakeLists.txt`, in the order in which they stand, those of a block within it."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import field

from preflight_analysis.dataclass import dataclass

MAX_DEPTH = 20
"""Of blocks, of folders, and of calls."""
_TOKEN = re.compile(
    r"""\#\[(?P<mark>=*)\[.*?\](?P=mark)\]      # bracket comment
      | \#[^\n]*
      | \[(?P<equals>=*)\[(?P<bracket>.*?)\](?P=equals)\]
      | "(?P<quoted>(?:[^"\\]|\\.)*)"
      | (?P<paren>[()])
      | (?P<word>(?:[^\s()#"\\]|\\.)+)
    """,
    re.DOTALL | re.VERBOSE,
)
_MAKES = re.compile(
    r"(?i)\b(?:execute_process|add_custom_command|add_custom_target|configure_file|externalproject_add|fetchcontent_\w+"
    r"|include\s*\(\s*\S+[./]|file\s*\(\s*(?:DOWNLOAD|MAKE_DIRECTORY|WRITE|GENERATE|COPY|CREATE_LINK))\b"
)
_WORD = re.compile(r"[^\s()\"]+")
_ENDS = {"foreach": "endforeach", "macro": "endmacro", "function": "endfunction", "if": "endif"}


@dataclass(frozen=True, slots=True)
class Word:
    """One argument of a command, with its variables not yet replaced."""

    text: str
    quoted: bool = False
    at: int = field(default=0, compare=False)
    """Where its text stands, without quotes."""


@dataclass(frozen=True, slots=True)
class Command:
    """A command, its name in small letters."""

    name: str
    words: tuple[Word, ...]
    inner: tuple[Command, ...] = ()
    """What stands between an `if`, `foreach`, `macro` or `function` and its end."""
    at: int = field(default=0, compare=False)
    """Where its name stands in the text."""


def may_make_files(text: str) -> bool:
    """Whether a file has a command by which a build makes files, or another file that may have one."""
    return _MAKES.search(text) is not None


def word_end(text: str, at: int) -> int:
    """Where the word ends that begins at an offset."""
    found = _WORD.match(text, at)
    return found.end() if found is not None else at


def commands(text: str) -> tuple[Command, ...]:
    """All of a file. Nothing raises; what is no command is left out."""
    flat = iter(list(_flat(text)))
    return _nested(flat, None, 0)


def _flat(text: str) -> Iterator[Command]:
    name: str | None = None
    words: list[Word] = []
    depth, at = 0, 0
    for token in _TOKEN.finditer(text):
        paren, word = token["paren"], token["word"]
        if paren == "(":
            depth += 1
        elif paren == ")":
            depth = max(depth - 1, 0)
            if not depth and name is not None:
                yield Command(name, tuple(words), at=at)
                name, words = None, []
        elif word is not None and not depth:
            name, words, at = word.lower(), [], token.start()
        elif word is not None:
            words.append(Word(word, at=token.start()))
        elif token["quoted"] is not None:
            words.append(Word(re.sub(r"\\(.)", r"\1", token["quoted"]), True, token.start("quoted")))
        elif token["bracket"] is not None:
            words.append(Word(token["bracket"], True, token.start("bracket")))


def _nested(flat: Iterator[Command], end: str | None, depth: int) -> tuple[Command, ...]:
    found: list[Command] = []
    for command in flat:
        if command.name == end:
            break
        if command.name in _ENDS and depth < MAX_DEPTH:
            inner = _nested(flat, _ENDS[command.name], depth + 1)
            found.append(Command(command.name, command.words, inner, command.at))
        else:
            found.append(command)
    return tuple(found)


def unbalanced(text: str) -> int | None:
    """Where the first parenthesis or quote stands that has no other end; None where all have."""
    opened: list[int] = []
    at = 0
    for token in _TOKEN.finditer(text):
        if '"' in text[at : token.start()]:
            return text.index('"', at)
        at = token.end()
        if token["paren"] == "(":
            opened.append(token.start())
        elif token["paren"] == ")":
            if not opened:
                return token.start()
            opened.pop()
    quote = text.find('"', at)
    return opened[0] if opened else quote if quote >= 0 else None
