"""Messages on standard input and output, one a line: what is no message is answered as JSON-RPC 2.0 has it (5.1).

The SDK's own transport drops a line that it cannot parse, and its client waits for ever.
"""

from __future__ import annotations

import json
import logging
import os
from collections.abc import AsyncIterator, Iterator
from contextlib import asynccontextmanager, contextmanager
from typing import Any, BinaryIO

import anyio
import mcp_types as types
from anyio.streams.memory import MemoryObjectReceiveStream, MemoryObjectSendStream
from mcp.shared.message import SessionMessage
from pydantic import ValidationError

MOST_BYTES = 16 << 20
"""Of a message from the client: a call has a few names and paths."""
_log = logging.getLogger(__name__)

Received = MemoryObjectReceiveStream[SessionMessage | Exception]
Sent = MemoryObjectSendStream[SessionMessage]


class NoMessageError(Exception):
    """A line that is no message, with the answer to it."""

    def __init__(self, code: int, why: str, message_id: int | str | None = None) -> None:
        super().__init__(why)
        self.answer = types.JSONRPCError(jsonrpc="2.0", id=message_id, error=types.ErrorData(code=code, message=why))


@asynccontextmanager
async def standard_streams() -> AsyncIterator[tuple[Received, Sent]]:
    """What the client sends, and where answers go, until it closes standard input. Standard input is empty then and
    standard output is standard error, so that neither a stray `print` nor a program that is started breaks the
    stream."""
    with _taken() as (stdin, stdout):
        sender, received = anyio.create_memory_object_stream[SessionMessage | Exception]()
        sent, answers = anyio.create_memory_object_stream[SessionMessage]()
        async with anyio.create_task_group() as tasks:
            tasks.start_soon(_read, stdin, sender, sent.clone())
            tasks.start_soon(_write, answers, stdout)
            yield received, sent


@contextmanager
def _taken() -> Iterator[tuple[BinaryIO, BinaryIO]]:
    with open(os.dup(0), "rb") as stdin, open(os.dup(1), "wb") as stdout, open(os.devnull, "rb") as nothing:
        os.dup2(nothing.fileno(), 0)
        os.dup2(2, 1)
        yield stdin, stdout


async def _read(stdin: BinaryIO, sender: MemoryObjectSendStream[SessionMessage | Exception], sent: Sent) -> None:
    async with sender, sent:
        while line := await anyio.to_thread.run_sync(_line, stdin):
            if not line.strip():
                continue
            try:
                message = message_of(line)
            except NoMessageError as error:
                _log.warning("not a message: %s", error)
                await sent.send(SessionMessage(error.answer))
            else:
                await sender.send(SessionMessage(message))


def _line(stdin: BinaryIO) -> bytes:
    """The next line. Of one that is too long no more is kept than shows that."""
    line = stdin.readline(MOST_BYTES + 1)
    rest = line
    while len(rest) > MOST_BYTES and not rest.endswith(b"\n"):
        rest = stdin.readline(MOST_BYTES + 1)
    return line


async def _write(answers: MemoryObjectReceiveStream[SessionMessage], stdout: BinaryIO) -> None:
    async with answers:
        async for each in answers:
            dumped = each.message.model_dump(mode="json", by_alias=True, exclude_unset=True)
            # A file name that is no UTF-8 has halves of surrogate pairs, which parsers refuse.
            line = json.dumps(dumped, ensure_ascii=False).encode(errors="replace") + b"\n"
            await anyio.to_thread.run_sync(_put, stdout, line)


def _put(stdout: BinaryIO, line: bytes) -> None:
    stdout.write(line)
    stdout.flush()


def message_of(line: bytes) -> types.JSONRPCMessage:
    """The message of a line. Raises `NoMessageError`."""
    if len(line) > MOST_BYTES:
        raise NoMessageError(types.PARSE_ERROR, f"a message has at most {MOST_BYTES} bytes")
    try:
        data: Any = json.loads(line.decode())
    except (ValueError, RecursionError) as error:
        raise NoMessageError(types.PARSE_ERROR, f"not JSON: {str(error)[:200]}") from None
    given = data.get("id") if isinstance(data, dict) else None
    message_id = given if isinstance(given, (int, str)) and not isinstance(given, bool) else None
    try:
        json.dumps(data, ensure_ascii=False).encode()
    except UnicodeEncodeError:
        message_id = message_id if not isinstance(message_id, str) or message_id.isprintable() else None
        raise NoMessageError(types.INVALID_REQUEST, "a string has half of a surrogate pair", message_id) from None
    if given is not None and message_id is None:
        # The SDK takes it for a notification.
        raise NoMessageError(types.INVALID_REQUEST, "an id is a number or a text")
    try:
        return types.jsonrpc_message_adapter.validate_python(data, by_name=False)
    except (ValidationError, RecursionError):
        raise NoMessageError(types.INVALID_REQUEST, "not a message of JSON-RPC 2.0", message_id) from None
