"""A file that is another when it runs than it was before or is afterwards: what it did is kept under no name."""

from __future__ import annotations

import os
import shlex
import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from preflight_analysis.tracing import run
from preflight_analysis.tracing.cache import TraceCache
from preflight_analysis.tracing.commands import CommandCache, CommandRunner
from preflight_analysis.tracing.store import fingerprint
from preflight_analysis.tracing.trace import Tracer
from support.tracing_harness import environment, own, request, write_node

pytestmark = pytest.mark.ros

NODE = """
import rospy
from std_msgs.msg import String
import {module}
rospy.init_node("n")
rospy.Publisher("{topic}", String, queue_size=1)
rospy.Publisher({module}.TOPIC, String, queue_size=1)
rospy.spin()
"""
Swap = Callable[[], None]


class Versions:
    """A package of a node and a module in two versions of the same size and age, the first of them in use by way of a
    link and a folder."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder / "pkg"
        self.place = self.folder / "build"
        for name, topic in (("build", "first"), ("build.other", "other")):
            place = self.folder / name
            place.mkdir(parents=True)
            write_node(place, NODE.format(topic=topic, module="names"))
            (place / "names.py").write_text(f"TOPIC = 'from_{topic}'\n")
            for path in place.iterdir():
                os.utime(path, (1, 1))
        (self.folder / "current").symlink_to("build")
        self.node = self.folder / "current/node.py"

    def swap_file(self, name: str = "node.py") -> None:
        one, other, aside = self.place / name, self.folder / "build.other" / name, self.folder / "aside"
        one.rename(aside)
        other.rename(one)
        aside.rename(other)

    def swap_module(self) -> None:
        self.swap_file("names.py")

    def swap_folder(self) -> None:
        other, aside = self.folder / "build.other", self.folder / "aside"
        self.place.rename(aside)
        other.rename(self.place)
        aside.rename(other)

    def swap_link(self) -> None:
        link = self.folder / "current"
        target = "build.other" if os.readlink(link) == "build" else "build"
        link.unlink()
        link.symlink_to(target)


@pytest.fixture
def versions(tmp_path: Path) -> Versions:
    return Versions(tmp_path)


def around_the_run(monkeypatch: pytest.MonkeyPatch, name: str, before: Swap, after: Swap) -> None:
    """Do something between the moment at which a run is prepared and its start, and between its end and the next look
    at files."""
    execute = getattr(run, name)

    def racing(*args: Any) -> run.RawRun:
        before()
        found: run.RawRun = execute(*args)
        after()
        return found

    monkeypatch.setattr(run, name, racing)


def nothing() -> None:
    pass


KINDS = ("swap_file", "swap_folder", "swap_link", "swap_module")


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("back", [True, False])
def test_a_trace_is_not_kept_under_the_name_of_another(
    versions: Versions, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, kind: str, back: bool
) -> None:
    """Whether the version that ran stays, or the former one is back when it has ended."""
    tracer = Tracer(environment(versions.folder), TraceCache(tmp_path / "cache"))
    asked = request(versions.node)
    with monkeypatch.context() as patch:
        swap: Swap = getattr(versions, kind)
        around_the_run(patch, "execute", swap, swap if back else nothing)
        found = own(tracer.trace(asked, threading.Event()))
        assert any("other" in name for _, name, _ in found)
    if back:
        assert tracer.lookup(asked) is None
    now = tracer.lookup(asked)
    assert now is None or own(now) == found, "of the version that is there"
    again = tracer.trace(asked, threading.Event())
    assert (own(again) == found) == (not back)
    assert tracer.lookup(asked) is not None, "kept, as nothing happened this time"


@pytest.mark.parametrize("kind", ["swap_file", "swap_folder", "swap_link"])
def test_a_trace_is_not_kept_when_its_node_is_replaced_at_the_end(
    versions: Versions, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, kind: str
) -> None:
    tracer = Tracer(environment(versions.folder), TraceCache(tmp_path / "cache"))
    asked = request(versions.node)
    with monkeypatch.context() as patch:
        around_the_run(patch, "execute", nothing, getattr(versions, kind))
        assert ("publisher", "first", "std_msgs/String") in own(tracer.trace(asked, threading.Event()))
    assert tracer.lookup(asked) is None


@pytest.mark.parametrize("back", [True, False])
def test_what_a_command_printed_is_not_kept_for_another(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, back: bool
) -> None:
    folder = tmp_path / "pkg"
    folder.mkdir()
    for name in ("first", "other"):
        (folder / name).write_text(name)
        os.utime(folder / name, (1, 1))

    def swap() -> None:
        (folder / "first").rename(folder / "aside")
        (folder / "other").rename(folder / "first")
        (folder / "aside").rename(folder / "other")

    runner = CommandRunner(environment(folder), str(folder), CommandCache(tmp_path / "cache"))
    line = f"cat {shlex.quote(str(folder / 'first'))}"
    with monkeypatch.context() as patch:
        around_the_run(patch, "execute_command", swap, swap if back else nothing)
        assert runner.run(line, threading.Event()).output == "other"
    assert runner.lookup(line) is None
    assert runner.run(line, threading.Event()).output == ("first" if back else "other")
    assert runner.lookup(line) is not None


def test_a_digest_is_of_the_file_that_is_there(tmp_path: Path) -> None:
    """As old, as large and in the same place on the disk as the one before."""
    path = tmp_path / "file"
    found = set()
    for text in ("one", "two"):
        with path.open("w") as file:
            file.write(text)
        os.utime(path, (1, 1))
        found.add(fingerprint(str(path)))
    assert len(found) == 2
