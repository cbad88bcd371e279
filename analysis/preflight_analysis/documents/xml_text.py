"""Text as XML has it."""

from __future__ import annotations

import re
from collections.abc import Mapping

_BLANKS = re.compile(r"\s*")
_DOCTYPE = re.compile(r"<!DOCTYPE(?:[^<>\[]|\[[^\]]*\])*>")
_TAG = re.compile(r"<([\w:.-]+)(?=[\s/>]|\Z)")


def document_element(text: str) -> str | None:
    """The name of the first tag, behind declarations and comments; "" where something else is there, None where the
    text ends before."""
    at = 1 if text.startswith("\ufeff") else 0
    while True:
        blanks = _BLANKS.match(text, at)
        at = blanks.end() if blanks else at
        if text.startswith(("<?", "<!--"), at):
            closing = "?>" if text.startswith("<?", at) else "-->"
            close = text.find(closing, at + 2)
            if close < 0:
                return None
            at = close + len(closing)
        elif doctype := _DOCTYPE.match(text, at):
            at = doctype.end()
        elif text.startswith("<!DOCTYPE", at) or at >= len(text):
            return None
        else:
            found = _TAG.match(text, at)
            return found[1] if found is not None else ""


def quoted_attribute(value: str, entities: Mapping[str, str] | None = None) -> str:
    """The value of an attribute, escaped, in its quotes. `entities`: what else stands for something, and for what."""
    # It imports urllib, which imports all of HTTP and TLS: a tenth of the time of a check, for what few fixes need.
    from xml.sax.saxutils import quoteattr  # noqa: PLC0415

    return quoteattr(value, dict(entities or {}))
