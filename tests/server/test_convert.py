"""Diagnostics are made again only where their text or their finding is another."""

from __future__ import annotations

from dataclasses import replace

import pytest
from lsprotocol import types
from preflight_analysis.documents.document import Document
from preflight_analysis.documents.span import Location
from preflight_analysis.documents.xml import parse_xml
from preflight_analysis.findings.finding import Finding, Related
from preflight_server.lsp.convert import Converter
from preflight_server.lsp.text_store import TextStore

TEXT = "<launch>\n  <node/>\n</launch>\n"
TOP, BELOW = "/ws/top.launch", "/ws/below.launch"


@pytest.fixture
def documents() -> dict[str, Document]:
    return {path: parse_xml(path, TEXT) for path in (TOP, BELOW)}


def finding(documents: dict[str, Document], path: str, other: str) -> Finding:
    def place(name: str) -> Location:
        root = documents[name].root
        assert root is not None
        node = next(root.elements)
        return documents[name].location(node.span)

    related = (Related("included here", place(other)),)
    return Finding("LCH001", "name", "warning", "certain", "message", place(path), related)


def test_the_same_findings_in_the_same_texts(documents: dict[str, Document]) -> None:
    store, found = TextStore(), [finding(documents, BELOW, TOP)]
    first = Converter(store, documents)
    made = first.diagnostics(BELOW, found)
    second = Converter(store, documents, before=first)
    assert second.diagnostics(BELOW, found)[0] is made[0]
    second.end()
    third = Converter(store, documents, before=second)
    assert third.diagnostics(BELOW, found)[0] is made[0]
    equal = third.diagnostics(BELOW, [replace(found[0])])
    assert equal == made and equal[0] is not made[0]


def test_a_text_that_changed_elsewhere_leaves_the_diagnostic(documents: dict[str, Document]) -> None:
    store, found = TextStore(), [finding(documents, BELOW, TOP)]
    first = Converter(store, documents)
    made = first.diagnostics(BELOW, found)
    longer = documents | {TOP: parse_xml(TOP, TEXT + "<!-- more -->")}
    second = Converter(store, longer, before=first)
    assert second.diagnostics(BELOW, found) is made


@pytest.mark.parametrize("where", [TOP, BELOW])
def test_a_finding_whose_line_moved_is_converted_again(documents: dict[str, Document], where: str) -> None:
    store, found = TextStore(), [finding(documents, BELOW, TOP)]
    first = Converter(store, documents)
    (made,) = first.diagnostics(BELOW, found)
    lines = documents[where].lines.edited("\n" + TEXT)
    longer = documents | {where: parse_xml(where, "\n" + TEXT, lines=lines)}
    (again,) = Converter(store, longer, before=first).diagnostics(BELOW, found)
    (fresh,) = Converter(store, longer).diagnostics(BELOW, found)
    assert again == fresh != made


@pytest.mark.parametrize("moved", [TOP, BELOW])
def test_lines_that_moved_in_a_file_that_it_speaks_of(documents: dict[str, Document], moved: str) -> None:
    store, found = TextStore(), [finding(documents, BELOW, TOP)]
    first = Converter(store, documents)
    made = first.diagnostics(BELOW, found)[0]
    longer = documents | {moved: parse_xml(moved, "\n" + TEXT)}
    again = Converter(store, longer, before=first).diagnostics(BELOW, [finding(longer, BELOW, TOP)])[0]
    fresh = Converter(store, longer).diagnostics(BELOW, [finding(longer, BELOW, TOP)])[0]
    assert again == fresh != made


def test_another_spelling_of_a_uri_and_clients_without_related_places(documents: dict[str, Document]) -> None:
    store, found = TextStore(), [finding(documents, BELOW, TOP)]
    first = Converter(store, documents)
    (made,) = first.diagnostics(BELOW, found)
    without = Converter(store, documents, related=False, before=first).diagnostics(BELOW, found)
    assert without[0].related_information is None
    store.open("file:///ws/%74op.launch", "roslaunch", 1, TEXT)
    (again,) = Converter(store, documents, before=first).diagnostics(BELOW, found)
    assert again != made
    related = again.related_information
    assert isinstance(related, list) and related[0].location.uri == "file:///ws/%74op.launch"
    assert isinstance(again.range, types.Range)
