"""The index gives way to what the user looks at, and to edits."""

from __future__ import annotations

import threading
from types import SimpleNamespace
from typing import Any, cast

from preflight_server.lsp.indexing import Indexing


class Typing:
    """The analyses of a session whose user pauses after so many looks."""

    def __init__(self, looks: int) -> None:
        self.calm = threading.Event()
        self.calm.set()
        self.looks = looks

    @property
    def quiet_for(self) -> float:
        self.looks -= 1
        return 0.001 if self.looks > 0 else -1.0


def indexing_beside(analyses: Typing) -> Indexing:
    return Indexing(cast(Any, None), cast(Any, SimpleNamespace(folder=None, analyses=analyses)))


def test_what_an_edit_interrupts_goes_on_when_the_user_pauses() -> None:
    typing = Typing(looks=5)
    indexing = indexing_beside(typing)
    assert indexing._gives_way_to_edits() is False
    assert typing.looks == 0, "each edit makes the pause longer"
    indexing.close()


def test_who_waits_for_a_pause_ends_with_the_server() -> None:
    typing = Typing(looks=1_000_000)
    indexing = indexing_beside(typing)
    indexing.close()
    assert indexing._gives_way_to_edits() is True
    assert typing.looks == 999_999, "nothing is waited for"
