"""The phrases that texts for users avoid are found, and what is written instead of them is not."""

import pytest
from support.terms import avoided


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("/n gets nothing of '/scan'", ["gets nothing of"]),
        ("What holds inside", ["holds", "What holds"]),
        ("is no substitution: roslaunch takes it as text", ["no substitution", "is no "]),
        ("Run the node anew in ROS2", ["anew", "ROS2"]),
        ("in VSCode", ["VSCode"]),
    ],
)
def test_a_phrase_to_avoid(text: str, found: list[str]) -> None:
    assert [each.split("'")[1] for each in avoided(text)] == found


@pytest.mark.parametrize(
    "text", ["'/chater' has no publisher", "there is no package 'x'", "ROS 2 is no longer found", "duplicate node name"]
)
def test_plain_words(text: str) -> None:
    assert avoided(text) == []
