"""What `watch` says of each state."""

from __future__ import annotations

from dataclasses import replace

import pytest
from preflight_analysis.live.model import Comparison, Issue
from preflight_analysis.live.watcher import State
from preflight_server.cli.watch import _Text


def test_what_is_missing_and_has_not_lasted_yet_is_not_said_to_be_as_expected(
    capsys: pytest.CaptureFixture[str],
) -> None:
    text = _Text()
    missing = Comparison((), {"/a": "missing"}, {}, {}, {})
    text.write(State(missing))
    assert capsys.readouterr().out == ""
    text.write(State(replace(missing, issues=(Issue("missing", "node", "/a"),))))
    assert "1 difference, 0 nodes as expected" in capsys.readouterr().out
    text.write(State(replace(missing, nodes={"/a": "present"})))
    assert "no differences, 1 node as expected" in capsys.readouterr().out


def test_a_node_that_turns_up_is_news(capsys: pytest.CaptureFixture[str]) -> None:
    text = _Text()
    for states, said in (
        ({"/a": "unsure", "/b": "unsure"}, ""),
        ({"/a": "present", "/b": "unsure"}, "no differences, 1 node as expected\n"),
        ({"/a": "present", "/b": "present"}, "no differences, 2 nodes as expected\n"),
        ({"/a": "present", "/b": "present"}, ""),
    ):
        text.write(State(Comparison((), states, {}, {}, {})))  # type: ignore[arg-type]
        assert capsys.readouterr().out[len("00:00:00 ") :] == said
