"""Well-formed files: the tree is minidom's, which is what roslaunch reads. And no text makes the parser fail."""

from __future__ import annotations

import gc
import time
from pathlib import Path
from typing import Any
from xml.dom import minidom
from xml.parsers import expat

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from preflight_analysis.documents.document import Comment, Document, Element, SpannedText, Text
from preflight_analysis.documents.reading import read_text
from preflight_analysis.documents.span import LineIndex, Span
from preflight_analysis.documents.xml import MAX_PROBLEMS, parse_xml
from preflight_analysis.documents.xml_scanner import scan

FIXTURES = Path(__file__).parents[2] / "fixtures" / "documents"
SAMPLES = [read_text(str(FIXTURES / name)) for name in ("robot.launch", "crlf.launch", "entities.launch")]
TEXTS = [sample.text for sample in SAMPLES if hasattr(sample, "text")]


def ours(element: Element) -> Any:
    children: list[Any] = []
    for child in element.children:
        if isinstance(child, Element):
            children.append(ours(child))
        elif isinstance(child, Comment):
            children.append(("comment", child.content.text))
        elif children and isinstance(children[-1], str):
            children[-1] += child.content.text
        else:
            children.append(child.content.text)
    return element.tag, {a.name: a.value.text for a in element.attributes}, children


def theirs(element: Any) -> Any:
    children: list[Any] = []
    for child in element.childNodes:
        if child.nodeType == child.ELEMENT_NODE:
            children.append(theirs(child))
        elif child.nodeType == child.COMMENT_NODE:
            children.append(("comment", child.data))
        elif child.nodeType in (child.TEXT_NODE, child.CDATA_SECTION_NODE):
            if children and isinstance(children[-1], str):
                children[-1] += child.data
            else:
                children.append(child.data)
    return element.tagName, dict(element.attributes.items()), children


def well_formed(text: str) -> bool:
    """Whether expat takes the text, and the encoding that it declares."""
    data = text.encode("utf-8", "surrogatepass")
    try:
        expat.ParserCreate("utf-8", namespace_separator=" ").Parse(data, True)
        expat.ParserCreate(namespace_separator=" ").Parse(data, True)
    except (expat.ExpatError, LookupError, ValueError):
        return False
    return True


def spanned_texts(document: Document) -> list[SpannedText]:
    found: list[SpannedText] = []
    pending = list(document.children)
    while pending:
        node = pending.pop()
        if isinstance(node, Element):
            found += [attribute.value for attribute in node.attributes]
            pending += node.children
        else:
            found.append(node.content)
    return found


def check_invariants(document: Document) -> None:
    """Spans lie inside the text, children inside their parents and in order, offsets grow."""
    text = document.text
    pending: list[tuple[Any, Span]] = [(child, Span(0, len(text))) for child in document.children]
    while pending:
        node, outer = pending.pop()
        span = node.content.span if isinstance(node, Text) else node.span
        assert outer.start <= span.start <= span.end <= outer.end
        if isinstance(node, Element):
            assert text[node.tag_span.start : node.tag_span.end] == node.tag
            for attribute in node.attributes:
                assert text[attribute.name_span.start : attribute.name_span.end] == attribute.name
                assert node.open_span.start <= attribute.span.start <= attribute.value.span.start
                assert attribute.value.span.end <= attribute.span.end <= node.open_span.end
            at = node.open_span.end
            for child in node.children:
                child_span = child.content.span if isinstance(child, Text) else child.span
                assert at <= child_span.start
                at = child_span.end
                pending.append((child, node.span))
    for content in spanned_texts(document):
        offsets = [content.to_document(i) for i in range(len(content.text) + 1)]
        assert offsets == sorted(offsets)
        assert offsets[-1] == content.span.end
    for problem in document.problems:
        assert 0 <= problem.span.start <= problem.span.end <= len(text)


@pytest.mark.parametrize("name", ["robot.launch", "crlf.launch"])
def test_tree_is_that_of_minidom(name: str) -> None:
    path = FIXTURES / name
    sample = read_text(str(path))
    assert hasattr(sample, "text")
    document = parse_xml(str(path), sample.text)
    assert document.problems == ()
    assert document.root is not None
    assert ours(document.root) == theirs(minidom.parse(str(path)).documentElement)
    check_invariants(document)


