"""How far two names are apart is measured in one place."""

from __future__ import annotations

import ast
from pathlib import Path

from support.editor_harness import ROOT

_MEASURES = ("rapidfuzz", "difflib", "Levenshtein", "jellyfish")
_PATCH = "unified_diff"
"""It writes the differences of two texts, and measures nothing."""
_OURS = "slips.py"
_INSIDE = "tracing/agents/"
"""What runs in the sandbox has the standard library only."""


def test_one_module_measures() -> None:
    found = {}
    for folder in ("analysis/preflight_analysis", "server/preflight_server"):
        for path in (ROOT / folder).rglob("*.py"):
            below = str(path.relative_to(ROOT / folder))
            if not below.startswith(_INSIDE) and _measures(path):
                found[below] = path
    assert [*found] == [_OURS]


def _measures(path: Path) -> bool:
    modules = [
        each.module or "" if isinstance(each, ast.ImportFrom) else each.names[0].name
        for each in ast.walk(ast.parse(path.read_text()))
        if isinstance(each, ast.Import | ast.ImportFrom) and [name.name for name in each.names] != [_PATCH]
    ]
    return any(module.partition(".")[0] in _MEASURES for module in modules)
