"""`--paths`: absolute or relative to the workspace, the same in all verbs."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from preflight_server.cli.paths import with_paths
from support.editor_harness import Harness

pytestmark = pytest.mark.ros
Run = Callable[..., Any]

VERBS = [
    ["check"],
    ["tree"],
    ["trace"],
    ["graph"],
    ["why", "talker", "listener"],
    ["where", "rate"],
    ["snapshot"],
    ["watch", "--once", "--timeout", "0.1"],
    ["doctor", "--no-run"],
]
BELOW = "launch/talker_listener.launch"


def strings(data: Any) -> Iterator[str]:
    if isinstance(data, str):
        yield data
    elif isinstance(data, (list, dict)):
        for each in data.values() if isinstance(data, dict) else data:
            yield from strings(each)


@pytest.mark.parametrize("verb", VERBS, ids=lambda verb: verb[0])
def test_relative_paths_are_those_below_the_workspace(harness: Harness, preflight: Run, verb: list[str]) -> None:
    def said(*options: str) -> Any:
        done = preflight(verb[0], BELOW, *verb[1:], "--format", "json", *options, cwd=harness.workspace)
        return json.loads(done.out.splitlines()[-1]) if verb[0] == "watch" else json.loads(done.out)

    absolute, relative = said(), said("--paths", "relative")
    home = f"{harness.workspace}/"
    expected = {each.removeprefix(home) if each.startswith(home) else each for each in strings(absolute)}
    assert set(strings(relative)) == expected
    assert said("--paths", "absolute").keys() == absolute.keys()


def test_the_paths_of_a_batch(harness: Harness, preflight: Run, tmp_path: Path) -> None:
    jobs = tmp_path / "jobs.jsonl"
    jobs.write_text(json.dumps({"file": str(harness.launch_file), "package_path": [str(harness.workspace)]}) + "\n")
    absolute = json.loads(preflight("tree", "--no-run", "--batch", jobs).out)
    relative = json.loads(preflight("tree", "--no-run", "--batch", jobs, "--paths", "relative").out)
    home = f"{harness.workspace}/"
    assert {each.removeprefix(home) for each in strings(absolute)} == set(strings(relative))
    assert BELOW in set(strings(relative))


def test_the_users_own_values_stay(tmp_path: Path) -> None:
    home = str(tmp_path)
    data = {"file": f"{home}/a", "params": {"file": f"{home}/b"}, "nodes": [{"path": f"{home}/c", "env": []}]}

    class Given:
        paths = "relative"

    assert with_paths(data, Given, [home]) == {  # type: ignore[arg-type]
        "file": "a",
        "params": {"file": f"{home}/b"},
        "nodes": [{"path": "c", "env": []}],
    }
