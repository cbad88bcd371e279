"""What runs told of nodes: kept while files change, and known to be out of date then."""

from __future__ import annotations

import pytest
from preflight_analysis.tracing.interface import Interface, Outcome
from preflight_analysis.tracing.request import TraceRequest
from preflight_analysis.workspace.index import Root
from preflight_server.lsp.node_results import NodeResults

ROOT, OTHER = Root("/a.launch"), Root("/b.launch")
KEY = ("/talker", 0)
SPINS = Interface("trace", Outcome("spinning"))
CRASHES = Interface("trace", Outcome("crashed", 1))


def request(*args: str) -> TraceRequest:
    return TraceRequest("/talker", "p", "/talker.py", args)


@pytest.fixture
def results() -> NodeResults:
    """Of a node that was run."""
    results = NodeResults()
    assert results.put(ROOT, KEY, request(), SPINS, results.edition)
    return results


def test_a_result_is_that_of_its_request_and_root(results: NodeResults) -> None:
    assert results.of(ROOT) == {KEY: SPINS}
    assert results.of(OTHER) == {}
    assert results.lacking(ROOT, {KEY: request()}) == {}
    assert results.lacking(ROOT, {KEY: request("more")}) == {KEY: request("more")}
    assert results.lacking(OTHER, {KEY: request()}) == {KEY: request()}


def test_only_another_interface_is_news(results: NodeResults) -> None:
    assert not results.put(ROOT, KEY, request("more"), SPINS, results.edition)
    assert results.put(ROOT, KEY, request("more"), CRASHES, results.edition)


def test_what_may_be_out_of_date_stays_until_there_is_another(results: NodeResults) -> None:
    results.look_again()
    assert results.of(ROOT) == {KEY: SPINS}
    assert results.lacking(ROOT, {KEY: request()}) == {KEY: request()}
    results.put(ROOT, KEY, request(), SPINS, results.edition)
    results.look_again_at(ROOT, [KEY, ("/unknown", 0)])
    assert results.of(ROOT) == {KEY: SPINS}
    assert results.lacking(ROOT, {KEY: request()}) == {KEY: request()}


def test_a_run_that_began_before_files_changed_may_be_out_of_date(results: NodeResults) -> None:
    began = results.edition
    results.look_again()
    results.put(ROOT, KEY, request(), CRASHES, began)
    assert results.of(ROOT) == {KEY: CRASHES}
    assert results.lacking(ROOT, {KEY: request()}) == {KEY: request()}


def test_nodes_go_with_their_tags_and_all_go_with_trust(results: NodeResults) -> None:
    results.put(ROOT, ("/gone", 0), request(), SPINS, results.edition)
    results.keep(ROOT, {KEY})
    assert results.of(ROOT) == {KEY: SPINS}
    began = results.edition
    results.clear()
    assert results.of(ROOT) == {}
    assert not results.put(ROOT, KEY, request(), SPINS, began)
    assert results.of(ROOT) == {}
    assert results.put(ROOT, KEY, request(), SPINS, results.edition)
