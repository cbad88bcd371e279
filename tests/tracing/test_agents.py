"""What is injected into a node depends on nothing but its own interpreter, 3.8 or later, and aspectlib."""

from __future__ import annotations

import ast
import sys
from pathlib import Path

import pytest
from preflight_analysis.tracing import agents

FILES = sorted(Path(agents.__file__).parent.glob("*.py"))


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.name)
def test_agents_parse_as_python_3_8_and_import_the_standard_library_alone(path: Path) -> None:
    tree = ast.parse(path.read_text(), feature_version=(3, 8))
    imported = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            imported |= {alias.name.partition(".")[0] for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.level == 0:
            imported.add(str(node.module).partition(".")[0])
    assert imported - set(sys.stdlib_module_names) <= {"aspectlib", "preflight_agents"}
    assert "__future__" in imported or len(tree.body) == 1, "annotations must not be evaluated there"
