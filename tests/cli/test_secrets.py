"""The secrets of the user reach nothing: no report in any format, no cache, no agent, no node; ordinary values do."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from support.command import Done
from support.editor_harness import Harness
from support.hostile_secrets import CANARY, FORMATS, VARIABLES, write_launch_files, write_secrets

pytestmark = pytest.mark.ros
NODE = """#!/usr/bin/env python3
import sys
import rospy
rospy.init_node("spy")
for name in rospy.get_param_names():
    print(name, rospy.get_param(name), file=sys.stderr)
    rospy.Publisher("/told/" + str(rospy.get_param(name))[:20].encode().hex(), rospy.AnyMsg, queue_size=1)
rospy.spin()
"""
VERBS = (
    ("tree", "--format", "text"),
    ("tree", "--format", "json"),
    ("tree", "--format", "html"),
    ("check", "--format", "text"),
    ("check", "--format", "json"),
    ("check", "--format", "github"),
    ("check", "--format", "sarif"),
    ("graph", "--format", "text"),
    ("graph", "--format", "json"),
    ("graph", "--format", "svg"),
    ("snapshot", "--format", "yaml"),
    ("where", "text0"),
    ("frames",),
)


@pytest.fixture
def hostile(harness: Harness) -> dict[str, Path]:
    """The launch files by their names."""
    package = harness.workspace / "hostile"
    paths = write_secrets(harness.home, package)
    scripts = package / "scripts"
    scripts.mkdir()
    (scripts / "spy").write_text(NODE)
    (scripts / "spy").chmod(0o755)
    return {path.name: path for path in write_launch_files(package, paths, ("hostile", "spy"))}


def _leaks(harness: Harness) -> list[str]:
    """The files of the caches with a secret in them, as it is or as part of a name."""
    words = (CANARY.encode(), CANARY[:8].encode().hex().encode())
    caches = [path for path in (harness.home / ".cache").rglob("*") if path.is_file()]
    return [str(path) for path in caches if any(word in path.read_bytes() for word in words)]


@pytest.mark.parametrize("name", FORMATS)
@pytest.mark.parametrize("options", [("--no-run",), ()], ids=["no-run", "run"])
def test_secrets_reach_no_report_and_no_cache(
    harness: Harness, preflight: Callable[..., Done], hostile: dict[str, Path], name: str, options: tuple[str, ...]
) -> None:
    for verb, *rest in VERBS if not options else VERBS[:7]:
        words = [*rest[:1], hostile[name]] if verb == "where" else [hostile[name], *rest]
        done = preflight(verb, *words, *options, "--fail-on", "never", environment=VARIABLES)
        assert CANARY not in done.out + done.err, (verb, rest)
        assert CANARY[:8].encode().hex() not in done.out + done.err, (verb, rest)
        if verb == "check":
            assert "LCH045" in done.out
    assert _leaks(harness) == []
