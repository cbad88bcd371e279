"""Texts for the user, in a format that the client can show."""

from __future__ import annotations

from collections.abc import Sequence

from lsprotocol import types
from preflight_analysis.findings.markdown import plain


def markup(markdown: str, formats: Sequence[types.MarkupKind] | None) -> types.MarkupContent:
    """In the first format of the client's that we have; links mean nothing in plain text."""
    if formats and formats[0] == types.MarkupKind.PlainText:
        return types.MarkupContent(types.MarkupKind.PlainText, plain(markdown))
    return types.MarkupContent(types.MarkupKind.Markdown, markdown)


def counted(number: int, what: str) -> str:
    """How many there are of what, in words."""
    return f"{number} {what}" if number == 1 else f"{number} {what}s"
