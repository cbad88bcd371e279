"""The page of the JSON formats has all of them, and no others."""

import re
from pathlib import Path

ROOT = Path(__file__).parent.parent.parent
_SCHEMA = re.compile(r'"(ros-preflight/[a-z]+/\d+)"')


def test_each_schema_has_its_row() -> None:
    sources = [path.read_text() for part in ("analysis", "server") for path in (ROOT / part).rglob("*.py")]
    written = {name for text in sources for name in _SCHEMA.findall(text)} - {"ros-preflight/index/2"}  # our own cache
    rows = re.findall(r"^\| `(ros-preflight/[^`]+)` \|", (ROOT / "docs/formats.md").read_text(), re.M)
    assert sorted(rows) == sorted(written)