def test_decoded_values_lead_back_to_the_source() -> None:
    text = '<a b="x &lt;\r\n&#65;y"/>'
    document = parse_xml("/a", text)
    assert document.root is not None
    value = document.root.attributes[0].value
    assert value.text == "x < Ay"
    assert [text[value.slice_span(i, i + 1).start] for i in range(6)] == ["x", " ", "&", "\r", "&", "y"]
    assert value.slice_span(2, 3) == Span(text.index("&lt;"), text.index("\r"))


def test_character_references_keep_the_blanks_that_normalisation_would_take() -> None:
    document = parse_xml("/a", '<a b="1\n2\t3&#10;4"/>')
    assert document.root is not None
    assert document.root.attributes[0].value.text == "1 2 3\n4"


def test_entities_of_a_doctype_are_listed_and_not_expanded() -> None:
    path = FIXTURES / "entities.launch"
    document = parse_xml(str(path), path.read_text())
    assert document.problems == ()
    assert [(name, document.text[span.start : span.end]) for name, span in document.entities] == [
        ("host", "&host;"),
        ("nodes", "&nodes;"),
        ("host", "&host;"),
    ]
    assert document.root is not None
    machine, param = document.root.elements
    assert [a.value.text for a in machine.attributes] == ["m", "&host;", "a&b"]
    assert [a.value.text for a in param.attributes] == ["p", "ssh://&host;/<dir>"]


@pytest.mark.parametrize("use", ["<launch>&e30;</launch>", '<launch a="&e30;"/>', "<launch/>"])
@pytest.mark.parametrize("kind", ["", "% "])
def test_billion_laughs_cost_nothing(use: str, kind: str) -> None:
    mark = "%" if kind else "&"
    declarations = f'<!ENTITY {kind}e0 "lol">' + "".join(
        f'<!ENTITY {kind}e{i} "{f"{mark}e{i - 1};" * 10}">' for i in range(1, 31)
    )
    started = time.process_time()
    document = parse_xml("/a", f"<!DOCTYPE launch [{declarations}{'%e30;' if kind else ''}]>{use}")
    assert time.process_time() - started < 1.0
    assert [name for name, _ in document.entities] == (["e30"] if "&" in use else [])
    if not kind:
        assert document.problems == ()


def test_external_entities_are_not_opened(tmp_path: Path) -> None:
    secret = tmp_path / "secret"
    secret.write_text("secret")
    document = parse_xml("/a", f'<!DOCTYPE a [<!ENTITY e SYSTEM "{secret.as_uri()}">]><a b="1">&e;</a>')
    assert document.root is not None
    assert ours(document.root) == ("a", {"b": "1"}, ["&e;"])
    assert [name for name, _ in document.entities] == ["e"]


