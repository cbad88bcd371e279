"""Edits are made by the writers of formats alone."""

import re
from pathlib import Path

_ANALYSIS = Path(__file__).parents[2] / "analysis" / "preflight_analysis"
_MADE = re.compile(r"(?<![\w.])Edit\(")
_OF_THE_ANNOTATION_LANGUAGE = {"graph/outdated.py", "findings/suppression.py"}
"""What stands within a comment of ours is no text of the file's format."""


def test_edits_are_made_by_writers() -> None:
    made = {
        str(path.relative_to(_ANALYSIS))
        for path in _ANALYSIS.rglob("*.py")
        if _MADE.search(path.read_text()) and path.parent.name != "edits"
    }
    assert made - _OF_THE_ANNOTATION_LANGUAGE == set()
