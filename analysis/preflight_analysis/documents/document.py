"""The shape of a parsed file: a tree that exists whatever the text looks like, and the list of what is malformed."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import field
from typing import NamedTuple

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.movable import Movable
from preflight_analysis.documents.span import LineIndex, Location, Span, version
from preflight_analysis.incremental.derived import Remembering


@dataclass(frozen=True, slots=True)
class SyntaxProblem:
    """Something malformed, at the place that has to be changed."""

    message: str
    span: Span


class SpannedText(NamedTuple):
    """Text after entities were decoded, with the way back to the source.

    `offsets` maps each index of `text`, and its end, to an offset in the document; `None` means one to one
    from `span.start`.
    """

    text: str
    span: Span
    offsets: tuple[int, ...] | None = None

    def to_document(self, index: int) -> int:
        """The document's offset of `text[index]`; `len(text)` gives the end."""
        if self.offsets is None:
            return self.span.start + index
        return self.offsets[index]

    def slice_span(self, start: int, end: int) -> Span:
        """Where `text[start:end]` stands in the document."""
        return Span(self.to_document(start), self.to_document(end))

    def moved(self, by: int) -> SpannedText:
        """The same text where what stands in front of it has become longer by so many characters."""
        offsets = tuple(offset + by for offset in self.offsets) if self.offsets is not None else None
        return SpannedText(self.text, self.span.moved(by), offsets)


class Attribute(NamedTuple):
    """`name="value"`; `span` covers all of it, `value.span` what is between the quotes."""

    name: str
    name_span: Span
    value: SpannedText
    span: Span

    def moved(self, by: int) -> Attribute:
        """The same where the text in front of it has become longer by so many characters."""
        return Attribute(self.name, self.name_span.moved(by), self.value.moved(by), self.span.moved(by))


@dataclass(frozen=True, slots=True)
class Text(Movable):
    """Character data or CDATA between tags."""

    content: SpannedText


@dataclass(frozen=True, slots=True)
class Comment(Movable):
    """`<!-- text -->`; `span` covers the delimiters."""

    content: SpannedText
    span: Span


@dataclass(frozen=True, slots=True)
class Element(Movable):
    """An element. `open_span` is its start tag, `span` reaches to the end of its end tag (or where it was given up)."""

    tag: str
    tag_span: Span
    attributes: tuple[Attribute, ...]
    children: tuple[Node, ...]
    open_span: Span
    span: Span

    def get(self, name: str) -> Attribute | None:
        """The first attribute of that name."""
        return next((a for a in self.attributes if a.name == name), None)

    @property
    def elements(self) -> Iterator[Element]:
        """Child elements in order."""
        return (c for c in self.children if isinstance(c, Element))


Node = Element | Comment | Text


@dataclass(frozen=True, slots=True)
class Document(Remembering):
    """One file's text and what it parses to. `digest` names the text; those with equal ones differ in their lines at
    most.

    `root` is the first top-level element, None in a file that has none yet. `entities` are the references, with
    their places, to entities that the file's DOCTYPE declares: they are never expanded, and stand as written
    (`&name;`) in the values and texts that hold them.
    """

    path: str
    text: str
    digest: str
    children: tuple[Node, ...]
    problems: tuple[SyntaxProblem, ...]
    lines: LineIndex = field(repr=False)
    entities: tuple[tuple[str, Span], ...] = ()

    @property
    def version(self) -> str:
        """Names text and lines: while it is the same, locations in the file are right."""
        return version(self.digest, self.lines)

    def location(self, span: Span) -> Location:
        """The location of a span of this text."""
        return self.lines.location(self.path, span)

    @property
    def root(self) -> Element | None:
        """The document element."""
        return next((c for c in self.children if isinstance(c, Element)), None)
