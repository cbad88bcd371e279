"""Every fix that is offered is tried: files parse, the finding is gone, no error is new. `tests/tools/fixes.py` tries
those of a corpus; `support.check.check` those of all rules' own cases."""

import shutil
from collections import Counter
from pathlib import Path

import pytest
from support.fix_property import Try
from support.mistakes import write_mistakes
from tools.fixes import report, table, tried_in

_FIXTURES = Path(__file__).parents[2] / "fixtures"


@pytest.mark.ros
def test_fixes_of_simple_mistakes_in_each_language(tmp_path: Path) -> None:
    write_mistakes(tmp_path)
    tried = tried_in(tmp_path, run=True)
    assert [each for each in tried if each.wrong is not None] == []
    formats = Counter(each.format for each in tried)
    assert min(formats[".py"], formats[".xml"], formats[".yaml"]) > 15, table(tried)
    titles = {(each.format, each.title) for each in tried}
    for form in (".py", ".xml", ".yaml"):
        for title in ("Replace 'sped' with 'speed'", "Declare argument 'sped'", "Do not pass argument 'foo'"):
            assert (form, title) in titles
        assert (form, "Write 'max_speed' as a double") in titles
    for title in ("Put the values below 'ros__parameters'", "Replace 'ros_parameters' with 'ros__parameters'"):
        assert (".yaml", title) in titles


def test_the_exit_code_is_0_only_if_all_are_right() -> None:
    right, wrong = Try("PKG001", ".launch", "Replace it", None), Try("PKG001", ".launch", "Replace it", "new errors")
    assert [report(tried) for tried in ([right], [right, wrong], [])] == [0, 1, 1]


@pytest.mark.slow
@pytest.mark.parametrize("name", ["ros1/demo", "ros1/robot", "ros1/tutorials", "ros2/chapter", "ros1/meaning"])
def test_fixes_of_the_fixtures(name: str, tmp_path: Path) -> None:
    shutil.copytree(_FIXTURES / name, tmp_path / "copy", symlinks=True)
    tried = tried_in(tmp_path / "copy", sample=40)
    assert [each for each in tried if each.wrong is not None] == []
