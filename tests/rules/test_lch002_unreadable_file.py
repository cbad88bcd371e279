"""LCH002: the launch file cannot be read."""

import pytest
from support.check import check, findings_of


def test_a_binary_file() -> None:
    (finding,) = findings_of("//- /main.launch\n\0\1\2")
    assert finding.rule == "LCH002"
    assert "/main.launch" in finding.message


@pytest.mark.silent
def test_letters_of_other_scripts() -> None:
    check("""
        <launch><param name="ä" value="日本"/></launch>
    """)
