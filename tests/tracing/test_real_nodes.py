"""What docs/real_nodes.md says of some real nodes still holds when they are traced and really run again."""

from __future__ import annotations

from pathlib import Path

import pytest
from tools.real_nodes import LAUNCHES, PAGE, TUTORIALS, missing, rows_of

pytestmark = pytest.mark.ros

SAMPLE = ("robot_state", "topic_tools", "topics", "services_and_more")
"""Launch files whose nodes need little beyond what the other tests do."""


def said(launch: str) -> list[str]:
    """The rows of the page."""
    return [line for line in PAGE.read_text().splitlines() if line.startswith(f"| {launch} |")]


@pytest.fixture(scope="module")
def scratch(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """One folder for all, as the tutorials are compiled once."""
    return tmp_path_factory.mktemp("real_nodes")


@pytest.mark.parametrize("launch", SAMPLE)
def test_a_row_of_the_page_is_what_happens(launch: str, scratch: Path) -> None:
    if launch in LAUNCHES:
        assert missing(LAUNCHES[launch]) == []
    assert [row.markdown() for row in rows_of(launch, scratch)] == said(launch)


def test_the_page_has_all_launch_files() -> None:
    assert [name for name in (*LAUNCHES, *TUTORIALS) if not said(name)] == []
