"""Text of others in Markdown is shown as it is by a reader of CommonMark: none of it is a mark, link or picture."""

from __future__ import annotations

import html

import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from markdown_it import MarkdownIt
from preflight_analysis.findings.markdown import block, code, escaped, plain

READER = MarkdownIt("gfm-like", {"html": True, "linkify": False})
NASTY = st.text(st.sampled_from("`` ` \\*_[]()<>&!|~#-+=.a1\n\t\"'/:é"), max_size=30)
PICTURE = "`![x](https://evil.example/x.png)<img src=x onerror=alert(1)>`"


def inline(markdown: str) -> str:
    return READER.renderInline(f"a {markdown} b")


def words(text: str) -> str:
    return " ".join(text.split())


@given(NASTY)
def test_a_code_span_shows_its_text(text: str) -> None:
    shown = inline(code(text))
    assert shown.startswith("a <code>")
    assert shown.endswith("</code> b")
    inside = html.unescape(shown.removeprefix("a <code>").removesuffix("</code> b"))
    assert words(inside) == words(text)


@given(NASTY)
@example("1. a")
@example("- a")
@example("12) a")
def test_escaped_text_is_shown_as_it_is(text: str) -> None:
    paragraph = READER.render(escaped(text)).strip()
    assert html.unescape(paragraph.removeprefix("<p>").removesuffix("</p>")) == words(text)


@given(st.lists(NASTY.map(lambda text: text.replace("\n", " ")), min_size=1, max_size=5))
def test_a_block_shows_its_lines(lines: list[str]) -> None:
    shown = READER.render(block(lines) + "\n\nafter")
    assert shown.endswith("</code></pre>\n<p>after</p>\n")
    inside = shown.removeprefix('<pre><code class="language-text">').removesuffix("</code></pre>\n<p>after</p>\n")
    assert html.unescape(inside) == "\n".join(lines) + "\n"


@given(NASTY, NASTY)
def test_plain_text_has_the_same_words(first: str, second: str) -> None:
    markdown = f"**x** {code(first)} [{escaped(second)}](file:///a%20b) {escaped(second)}."
    wanted = f"x {' '.join(first.splitlines())} {words(second)} {words(second)}."
    assert words(plain(markdown)) == words(wanted)


def test_blocks_are_plain_too() -> None:
    assert plain("say:\n\n" + block(["a\\*b `c` **d**", "```"])) == "say:\n\na\\*b `c` **d**\n```"


@pytest.mark.parametrize("write", [code, escaped])
def test_a_picture_is_not_loaded(write: object) -> None:
    shown = READER.render(write(PICTURE))  # type: ignore[operator]
    assert "<img" not in shown
    assert "<a" not in shown


def test_nothing_turns_the_text_around_it() -> None:
    for shown in (code("a\u202eb"), block(["a\u2066b"]), escaped("a\u061cb")):
        assert shown.count("\N{REPLACEMENT CHARACTER}") == 1
    assert code("שלום") == "`שלום`", "what is written from right to left by itself stays"
