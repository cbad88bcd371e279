"""LCH014: an include of a file that cannot be read as a launch file."""

import pytest
from support.check import check, findings_of


def test_an_included_folder() -> None:
    assert [f.rule for f in findings_of('<launch><include file="/"/></launch>')] == ["LCH014"]


@pytest.mark.silent
def test_an_included_file_that_can_be_read() -> None:
    check("""
        <launch><include file="/inc.launch"/></launch>
        //- /inc.launch
        <launch/>
    """)
