"""What the client's headers may be, and what ends the server, in words and with an exit code."""

from __future__ import annotations

import json
import re
import subprocess
from io import BytesIO
from typing import Any

import pytest
from preflight_server.lsp.frames import MOST_BYTES, BadFrameError, Frames
from support.editor_harness import Harness


def framed(body: bytes) -> bytes:
    return b"Content-Length: %d\r\n\r\n%b" % (len(body), body)


def bodies(stream: bytes) -> tuple[list[bytes], list[str]]:
    """What pygls reads, and what was refused."""
    refused: list[str] = []
    frames = Frames(BytesIO(stream), refused.append)
    found = []
    while header := frames.readline():
        length = re.fullmatch(rb"Content-Length: (\d+)\r\n", header)
        assert length is not None
        assert frames.readline() == b"\r\n"
        found.append(frames.read(int(length[1])))
    return found, refused


def test_messages() -> None:
    other = b"content-type: x\r\nCONTENT-LENGTH:1\r\n\r\n3"
    assert bodies(framed(b"1") + framed(b"22") + other) == ([b"1", b"22", b"3"], [])


@pytest.mark.parametrize(
    ("headers", "why"),
    [
        (b"Content-Length: abc\r\n\r\n{}", "not a number"),
        (b"Content-Length: -2\r\n\r\n{}", "not a number"),
        (b"Content-Length:\r\n\r\n", "not a number"),
        (b"Content-Length: 1e3\r\n\r\n{}\r\n", "not a number"),
        (b"Content-Type: x\r\n\r\n{}", "without Content-Length"),
        (b"\r\n", "without Content-Length"),
        (b"Content-Length: 0\r\n\r\n", "empty"),
        (b"nonsense\r\n\r\n", "without Content-Length"),
    ],
)
def test_the_next_message_is_read_after_headers_that_are_wrong(headers: bytes, why: str) -> None:
    found, (refused,) = bodies(headers + framed(b"next"))
    assert found == [b"next"]
    assert why in refused


@pytest.mark.parametrize(
    ("stream", "why"),
    [
        (b"Content-Length: %d\r\n\r\n" % (MOST_BYTES + 1), "there may be"),
        (b"Content-Length: 9999999999999999999\r\n\r\n", "there may be"),
        (b"X: " + b"x" * 10_000, "more than 8192 bytes"),
        (b"X: x\r\n" * 1000, "more than 64 lines"),
    ],
)
def test_what_ends_the_stream(stream: bytes, why: str) -> None:
    with pytest.raises(BadFrameError, match=why):
        bodies(stream)


def test_the_largest_message() -> None:
    found, refused = bodies(b"Content-Length: %d\r\n\r\n" % MOST_BYTES)
    assert (found, refused) == ([b""], [])


def answered(harness: Harness, *stream: bytes) -> tuple[int, list[dict[str, Any]], str]:
    done = subprocess.run(
        [str(harness.server), "lsp"],
        input=b"".join(stream),
        env=harness.environment,
        capture_output=True,
        timeout=60,
        check=False,
    )
    answers = [json.loads(body) for body in re.split(rb"Content-Length: .*\r\n.*\r\n\r\n", done.stdout) if body]
    return done.returncode, answers, done.stderr.decode()


@pytest.mark.parametrize("length", [b"99999999999", b"9999999999999999999", b"9" * 100])
def test_a_length_that_no_memory_has_ends_the_server_in_words(harness: Harness, length: bytes) -> None:
    code, _, errors = answered(harness, b"Content-Length: " + length + b"\r\n\r\n{}")
    assert code in (1, 2)
    assert re.search("the language server ends: a message of|Content-Length is not a number", errors)
    assert "Traceback" not in errors
    assert "MemoryError" not in errors


def test_what_is_no_message_is_answered(harness: Harness) -> None:
    garbage = framed(b"no JSON"), framed(b"\xff\xfe"), framed(b"[" * 100_000), b"Content-Length: x\r\n\r\n"
    invalid = framed(b"[1]"), framed(b"7"), framed(b'{"a": 1}'), framed(b'{"jsonrpc": "2.0", "id": [], "method": "a"}')
    params = framed(b'{"jsonrpc": "2.0", "id": 9, "method": "textDocument/hover", "params": {"x": 1}}')
    code, answers, _ = answered(harness, *garbage, *invalid, params)
    assert code == 1
    assert sorted((answer["id"] or 0, answer["error"]["code"]) for answer in answers) == sorted(
        [*[(0, -32700)] * len(garbage), *[(0, -32600)] * len(invalid), (9, -32602)]
    )