@pytest.mark.parametrize(
    "text",
    [
        "<a>" * 100_000,
        "<a>" * 100_000 + "</a>" * 100_000,
        "<a>\n" * 33_000,
        "<a " * 33_000,
        "<a>" + "<b></c>" * 16_000,
        "<!--\n" * 33_000,
        "<!--\n" * 33_000 + "-->",
        '<a b="\n' * 16_000,
        "<a b='\n<a b=\"\n" * 8_000,
        "<![CDATA[" * 16_000,
        "<?x " * 33_000,
        "<!DOCTYPE a [<!-- \" ' " * 8_000,
        "<" * 66_000,
        "</" * 33_000,
        "</a" * 33_000,
        "<a>" + "&" * 66_000,
        "<a b" + " " * 66_000 + "c",
        "<a" + " b='c'" * 16_000,
        "<a b='" + " " * 66_000 + "x" * 10,
        "<a>" + "<b>" * 16_000 + "</x>" * 16_000 + "</a>",
        "<a>" + "x b=c " * 11_000 + "</x>" * 16_000,
        "<a>" + "x </x>" * 11_000,
        "<a>\n" + "<b/>\n</b>\n" * 8_000,
        "<a>\n" + "<b>\n" * 8_000 + "</c>\n" * 8_000,
        "<a>" + "/b><b>" * 11_000,
        "<a " + "<!-- --> " * 8_000,
        "<a " + "<!-- -->b='c' " * 5_000,
        "<-- " * 16_000,
        "< a" * 22_000,
        "<xml" * 16_000,
        "<a" + ' b "' * 16_000,
        "<a" + ' b=""c' * 9_000,
        "<a" + " b='x\"" * 9_000,
        "<a" + ' b=x"' * 9_000,
        "<<<<<<< " * 8_000,
        "<?xml encoding='" + "x" * 60_000,
    ],
    ids=lambda text: repr(text[:14]),
)
def test_long_and_deep_texts_take_linear_time(text: str) -> None:
    gc.freeze()  # what other tests left in memory is not looked through meanwhile
    started = time.process_time()
    document = parse_xml("/a", text)
    took = time.process_time() - started
    gc.unfreeze()
    assert took < 3.0
    assert len(document.problems) <= MAX_PROBLEMS
    assert bool(document.problems) == (not well_formed(text))


@given(st.text(alphabet=st.sampled_from("<>/=\"' \n&;!-?[]ab:xml\ufeffé🤖"), max_size=60))
@settings(deadline=None, max_examples=400)
def test_any_text_has_a_tree_and_expat_decides(text: str) -> None:
    document = parse_xml("/a", text)
    check_invariants(document)
    has_content = document.root is not None or bool(scan(text, LineIndex(text)).problems)
    if well_formed(text):
        assert document.problems == ()
    elif has_content:
        assert document.problems


@st.composite
def mutated(draw: st.DrawFn) -> str:
    text = draw(st.sampled_from(TEXTS))
    for _ in range(draw(st.integers(0, 3))):
        start = draw(st.integers(0, len(text)))
        cut = draw(st.integers(0, 12))
        insertion = draw(
            st.sampled_from(["", "<", ">", '"', "'", "/", "</", "<node ", "-->", "<!--", "&", "=", "\n", "a"])
        )
        text = text[:start] + insertion + text[start + cut :]
    return text


@given(mutated())
@settings(deadline=None, max_examples=300)
def test_edited_launch_files(text: str) -> None:
    document = parse_xml("/a", text)
    check_invariants(document)
    if well_formed(text):
        # What the scanner finds would be left out here: it must not find anything in a text that is in order.
        assert scan(text, LineIndex(text)).problems == ()
        assert document.problems == ()
        if document.root is not None and not document.entities:
            assert ours(document.root) == theirs(minidom.parseString(text.encode()).documentElement)
    elif not document.entities:  # an error may be in what they stand for, which is not looked at
        assert document.problems


@given(
    st.recursive(
        st.text(
            alphabet=st.characters(codec="utf-8", exclude_categories=("Cc", "Cs"), exclude_characters="\ufffe\uffff")
        ),
        lambda children: st.lists(
            st.tuples(
                st.sampled_from(["a", "b-c", "d:e", "ö"]), st.dictionaries(st.just("k"), st.text("<&\"'\n x")), children
            )
        ),
        max_leaves=8,
    )
)
@settings(deadline=None, max_examples=100)
def test_generated_files_are_read_as_minidom_reads_them(content: Any) -> None:
    built = minidom.Document()
    root = built.createElement("launch")
    root.setAttribute("xmlns:d", "urn:d")
    built.appendChild(root)

    def build(parent: Any, content: Any) -> None:
        if isinstance(content, str):
            parent.appendChild(built.createTextNode(content))
            return
        for tag, attributes, children in content:
            element = built.createElement(tag)
            for name, value in attributes.items():
                element.setAttribute(name, value)
            parent.appendChild(element)
            build(element, children)

    build(root, content)
    text = built.toxml()
    document = parse_xml("/a", text)
    assert scan(text, LineIndex(text)).problems == ()
    assert document.root is not None
    assert ours(document.root) == theirs(minidom.parseString(text.encode()).documentElement)
