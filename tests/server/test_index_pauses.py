"""The index gives way to what the user looks at, and to edits."""

from __future__ import annotations

import threading
from typing import Any, cast

from preflight_server.lsp.indexing import Indexing


class Typing:
    """A session whose user pauses after so many looks."""

    def __init__(self, looks: int) -> None:
        self.calm = threading.Event()
        self.calm.set()
        self.folder = None
        self.looks = looks

    @property
    def quiet_for(self) -> float:
        self.looks -= 1
        return 0.001 if self.looks > 0 else -1.0


def test_what_an_edit_interrupts_goes_on_when_the_user_pauses() -> None:
    session = Typing(looks=5)
    indexing = Indexing(cast(Any, None), cast(Any, session))
    assert indexing._gives_way_to_edits() is False
    assert session.looks == 0, "each edit makes the pause longer"
    indexing.close()


def test_who_waits_for_a_pause_ends_with_the_server() -> None:
    session = Typing(looks=1_000_000)
    indexing = Indexing(cast(Any, None), cast(Any, session))
    indexing.close()
    assert indexing._gives_way_to_edits() is True
    assert session.looks == 999_999, "nothing is waited for"
