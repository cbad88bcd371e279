"""Substitutions in pieces."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from preflight_analysis.documents.span import Span
from preflight_analysis.documents.xml import parse_xml
from preflight_analysis.launch.ros1_xml import read_ros1
from preflight_analysis.queries.tokens import KINDS, tokens


def cut(text: str, within: Span | None = None) -> list[tuple[str, str]]:
    found = tokens(read_ros1(parse_xml("/a.launch", text)), within)
    assert [t.span for t in found] == sorted({t.span for t in found})
    return [(text[t.span.start : t.span.end], t.kind) for t in found]


def of_value(value: str) -> list[tuple[str, str]]:
    return cut(f'<launch><param name="x" value="{value}"/></launch>')


OPEN, CLOSE = ("$(", "operator"), (")", "operator")


@pytest.mark.parametrize(
    ("value", "pieces"),
    [
        ("plain", []),
        ("$(arg robot)", [OPEN, ("arg", "keyword"), ("robot", "parameter"), CLOSE]),
        ("a/$(find pkg)/b", [OPEN, ("find", "keyword"), ("pkg", "namespace"), CLOSE]),
        ("$(env HOME)", [OPEN, ("env", "keyword"), ("HOME", "variable"), CLOSE]),
        (
            "$(optenv NAME some text)",
            [OPEN, ("optenv", "keyword"), ("NAME", "variable"), ("some text", "string"), CLOSE],
        ),
        ("$(anon n)", [OPEN, ("anon", "keyword"), ("n", "variable"), CLOSE]),
        ("$(dirname)", [OPEN, ("dirname", "keyword"), CLOSE]),
        ("$(arg a)$(arg", [OPEN, ("arg", "keyword"), ("a", "parameter"), CLOSE]),
        ("$( )", [OPEN, CLOSE]),
    ],
)
def test_each_substitution(value: str, pieces: list[tuple[str, str]]) -> None:
    assert of_value(value) == pieces


def test_an_expression() -> None:
    assert of_value("$(eval rate * 2.5 if arg('größe') == 'big' and sqrt(4) &lt; x else env('N'))")[2:-1] == [
        ("rate", "parameter"),
        ("*", "operator"),
        ("2.5", "number"),
        ("if", "keyword"),
        ("arg", "function"),
        ("'größe'", "parameter"),
        ("==", "operator"),
        ("'big'", "string"),
        ("and", "keyword"),
        ("sqrt", "function"),
        ("4", "number"),
        ("&lt;", "operator"),
        ("x", "parameter"),
        ("else", "keyword"),
        ("env", "function"),
        ("'N'", "variable"),
    ]


def test_no_token_goes_over_a_line() -> None:
    assert ("b", "string") in of_value("$(optenv A\n b)")
    assert all("\n" not in text for text, _ in of_value("$(optenv A x\n y)"))


def test_text_is_looked_at_where_it_is_substituted() -> None:
    text = "<launch><rosparam{}>a: $(arg b)</rosparam></launch>"
    assert cut(text.format("")) == []
    assert len(cut(text.format(" subst_value='true'"))) == 4


def test_a_range_and_a_broken_file() -> None:
    text = "<launch>\n<param name='a' value='$(arg one)'/>\n<param name='b' value='$(arg two)'/>\n<param"
    assert [t for t, kind in cut(text) if kind == "parameter"] == ["one", "two"]
    line = text.index("<param name='b'")
    assert [t for t, kind in cut(text, Span(line, len(text))) if kind == "parameter"] == ["two"]
    assert cut("<lau") == []


def test_vscode_colours_each_kind() -> None:
    manifest = json.loads((Path(__file__).parents[2] / "vscode-client/package.json").read_text())
    (scopes,) = [s for s in manifest["contributes"]["semanticTokenScopes"] if s["language"] == "roslaunch"]
    assert set(scopes["scopes"]) == set(KINDS)
