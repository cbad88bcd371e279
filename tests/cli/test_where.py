"""`where`: the places that set a parameter, on the demo."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from support.editor_harness import Harness

pytestmark = pytest.mark.ros
Run = Callable[..., Any]
FILE = "launch/talker_listener.launch"


@pytest.fixture
def set_twice(harness: Harness) -> None:
    path = Path(harness.workspace, FILE)
    first = '<launch>\n  <param name="/talker/rate" value="1.5"/>'
    path.write_text(path.read_text().replace("<launch>", first, 1))


def test_the_places_in_order(harness: Harness, preflight: Run, set_twice: None) -> None:
    done = preflight("where", FILE, "talker/rate")
    assert (done.code, done.err) == (0, "")
    title, *lines = done.out.splitlines()
    assert title == "parameter '/talker/rate'"
    assert [line.split()[0] for line in lines] == ["applies", "overridden", "default", "read"]
    assert lines[0].split("[")[0].split(None, 1)[1].strip() == "5 (integer)"
    assert lines[1].endswith(f"[{FILE}:2:16]")
    assert lines[2].split()[1:3] == ["10", "(integer)"]
    assert lines[3].split() == ["read", "by", "/talker"]


def test_the_same_as_json(harness: Harness, preflight: Run, set_twice: None) -> None:
    done = preflight("where", FILE, "/talker/rate", "--format", "json", "--paths", "relative")
    (found,) = done.json["parameters"]
    assert (done.json["schema"], found["name"], found["node"]) == ("ros-preflight/where/1", "/talker/rate", None)
    assert [(each["value"], each["applies"], each["file"]) for each in found["settings"]] == [
        (5, True, FILE),
        (1.5, False, FILE),
    ]
    assert found["declared"]["default"] == 10
    assert {each["node"] for each in found["uses"]} == {"/talker"}


@pytest.mark.parametrize(
    ("words", "text"),
    [
        (("rte",), "nothing in this launch sets or reads a parameter 'rte'; did you mean /talker/rate?"),
        (("a", "b"), "name one parameter"),
        (("rate:=3",), "name one parameter"),
    ],
)
def test_what_cannot_be_answered(
    harness: Harness, preflight: Run, set_twice: None, words: tuple[str, ...], text: str
) -> None:
    done = preflight("where", FILE, *words, "--no-run")
    assert (done.code, done.out) == (2, "")
    assert text in done.err
    assert harness.sandbox_starts() == 0


def test_what_is_not_known_may_set_it_too(harness: Harness, preflight: Run) -> None:
    path = Path(harness.workspace, "launch/loaded.launch")
    path.write_text(
        '<launch>\n  <param name="a/b" value="1"/>\n  <rosparam ns="a" file="/not_here.yaml"/>\n</launch>\n'
    )
    done = preflight("where", "launch/loaded.launch", "/a/b", "--no-run")
    assert [line.split()[0] for line in done.out.splitlines()] == ["parameter", "applies", "unknown", "no"]
    assert done.out.splitlines()[2].endswith("[launch/loaded.launch:3:4]")
    done = preflight("where", "launch/loaded.launch", "/a/b", "--no-run", "--format", "json", "--paths", "relative")
    (unknown,) = done.json["parameters"][0]["unknown"]
    assert (unknown["what"], unknown["file"]) == ("<rosparam>", "launch/loaded.launch")
