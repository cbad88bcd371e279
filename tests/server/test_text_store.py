"""Incremental edits land where the editor made them."""

from __future__ import annotations

import os

import pytest
from hypothesis import given
from hypothesis import strategies as st
from lsprotocol import types
from preflight_server.lsp.text_store import TextStore, to_path, to_uri
from support import lsp_client

URI = "file:///w/a.launch"
TEXTS = st.text("ab<é漢𝒳\n\r\f\u2028\x85", max_size=20)


def edited(text: str, edits: list[tuple[int, int, str]], encoding: str) -> tuple[str, str]:
    """The text after the edits, as we keep it and as the editor does; all edits are one notification."""
    store = TextStore()
    store.encoding = encoding
    store.open(URI, "roslaunch", 1, text)
    changes = []
    for start, end, new in edits:
        start, end = sorted((min(start, len(text)), min(end, len(text))))
        start -= text[start - 1 : start + 1] == "\r\n"
        end += text[end - 1 : end + 1] == "\r\n"
        there = types.Range(lsp_client.position(text, start, encoding), lsp_client.position(text, end, encoding))
        changes.append(types.TextDocumentContentChangePartial(there, new))
        text = text[:start] + new + text[end:]
    document = store.change(URI, 2, changes)
    assert document is not None
    return document.text, text


@pytest.mark.parametrize("encoding", lsp_client.ENCODINGS)
@given(text=TEXTS, edits=st.lists(st.tuples(st.integers(0, 20), st.integers(0, 20), TEXTS), max_size=5))
def test_edits_land_where_the_editor_made_them(encoding: str, text: str, edits: list[tuple[int, int, str]]) -> None:
    ours, theirs = edited(text, edits, encoding)
    assert ours == theirs


def test_a_change_without_range_is_the_whole_text() -> None:
    store = TextStore()
    store.open(URI, "xml", 1, "old")
    document = store.change(URI, 5, [types.TextDocumentContentChangeWholeDocument("new")])
    assert document is not None
    assert (document.text, document.version) == ("new", 5)


def test_a_reversed_or_impossible_range_does_not_break_the_text() -> None:
    store = TextStore()
    store.open(URI, "xml", 1, "abc")
    there = types.Range(types.Position(9, 9), types.Position(0, 1))
    document = store.change(URI, 2, [types.TextDocumentContentChangePartial(there, "-")])
    assert document is not None
    assert document.text == "a-"


def test_a_document_that_is_not_open_is_not_changed() -> None:
    store = TextStore()
    assert store.change(URI, 2, [types.TextDocumentContentChangeWholeDocument("x")]) is None
    assert store.close(URI) is None


def test_half_a_surrogate_pair_is_replaced_by_one_character_of_its_width() -> None:
    store = TextStore()
    document = store.open(URI, "xml", 1, "a\ud835b")
    assert document.text == "a\N{REPLACEMENT CHARACTER}b"


@pytest.mark.parametrize(
    ("uri", "path"),
    [
        ("file:///w/a.launch", "/w/a.launch"),
        ("file:///w/gr%C3%B6%C3%9Fe%20x.launch", "/w/größe x.launch"),
        ("file:///w/a%23b%3Fc.launch", "/w/a#b?c.launch"),
        ("file:///w/a#b?c.launch", "/w/a#b?c.launch"),
        ("file:///w/x/../a.launch", "/w/a.launch"),
        ("file://localhost/w/a.launch", "/w/a.launch"),
        ("file://elsewhere/w/a.launch", None),
        ("untitled:Untitled-1", None),
        ("git:/w/a.launch?%7B%7D", None),
        ("file:///w/a%00b", None),
        ("file:///w/gr%F6%DFe.launch", "/w/gr\udcf6\udcdfe.launch"),
        ("file:///w/\ud835.launch", "/w/\udced\udca0\udcb5.launch"),
        ("file://[bad", None),
        ("", None),
    ],
)
def test_uris_and_paths(uri: str, path: str | None) -> None:
    assert to_path(uri) == path


@given(st.text(st.characters(exclude_characters="\0", exclude_categories=["Cs"]), min_size=1, max_size=20))
def test_every_path_survives_its_uri(name: str) -> None:
    path = "/w/" + name.replace("/", "_").replace("..", "_").strip(".")
    assert to_path(to_uri(path)) == path.rstrip("/")


@given(st.binary(min_size=1, max_size=20))
def test_every_name_on_a_disk_survives_its_uri(name: bytes) -> None:
    path = os.path.normpath(os.fsdecode(b"/w/" + name.replace(b"/", b"_").replace(b"\0", b"_")))
    assert to_uri(path).isascii()
    assert to_path(to_uri(path)) == path


def test_a_name_that_no_disk_has_does_not_break_its_uri() -> None:
    assert to_uri("/w/\ud835") == "file:///w/%3F"
