"""What stands in for a module that is not installed, in the process of a launch file or node."""

from __future__ import annotations

import importlib.util
import os
import sys
import textwrap
import types
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from preflight_analysis.tracing.agents.anything import MAX_ASKED, Anything, is_unknown, readable, unknown_text
from preflight_analysis.tracing.agents.missing_modules import MissingModules


@pytest.fixture
def noted() -> Iterator[list[tuple[str, str, int]]]:
    """What imports of missing modules were noted, while there are stand-ins."""
    found: list[tuple[str, str, int]] = []
    finder = MissingModules(lambda *about: found.append(about))
    before = set(sys.modules)
    sys.meta_path.append(finder)
    yield found
    sys.meta_path.remove(finder)
    for name in set(sys.modules) - before:
        del sys.modules[name]


def run(folder: Path, text: str) -> dict[str, Any]:
    """What a program has after it has run."""
    path = folder / "program.py"
    path.write_text(textwrap.dedent(text))
    module = types.ModuleType("program")
    exec(compile(path.read_text(), str(path), "exec"), vars(module))
    return vars(module)


def test_a_text_made_of_a_stand_in_is_unknown() -> None:
    camera = Anything("cv2").VideoCapture(0)
    texts = [str(camera), f"{camera.width:.2f}", "a" + camera, camera + "b", os.path.join(camera, "c")]
    assert all(is_unknown(text) for text in texts)
    assert readable(str(camera)) == "cv2.VideoCapture()"
    assert is_unknown(unknown_text("share folder of p"))
    assert not is_unknown("cv2")


def test_a_stand_in_is_taken_apart_iterated_and_calculated_with() -> None:
    unknown = Anything("x")
    first, (second, *_) = unknown
    assert all(isinstance(each, Anything) for each in (first, second))
    assert len(list(unknown)) == 1
    assert is_unknown(str(3 * unknown - 1))
    assert ([1] + unknown)[0] == (unknown + [2])[-1] - 1 == 1  # noqa: RUF005
    assert dict(**unknown) == {}
    assert [is_unknown(key) for key in {**unknown}] == [True]
    assert not unknown < 3
    assert max(1, unknown) == 1


def test_a_loop_over_a_condition_that_is_unknown_ends() -> None:
    count = 0
    unknown = Anything("camera").is_open()
    while unknown:
        count += 1
    assert MAX_ASKED <= count <= 2 * MAX_ASKED  # the condition may be compiled twice


def test_a_stand_in_is_a_base_a_decorator_a_context_and_an_exception() -> None:
    library = Anything("library")

    class Both(library.Node, library.Other):  # type: ignore[name-defined,misc]
        def __init__(self) -> None:
            super().__init__("name")
            self.thing.start(self)

    @library.compiled
    def one() -> int:
        return 1

    @library.compiled(fast=True)
    def two() -> int:
        return 2

    with library.opened("x") as file:
        assert is_unknown(str(file.read()))
    assert one() + two() == 3
    assert isinstance(Both().anything, Anything)
    with pytest.raises(library.SerialException, match="gone"):
        raise library.SerialException("gone")


def test_a_missing_module_and_what_is_below_it_are_stood_in_for_and_noted_once(
    tmp_path: Path, noted: list[tuple[str, str, int]]
) -> None:
    found = run(
        tmp_path,
        """
        import missing_library.below.deeper as deeper
        from missing_library.other import Thing
        import another_library
        value = Thing(deeper.x, another_library.y)
        """,
    )
    assert is_unknown(str(found["value"]))
    file = str(tmp_path / "program.py")
    assert noted == [("missing_library", file, 2), ("another_library", file, 4)]


def test_all_names_of_a_missing_module_are_those_that_the_program_uses(
    tmp_path: Path, noted: list[tuple[str, str, int]]
) -> None:
    found = run(
        tmp_path,
        """
        from missing_library import *
        known = 1
        def function():
            return Thing(len([known]))
        value = function()
        """,
    )
    assert is_unknown(str(found["value"]))
    assert found["known"] == 1


def test_what_a_program_does_without_a_module_it_does(tmp_path: Path, noted: list[tuple[str, str, int]]) -> None:
    found = run(
        tmp_path,
        """
        import importlib.util
        try:
            import missing_library
        except ImportError:
            missing_library = None
        there = importlib.util.find_spec("missing_library") is not None
        """,
    )
    assert found["missing_library"] is None
    assert found["there"] is False
    assert not noted


def test_what_a_program_cannot_do_without_is_stood_in_for(tmp_path: Path, noted: list[tuple[str, str, int]]) -> None:
    run(
        tmp_path,
        """
        import sys
        try:
            import missing_library
        except ImportError:
            print("install it")
            sys.exit(1)
        """,
    )
    assert [name for name, _, _ in noted] == ["missing_library"]


def test_a_module_that_is_missing_in_a_package_that_is_there_is_missing(
    tmp_path: Path, noted: list[tuple[str, str, int]]
) -> None:
    with pytest.raises(ModuleNotFoundError):
        run(tmp_path, "import json.no_such_module")
    assert not noted
    assert importlib.util.find_spec("no_such_module") is None
