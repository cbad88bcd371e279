"""Answers that edit files: made of the texts that the editor and the disk have at that moment, or refused."""

from __future__ import annotations

from collections.abc import Awaitable, Callable
from typing import TYPE_CHECKING, TypeVar

from lsprotocol import types

from preflight_server.lsp.convert import Converter, TextChangedError
from preflight_server.lsp.protocol import RefusedError
from preflight_server.lsp.session import View

if TYPE_CHECKING:
    from preflight_server.lsp.app import PreflightServer

_T = TypeVar("_T")
_TRIES = 3
"""A file that is written all the time is not edited."""


async def edits_of(
    ls: PreflightServer, uri: str, answer: Callable[[View], Awaitable[tuple[_T, Converter]]]
) -> _T | None:
    """What `answer` gives for an open launch file, with the converter that made its edits; once more where one of the
    edited texts is another one by then. None if it is no open launch file."""
    for _ in range(_TRIES):
        view = await ls.view_of(uri, python=True)
        if view is None:
            return None
        try:
            found, converter = await answer(view)
        except TextChangedError as changed:
            await view.session.noticed(changed.paths)
            continue
        if not await view.session.changed_on_disk(converter.edited):
            return found
    raise RefusedError("The text changed meanwhile", types.LSPErrorCodes.ContentModified)
