"""The page about the catalogue beside runs of real nodes."""

from __future__ import annotations

from tools.catalogue_truth import PAGE, Row, Share, page


def test_the_share_that_agrees_is_told() -> None:
    ends = Share.of({("publisher", "/a", "T"), ("publisher", "/b", "T")}, {("publisher", "/a", "T")})
    assert ends == Share(1, 1, 0)
    text = page([Row("p/node", ends, Share.of({"~x"}, {"~x", "~y"}))], [])
    assert "Of 1 nodes the catalogue knows 1 of 2 (50 %)" in text
    assert "Of 0 nodes the catalogue knows 0 of 0 of" in text
    assert "and 1 of 1 (100 %) of the parameters" in text
    assert "| p/node | 1 | 1 | 0 | 1 | 0 | 1 |" in text


def test_the_page_counts_what_the_catalogue_has() -> None:
    head = page([], []).partition("## Measured")[0]
    assert PAGE.read_text().partition("## Measured")[0] == head, "run: make catalogue-truth"
