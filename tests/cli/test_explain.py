"""`explain`: a rule, or one finding."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from support.editor_harness import Harness

pytestmark = pytest.mark.ros
Run = Callable[..., Any]


def test_a_rule_is_explained_as_rules_does(harness: Harness, preflight: Run) -> None:
    page = preflight("rules", "TOP001").out
    assert preflight("explain", "TOP001").out == page
    assert preflight("explain", "subscribed-not-published").out == page
    assert harness.sandbox_starts() == 0


def test_a_finding_is_explained_by_its_place(harness: Harness, preflight: Run) -> None:
    done = preflight("explain", "launch/talker_listener.launch:7:31")
    assert (done.code, done.err) == (0, "")
    assert done.out.startswith("launch/talker_listener.launch:7:31: warning")
    assert "Confidence: likely." in done.out
    assert '  -     <remap from="chatter" to="chater"/>\n  +     <remap from="chatter" to="chatter"/>\n' in done.out
    assert "<!-- preflight: ignore[TOP001]" in done.out
    assert preflight("rules", "TOP001").out in done.out


@pytest.mark.parametrize("place", ["launch/talker_listener.launch:7", "launch/talker_listener.launch:7:31:"])
def test_the_place_may_be_as_it_was_copied(harness: Harness, preflight: Run, place: str) -> None:
    assert "TOP001" in preflight("explain", place, "launch/talker_listener.launch", "--no-run").out


def test_a_finding_is_explained_by_its_fingerprint(harness: Harness, preflight: Run) -> None:
    (entry,) = preflight("check", harness.launch_file, "--format", "gitlab").json
    data = preflight("explain", entry["fingerprint"], "--format", "json", "--paths", "relative").json
    (finding,) = data["findings"]
    assert (data["schema"], finding["rule"]) == ("ros-preflight/explain/1", "TOP001")
    assert finding["file"] == "launch/talker_listener.launch"
    assert [rule["id"] for rule in data["rules"]] == ["TOP001"]


@pytest.mark.parametrize("what", ["TOP999", "launch/talker_listener.launch:2", "0123456789abcdef:1"])
def test_what_is_not_there_cannot_be_explained(harness: Harness, preflight: Run, what: str) -> None:
    done = preflight("explain", what, "--no-run")
    assert (done.code, done.out) == (2, "")
    assert what in done.err
