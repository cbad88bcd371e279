"""The texts of open documents, kept by ourselves: incremental edits are applied on lines split as LSP says."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from dataclasses import field, replace
from functools import lru_cache
from urllib.parse import quote, unquote_to_bytes, urlsplit

from lsprotocol.types import PositionEncodingKind, TextDocumentContentChangeEvent, TextDocumentContentChangePartial
from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import LineIndex

from preflight_server.lsp.positions import Positions


def to_path(uri: str) -> str | None:
    """The absolute path of a `file:` URI; None for `untitled:`, `git:` and whatever else is no file."""
    try:
        parts = urlsplit(uri)
    except ValueError:
        return None
    if parts.scheme != "file" or parts.netloc not in ("", "localhost"):
        return None
    # A file name may hold `?` and `#` only quoted, but some clients leave them as they are.
    path = uri.split(":", 1)[1].removeprefix("//").removeprefix("localhost")
    name = unquote_to_bytes(path.encode("utf-8", "surrogatepass"))
    return os.path.normpath(os.fsdecode(name)) if name.startswith(b"/") and b"\0" not in name else None


@lru_cache(maxsize=4096)
def to_uri(path: str) -> str:
    """The `file:` URI of an absolute path: its bytes, whatever the locale's encoding. A name that no file can have
    there, as a text may have one, is the URI of no file."""
    try:
        name = os.fsencode(path)
    except UnicodeEncodeError:
        name = path.encode("utf-8", "replace")
    return "file://" + quote(name, safe="/~")


@dataclass(frozen=True, slots=True)
class OpenDocument:
    """A document as the editor has it. `path` is None where the URI names no file."""

    uri: str
    path: str | None
    language_id: str
    version: int
    text: str
    lines: LineIndex = field(repr=False, compare=False)

    def positions(self, encoding: PositionEncodingKind | str) -> Positions:
        """Conversion for this text."""
        return Positions(self.text, self.lines, encoding)


class TextStore:
    """Open documents by URI, in the order in which they were opened."""

    def __init__(self) -> None:
        self.encoding: PositionEncodingKind | str = PositionEncodingKind.Utf16
        self._documents: dict[str, OpenDocument] = {}

    def __iter__(self) -> Iterator[OpenDocument]:
        return iter(tuple(self._documents.values()))

    def get(self, uri: str) -> OpenDocument | None:
        """The document, None if it is not open."""
        return self._documents.get(uri)

    def by_path(self, path: str) -> OpenDocument | None:
        """The open document of a file, under whatever spelling of its URI the client chose."""
        return next((d for d in self if d.path == path), None)

    def open(self, uri: str, language_id: str, version: int, text: str) -> OpenDocument:
        """Take the text over from the editor."""
        text = _without_surrogates(text)
        document = OpenDocument(uri, to_path(uri), language_id, version, text, LineIndex(text))
        self._documents[uri] = document
        return document

    def change(self, uri: str, version: int, changes: Iterable[TextDocumentContentChangeEvent]) -> OpenDocument | None:
        """Apply edits in order; each one's range speaks of the text after those before it. None if not open."""
        document = self._documents.get(uri)
        if document is None:
            return None
        for change in changes:
            text = _without_surrogates(change.text)
            if isinstance(change, TextDocumentContentChangePartial):
                positions = document.positions(self.encoding)
                start, end = sorted((positions.offset(change.range.start), positions.offset(change.range.end)))
                text = document.text[:start] + text + document.text[end:]
            document = replace(document, text=text, lines=LineIndex(text))
        self._documents[uri] = document = replace(document, version=version)
        return document

    def close(self, uri: str) -> OpenDocument | None:
        """Give the text back; None if it was not open."""
        return self._documents.pop(uri, None)


def _without_surrogates(text: str) -> str:
    """JSON can carry half a surrogate pair, which no file can: it becomes U+FFFD, also one UTF-16 unit wide."""
    try:
        text.encode()
    except UnicodeEncodeError:
        return text.encode("utf-16-le", "surrogatepass").decode("utf-16-le", "replace")
    return text
