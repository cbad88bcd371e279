"""The writer of `CMakeLists.txt`."""

from __future__ import annotations

import re

from preflight_analysis.documents.document import Document
from preflight_analysis.edits import layout
from preflight_analysis.edits.edit import Edit

_END = re.compile(r"^[ \t]*ament_package\s*\(", re.MULTILINE)


def install(document: Document, what: str, destination: str) -> tuple[Edit, ...]:
    """Install files or a folder (`FILES a b`, `DIRECTORY launch`) before the package is made. No edit where it is not
    seen to be made."""
    end = _END.search(document.text)
    if end is None:
        return ()
    newline = layout.newline(document.text)
    return (layout.insertion(document, end.start(), f"install({what} DESTINATION {destination}){newline}{newline}"),)
