"""XML to Document. The tree is that of the tolerant scanner; whether a text is well-formed, expat decides."""

from __future__ import annotations

import re
from xml.parsers import expat

from preflight_analysis.documents.document import Document, SyntaxProblem
from preflight_analysis.documents.lazy_pattern import lazy_pattern
from preflight_analysis.documents.reading import digest
from preflight_analysis.documents.span import LineIndex, Span
from preflight_analysis.documents.xml_edit import edited_children
from preflight_analysis.documents.xml_patterns import NAME
from preflight_analysis.documents.xml_scanner import Scan, scan

MAX_PROBLEMS = 100
"""A text that is no XML at all has one per character or so; nobody reads them."""

_WORD = lazy_pattern(f"</?(?:{NAME})?|{NAME}|[^ \t\r\n]")
_DECLARATION = re.compile("\ufeff?<\\?xml[ \t\r\n][^>]*")
_ENCODING = re.compile("[ \t\r\n]encoding[ \t\r\n]*=[ \t\r\n]*(?:\"([^\"]*)\"|'([^']*)')")
_CONTINUATION_BYTES = bytes(range(0x80, 0xC0))
_PARAMETER_REFERENCE = lazy_pattern(f"%{NAME};")


def parse_xml(
    path: str,
    text: str,
    encoding: str | None = "utf-8",
    lines: LineIndex | None = None,
    before: Document | None = None,
) -> Document:
    """Parse the text of an XML file, whatever it looks like, in time linear in its length. Never raises.

    `encoding` is that of the file, None if it is not known; `lines` are those of the text, where somebody has them.
    `problems` is empty exactly when expat, the parser that roslaunch uses through minidom, takes the text and the
    encoding that it declares (an empty text aside: it has no root and no problem). Values are decoded and normalised as
    XML says. The entities of a DOCTYPE are not expanded, so what is wrong inside of their replacement text is not seen.
    `before` is what another text gave, an earlier one of the file; it is quicker then, and the same.
    """
    lines = lines or LineIndex(text)
    wrong_encoding = _encoding_complaint(text, (encoding or "").lower())
    if before is not None and wrong_encoding is None and (children := edited_children(before, text, lines)) is not None:
        scanned = Scan(children, (), (), frozenset(), Span(0, 0))
        if _expat_complaint(text, scanned) is None:
            return Document(path, text, digest(text), children, (), lines)
    scanned = scan(text, lines)
    complaint = _expat_complaint(text, scanned) or wrong_encoding
    if complaint is None:
        problems: tuple[SyntaxProblem, ...] = ()
    elif scanned.problems:
        problems = tuple(sorted(scanned.problems, key=lambda p: p.span)[:MAX_PROBLEMS])
    else:
        problems = (complaint,)
    return Document(path, text, digest(text), scanned.children, problems, lines, scanned.entities)


def without_comments(text: str) -> str:
    """The text, of the same length, with blanks for its comments; one that is not closed is none."""
    pieces: list[str] = []
    at = 0
    while (start := text.find("<!--", at)) >= 0 and (close := text.find("-->", start + 4)) >= 0:
        pieces += (text[at:start], " " * (close + 3 - start))
        at = close + 3
    return "".join((*pieces, text[at:]))


def _expat_complaint(text: str, scanned: Scan) -> SyntaxProblem | None:
    """What expat has against the text, None when it is well-formed or has no element yet.

    expat is as safe here as the text that it gets: references to the entities that the DOCTYPE declares are blotted
    out, so that there is nothing to expand ("billion laughs"), and it never opens an external one by itself.
    """
    parser = expat.ParserCreate("utf-8", namespace_separator=" ")  # with namespaces, as minidom has it
    data = _without_expansions(text, scanned).encode("utf-8", "surrogatepass")
    try:
        parser.Parse(data, True)
    except expat.ExpatError as error:
        if error.code == expat.errors.codes[expat.errors.XML_ERROR_NO_ELEMENTS] and not scanned.has_element:
            return None
        # expat counts bytes, we code points: each has one byte that is no continuation byte.
        before = data[: parser.ErrorByteIndex].translate(None, _CONTINUATION_BYTES)
        span = _span_at(text, len(before))
        if error.code == expat.errors.codes[expat.errors.XML_ERROR_XML_DECL]:
            span = _declaration(text) or span
        return SyntaxProblem(_message(error.code), span)
    return None


def _declaration(text: str) -> Span | None:
    found = _DECLARATION.match(text, 0, 300)
    return Span(found.start() + (text[0] == "\ufeff"), found.end()) if found else None


def _encoding_complaint(text: str, encoding: str) -> SyntaxProblem | None:
    """What expat has against the encoding of the file, or against the one that the XML declaration names."""
    if encoding.startswith("utf-32"):
        return SyntaxProblem("the file is in UTF-32, which the XML parser does not know; write it in UTF-8", Span(0, 1))
    if "encoding" not in text[:300]:
        return None
    declaration = _declaration(text)
    found = _ENCODING.search(text, declaration.start, declaration.end) if declaration else None
    if found is None:
        return None
    name, span = found[1] or found[2] or "", Span(*found.span(1 if found[1] is not None else 2))
    wide = name.lower().startswith("utf-16")
    if encoding.startswith("utf-16"):
        fits = name.lower() in ("utf-16", encoding.replace("16-", "16"))
        return (
            None if fits else SyntaxProblem(f"the file is in {encoding.upper()} and not, as it says, in '{name}'", span)
        )
    if name in ("utf-8", "UTF-8") or (wide and not encoding):
        return None
    try:
        expat.ParserCreate().Parse(f'<?xml version="1.0" encoding="{name}"?><a/>'.encode(), True)
    except (expat.ExpatError, LookupError, ValueError):
        return SyntaxProblem(f"the file is not in the encoding '{name}', or XML does not know it; it is UTF-8", span)
    return None


def _message(code: int) -> str:
    if code == expat.errors.codes[expat.errors.XML_ERROR_UNBOUND_PREFIX]:
        return "a prefix is used here that no xmlns:... attribute declares"
    return f"not well-formed XML: {expat.errors.messages[code]}"


def _span_at(text: str, offset: int) -> Span:
    """The word at `offset`; the last one of the text when expat complains about its end."""
    if offset >= len(text):
        end = len(text.rstrip())
        return Span(max(0, end - 1), end)
    found = _WORD.match(text, offset)
    return Span(offset, found.end() if found else offset + 1)


def _without_expansions(text: str, scanned: Scan) -> str:
    """The text, of the same length, in which no entity of its own is referred to.

    An opening parenthesis is character data where a reference may stand, and an error where it may not.
    """
    if not scanned.declared:
        return text
    names = "|".join(sorted(map(re.escape, scanned.declared)))
    masked = re.sub(f"&(?:{names});", lambda m: "(" * len(m[0]), text)
    subset = scanned.doctype
    blank = _PARAMETER_REFERENCE.sub(lambda m: " " * len(m[0]), masked[subset.start : subset.end])
    return masked[: subset.start] + blank + masked[subset.end :]
