"""The content security policy of our pages: their own script alone runs, and no text becomes markup."""

from __future__ import annotations

import base64
import hashlib
import re
from html.parser import HTMLParser
from pathlib import Path

import pytest
from preflight_analysis.queries.node_tree import Item, NodeTree
from preflight_analysis.view.graph_page import graph_page
from preflight_analysis.view.tree_page import tree_page
from support import sample_graphs

ROOT = Path(__file__).parents[2]
HOSTILE = """</script><script>alert(1)</script><img src=x onerror=alert(1)><!--"'&%POLICY%%NONCE%\u2028]]>${alert(1)}"""
PAGES = {
    "graph": graph_page(sample_graphs.hostile(), None),
    "tree": tree_page(NodeTree((HOSTILE,), 1, (Item("node", HOSTILE, HOSTILE, HOSTILE, note=HOSTILE),)), {}, None),
}


class Page(HTMLParser):
    """Its policy, and the texts of its scripts and styles."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.policy: dict[str, set[str]] = {}
        self.inside: dict[str, list[str]] = {"script": [], "style": []}
        self.attributes: set[str] = set()
        self.at = ""
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        given = dict(attrs)
        self.attributes |= given.keys()
        self.at = tag
        if tag in self.inside and given.get("type") != "application/json":
            self.inside[tag].append("")
        if given.get("http-equiv") == "Content-Security-Policy":
            for directive in str(given["content"]).split(";"):
                name, *values = directive.split()
                self.policy[name] = set(values)

    def handle_endtag(self, tag: str) -> None:
        self.at = ""

    def handle_data(self, data: str) -> None:
        if self.inside.get(self.at):
            self.inside[self.at][-1] += data


def digests(texts: list[str]) -> set[str]:
    return {f"'sha256-{base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()}'" for text in texts}


@pytest.mark.parametrize("name", PAGES)
def test_only_what_is_ours_counts(name: str) -> None:
    page = Page(PAGES[name])
    assert page.policy == {
        "default-src": {"'none'"},
        "style-src": digests(page.inside["style"]),
        "script-src": digests(page.inside["script"]),
        "base-uri": {"'none'"},
        "form-action": {"'none'"},
    }
    assert len(page.inside["script"]) == 1
    assert not [each for each in page.attributes if each.startswith("on")]


def test_no_script_of_ours_makes_markup_of_text() -> None:
    """Neither those of the pages, which the webview has too, nor the extension's; pictures are parsed, which runs
    nothing."""
    makes = re.compile(
        r"(inner|outer)HTML|insertAdjacentHTML|document\s*\.\s*write|\beval\s*\(|new\s+Function|srcdoc"
        r"|createContextualFragment|setAttribute\(\s*[\"']on|javascript:|unsafe-"
    )
    scripts = [
        *(ROOT / "analysis/preflight_analysis/view/page").glob("*.js"),
        *(ROOT / "vscode-client/src").glob("*.ts"),
    ]
    assert len(scripts) > 10
    assert [path.name for path in scripts if makes.search(path.read_text(encoding="utf-8"))] == []
