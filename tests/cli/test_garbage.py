"""Python's search for garbage during a check."""

from __future__ import annotations

import gc
from collections.abc import Iterator

import pytest
from preflight_server.cli.garbage import uncollected


@pytest.fixture(autouse=True)
def _as_before() -> Iterator[None]:
    was_enabled = gc.isenabled()
    yield
    (gc.enable if was_enabled else gc.disable)()


@uncollected()
def looked_for() -> bool:
    return gc.isenabled()


def test_no_garbage_is_looked_for_meanwhile() -> None:
    gc.enable()
    assert [looked_for(), gc.isenabled(), looked_for(), gc.isenabled()] == [False, True, False, True]
    gc.disable()
    assert not looked_for() and not gc.isenabled()


def test_it_is_as_before_after_an_error() -> None:
    gc.enable()
    with pytest.raises(ValueError, match="wrong"), uncollected():
        raise ValueError("wrong")
    assert gc.isenabled()
