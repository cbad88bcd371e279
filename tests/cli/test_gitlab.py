"""`check --format gitlab`: GitLab's Code Quality report."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

import pytest
from support.editor_harness import Harness

pytestmark = pytest.mark.ros
Run = Callable[..., Any]


def test_the_report_has_what_gitlab_requires(harness: Harness, preflight: Run) -> None:
    done = preflight("check", harness.launch_file, "--format", "gitlab")
    (entry,) = done.json
    assert (done.code, done.err) == (0, "")
    assert set(entry) == {"description", "check_name", "fingerprint", "severity", "location"}
    assert entry["check_name"] == "TOP001 subscribed-not-published"
    assert entry["severity"] == "major"
    assert entry["location"] == {"path": "launch/talker_listener.launch", "lines": {"begin": 7, "end": 7}}
    first, second = entry["description"].splitlines()
    assert "/chater" in first
    assert second.startswith("launch/talker_listener.launch:3:3: /talker publishes")


def test_each_entry_has_a_fingerprint_of_its_own(harness: Harness, preflight: Run) -> None:
    harness.launch_file.write_text("<launch>\n  <nod/>\n  <nod/>\n  <node/>\n</launch>\n")
    entries = preflight("check", harness.launch_file, "--format", "gitlab").json
    assert len(entries) >= 2
    assert len({entry["fingerprint"] for entry in entries}) == len(entries)
    assert all(re.fullmatch(r"[0-9a-f]{16}:\d+", entry["fingerprint"]) for entry in entries)


def test_a_clean_launch_file_gives_an_empty_list(harness: Harness, preflight: Run) -> None:
    assert preflight("check", harness.launch_file.with_name("fixed.launch"), "--format", "gitlab").json == []
