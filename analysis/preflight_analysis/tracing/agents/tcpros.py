"""The headers of connections between nodes of ROS 1 (http://wiki.ros.org/ROS/TCPROS)."""

from __future__ import annotations

import socket
import struct

_MAX_HEADER = 65536


def header(fields: dict[str, str]) -> bytes:
    """A header as it is sent."""
    lines = [f"{key}={value}".encode() for key, value in fields.items()]
    content = b"".join(struct.pack("<I", len(line)) + line for line in lines)
    return struct.pack("<I", len(content)) + content


def read_header(connection: socket.socket) -> dict[str, str]:
    """The header that the other side sends. Raises `OSError`, `ValueError` or `struct.error` where it sends none."""
    (size,) = struct.unpack("<I", _exactly(connection, 4))
    if size > _MAX_HEADER:
        raise ValueError(size)
    content, fields, at = _exactly(connection, size), {}, 0
    while at < size:
        (length,) = struct.unpack_from("<I", content, at)
        key, _, value = content[at + 4 : at + 4 + length].decode(errors="replace").partition("=")
        fields[key] = value
        at += 4 + length
    return fields


def _exactly(connection: socket.socket, size: int) -> bytes:
    data = b""
    while len(data) < size:
        more = connection.recv(size - len(data))
        if not more:
            raise OSError("closed")
        data += more
    return data
