"""Files that cannot be analysed give a reason, at once."""

from __future__ import annotations

import os
import socket
from pathlib import Path

import pytest
from preflight_analysis.documents import reading
from preflight_analysis.documents.reading import SIZE_LIMIT, Text, Unreadable, digest, read_text


def reason(path: Path | str) -> tuple[str, str]:
    result = read_text(str(path))
    assert isinstance(result, Unreadable)
    assert result.path == str(path)
    return result.kind, result.reason


def text_of(path: Path, data: bytes) -> str:
    path.write_bytes(data)
    result = read_text(str(path))
    assert isinstance(result, Text), result
    assert result.digest == digest(result.text)
    return result.text


def test_text_keeps_its_line_ends_and_loses_its_byte_order_mark(tmp_path: Path) -> None:
    assert text_of(tmp_path / "a.launch", b"\xef\xbb\xbf<a>\r\n\xc3\xa4</a>\r") == "<a>\r\nä</a>\r"
    assert text_of(tmp_path / "a.launch", b"") == ""


def test_encoding_is_that_of_the_declaration(tmp_path: Path) -> None:
    latin = b'<?xml version="1.0" encoding="iso-8859-1"?>\n<a b="\xe4"/>'
    assert text_of(tmp_path / "a.launch", latin).endswith('<a b="ä"/>')
    utf16 = '<?xml version="1.0" encoding="utf-16"?><a b="ä"/>'
    for codec in ("utf-16-le", "utf-16-be"):
        assert text_of(tmp_path / "a.launch", utf16.encode(codec)) == utf16
    assert text_of(tmp_path / "a.launch", utf16.encode("utf-16")) == utf16


@pytest.mark.parametrize(
    ("data", "expected"),
    [
        (b"\x7fELF\x02\x01\x01\0\0", "is not a text file"),
        (b"<launch>\n\xff</launch>", "is not a text file in UTF-8 (byte 0xff in line 2)"),
        (b'<?xml version="1.0" encoding="klingon"?><a/>', "declares the encoding 'klingon', which is not known"),
        (b'<?xml version="1.0" encoding="zlib"?><a/>', "declares the encoding 'zlib', which is not known"),
        (b'<?xml version="1.0" encoding="ascii"?>\xff', "declares the encoding 'ascii' and is not written in it"),
        (
            b'<?xml version="1.0" encoding="idna"?>' + b"\xff" * 70,
            "declares the encoding 'idna', which is not known",
        ),
    ],
)
def test_what_is_not_text(tmp_path: Path, data: bytes, expected: str) -> None:
    (tmp_path / "a.launch").write_bytes(data)
    assert reason(tmp_path / "a.launch") == ("not-text", expected)


def test_what_is_not_there(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    assert reason(tmp_path / "gone") == ("missing", "does not exist")
    assert reason(tmp_path / "file" / "below") == ("missing", "does not exist")
    assert reason("nul\0") == ("missing", "does not exist: no file can have this name")


def test_what_is_not_a_regular_file_is_refused_without_waiting(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "fifo")
    with socket.socket(socket.AF_UNIX) as listener:
        listener.bind(str(tmp_path / "socket"))
    (tmp_path / "loop").symlink_to(tmp_path / "loop")
    assert reason(tmp_path) == ("unreadable", "is a folder")
    assert reason(tmp_path / "fifo") == ("unreadable", "is not a regular file")
    assert reason(tmp_path / "socket") == ("unreadable", "is not a regular file")
    assert reason("/dev/zero") == ("unreadable", "is not a regular file")
    assert reason(tmp_path / "loop")[0] == "unreadable"


def test_no_permission(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(path: str, flags: int) -> int:
        raise PermissionError(13, "Permission denied", path)

    (tmp_path / "a").write_text("")
    monkeypatch.setattr(reading.os, "open", refuse)  # chmod does not hinder root, which tests may run as
    assert reason(tmp_path / "a") == ("unreadable", "cannot be read: no permission to read it")


def test_size_limit(tmp_path: Path) -> None:
    path = tmp_path / "a.launch"
    path.write_bytes(b"x" * SIZE_LIMIT)
    assert isinstance(read_text(str(path)), Text)
    path.write_bytes(b"x" * 5_200_000)
    assert reason(path) == ("not-text", "is 5.2 MB; files above 4 MiB are not analysed")


def test_file_replaced_by_a_fifo_between_look_and_open(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "a.launch"
    path.write_text("<launch/>")
    os.mkfifo(tmp_path / "fifo")
    really_open = os.open
    monkeypatch.setattr(reading.os, "open", lambda _, flags: really_open(tmp_path / "fifo", flags))
    assert reason(path) == ("unreadable", "is not a regular file")
