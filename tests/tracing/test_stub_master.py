"""The stub master's XML-RPC, compared with the standard library's, and over real connections."""

from __future__ import annotations

import socket
import xmlrpc.client
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from preflight_analysis.tracing.agents import stub_master, xml_rpc
from preflight_analysis.tracing.agents.params import ParamTree

pytestmark = pytest.mark.ros

_TEXT = st.text(st.characters(codec="utf-8", exclude_categories=("Cc", "Cs")))
_PLAIN = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(-(2**31), 2**31 - 1),
    st.floats(allow_nan=False),
    _TEXT,
    st.binary().map(xmlrpc.client.Binary),
)
_VALUES = st.recursive(_PLAIN, lambda below: st.lists(below) | st.dictionaries(_TEXT, below), max_leaves=20)


def _ours(value: Any) -> Any:
    if isinstance(value, xmlrpc.client.Binary):
        return xml_rpc.Binary(value.data)
    if isinstance(value, dict):
        return {name: _ours(below) for name, below in value.items()}
    return [_ours(item) for item in value] if isinstance(value, (list, tuple)) else value


def _plain(value: Any) -> Any:
    """Comparable: of a binary value its bytes."""
    if isinstance(value, (xmlrpc.client.Binary, xml_rpc.Binary)):
        return ("binary", value.data)
    if isinstance(value, dict):
        return {name: _plain(below) for name, below in value.items()}
    return [_plain(item) for item in value] if isinstance(value, (list, tuple)) else value


@given(st.lists(_VALUES, max_size=4))
def test_a_call_is_read_as_the_standard_library_reads_it(arguments: list[Any]) -> None:
    body = xmlrpc.client.dumps(tuple(arguments), "getParam", allow_none=True).encode("utf-8", "xmlcharrefreplace")
    method, read = xml_rpc.read_call(body)
    assert method == "getParam"
    assert _plain(read) == _plain(xmlrpc.client.loads(body)[0])


@given(_VALUES)
def test_an_answer_is_written_as_the_standard_library_writes_it(value: Any) -> None:
    assert xml_rpc.answer(_ours(value)) == xmlrpc.client.dumps((value,), methodresponse=True, allow_none=True)


@pytest.mark.parametrize("inner", ["a b", " a ", "", "<i4>-7</i4>", "<string>x</string>\n", "<double>1e3</double>"])
def test_values_as_other_libraries_write_them(inner: str) -> None:
    body = (
        "<?xml version='1.0'?><methodCall><methodName>m</methodName><params>"
        f"<param><value>{inner}</value></param></params></methodCall>"
    ).encode()
    assert xml_rpc.read_call(body)[1] == xmlrpc.client.loads(body)[0]


@pytest.mark.parametrize(
    "body",
    [
        b"",
        b"<methodCall>",
        b"<value><int>x</int></value>",
        b"<value><boolean>2</boolean></value>",
        b"<a>" * 100_000,
        b"<value><array><data>" * 1000,
        b"</array>",
        b"\xff\xfe",
    ],
)
def test_nonsense_is_an_error_and_nothing_else(body: bytes) -> None:
    with pytest.raises(ValueError, match=r".*"):
        xml_rpc.read_call(body)


@pytest.fixture
def master() -> Any:
    """The address of a stub master with one parameter."""
    listening = socket.socket()
    listening.bind(("127.0.0.1", 0))
    listening.listen(8)
    params = ParamTree()
    params.set("/rate", 5)
    stub_master.serve(listening, params, lambda *_args, **_more: None)
    return listening.getsockname()


def test_several_calls_over_one_connection(master: tuple[str, int]) -> None:
    with xmlrpc.client.ServerProxy(f"http://{master[0]}:{master[1]}/") as proxy:
        assert proxy.getParam("/node", "/rate") == [1, "Parameter [/rate]", 5]
        assert proxy.getParam("/node", "/missing") == [-1, "Parameter [/missing] is not set", 0]
        assert proxy.system.nonsense() == [-1, "unknown method system.nonsense", 0]


def test_a_client_that_wants_the_connection_closed_gets_it_closed(master: tuple[str, int]) -> None:
    body = xmlrpc.client.dumps(("/node",), "getPid").encode()
    for first, more in (("1.0", ""), ("1.1", "Connection: close\r\n")):
        head = f"POST /RPC2 HTTP/{first}\r\nContent-Length: {len(body)}\r\n{more}\r\n"
        with socket.create_connection(master, timeout=60) as connection:
            connection.sendall(head.encode() + body)
            with connection.makefile("rb") as stream:
                said = stream.read()
        assert said.startswith(b"HTTP/1.1 200 OK\r\n")
        assert said.endswith(b"</methodResponse>\n")


@pytest.mark.parametrize(
    "head", [b"GET / HTTP/1.1\r\n\r\n", b"POST / HTTP/1.1\r\n\r\n", b"POST / HTTP/1.1\r\nContent-Length: x\r\n\r\n"]
)
def test_other_requests_are_hung_up_on(master: tuple[str, int], head: bytes) -> None:
    with socket.create_connection(master, timeout=60) as connection:
        connection.sendall(head)
        assert connection.recv(100) == b""
    with xmlrpc.client.ServerProxy(f"http://{master[0]}:{master[1]}/") as proxy:
        assert proxy.hasParam("/node", "/rate") == [1, "/rate", True]
