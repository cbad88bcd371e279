"""A cached trace is valid while everything it depended on is unchanged, and only then."""

from __future__ import annotations

import ctypes
import dataclasses
import multiprocessing
import os
import random
import resource
import signal
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from preflight_analysis.tracing.cache import TraceCache
from preflight_analysis.tracing.dependencies import Dependencies, ParamDependency
from preflight_analysis.tracing.intact import seal_of
from preflight_analysis.tracing.interface import SEEN, Endpoint, Interface, Outcome, ParamUse
from preflight_analysis.tracing.node_recipe import make
from preflight_analysis.tracing.preload import MOST_KEPT, Library
from preflight_analysis.tracing.request import TraceRequest
from preflight_analysis.tracing.trace import Tracer
from support.tracing_harness import environment, hammer_cache, own, request, write_node

pytestmark = pytest.mark.ros

NODE = """
import os, rospy, settings
from std_msgs.msg import String
rospy.init_node("n")
rospy.Publisher(settings.topic, String, queue_size=rospy.get_param("~size", 1))
open(os.path.join(os.path.dirname(__file__), "data.yaml")).close()
rospy.spin()
"""


class Harness:
    """A node with a module and a data file beside it, a tracer with a cache."""

    def __init__(self, folder: Path) -> None:
        self.package = folder / "pkg"
        self.package.mkdir()
        self.settings = self.package / "settings.py"
        self.settings.write_text("topic = 'news'\n")
        self.data = self.package / "data.yaml"
        self.data.write_text("a: 1\n")
        self.script = write_node(self.package, NODE)
        self.cache = TraceCache(folder / "cache")
        self.tracer = Tracer(environment(self.package), self.cache)
        self.request = request(self.script, params={"/node/size": 5, "/node/unread": 1, "/other": "x"})
        past = time.time() - 100
        for path in self.package.iterdir():
            os.utime(path, (past, past))

    def trace(self, asked: TraceRequest | None = None) -> Interface:
        return self.tracer.trace(asked or self.request, threading.Event())

    def hit(self, **changes: Any) -> bool:
        return self.tracer.lookup(dataclasses.replace(self.request, **changes)) is not None


@pytest.fixture
def harness(tmp_path: Path) -> Harness:
    harness = Harness(tmp_path)
    assert not harness.trace().cached
    return harness


def rewrite(path: Path, text: str) -> None:
    path.write_text(text)


def test_the_same_again_needs_no_run(harness: Harness) -> None:
    first = Tracer(harness.tracer.environment, None).trace(harness.request, threading.Event())
    again = harness.trace()
    assert again.cached
    assert (own(again), again.params) == (own(first), first.params)
    assert dataclasses.replace(again.outcome, seconds=0) == dataclasses.replace(first.outcome, seconds=0)


def test_a_changed_module_data_file_or_script(harness: Harness) -> None:
    for path, text in (
        (harness.settings, "topic = 'olds'\n"),
        (harness.data, "a: 2\n"),
        (harness.script, harness.script.read_text() + "\n"),
    ):
        before = path.read_text()
        rewrite(path, text)
        assert not harness.hit(), path
        rewrite(path, before)
        assert harness.hit(), path
    harness.data.unlink()
    assert not harness.hit()


def test_a_file_that_it_did_not_load_does_not_matter(harness: Harness) -> None:
    (harness.package / "unrelated.py").write_text("x = 1\n")
    assert harness.hit()


def test_parameters_matter_only_if_read(harness: Harness) -> None:
    params = dict(harness.request.params)
    assert harness.hit(params=params | {"/node/unread": 2, "/new": 3})
    assert not harness.hit(params=params | {"/node/size": 6})
    assert not harness.hit(params={"/other": "x"})
    assert not harness.hit(params=params | {"/use_sim_time": True})


def test_name_namespace_and_remaps_matter_only_if_asked_for(harness: Harness, tmp_path: Path) -> None:
    assert harness.hit(remaps=(("news", "/elsewhere"),))
    assert harness.hit(node="/ns/other", params={"/ns/other/size": 5})
    assert not harness.hit(node="/ns/other"), "its parameter is not set there"
    assert not harness.hit(remaps=(("~size", "/nothing"),)), "its parameter is read elsewhere"

    curious = write_node(tmp_path, "import rospy\nrospy.init_node('n')\nrospy.get_name()\nrospy.spin()\n", "curious.py")
    asked = request(curious)
    tracer = Tracer(environment(tmp_path), harness.cache)
    os.utime(curious, (0, 0))
    tracer.trace(asked, threading.Event())
    assert tracer.lookup(asked)
    assert tracer.lookup(dataclasses.replace(asked, remaps=(("a", "b"),)))
    assert not tracer.lookup(dataclasses.replace(asked, node="/renamed"))


def test_arguments_environment_and_executable_name_the_run(harness: Harness, tmp_path: Path) -> None:
    assert not harness.hit(args=("--fast",))
    assert not harness.hit(env=(("MODE", "x"),))
    assert not harness.hit(cwd="node")
    assert not harness.hit(executable="/usr/lib/rosout/rosout")
    other = Tracer(environment(harness.package, variables={"ROS_DISTRO": "melodic"}), harness.cache)
    assert other.lookup(harness.request) is None


def test_two_nodes_of_one_executable_are_cached_side_by_side(harness: Harness) -> None:
    other = dataclasses.replace(harness.request, params={"/node/size": 7})
    assert not harness.trace(other).cached
    assert harness.trace().cached
    assert harness.trace(other).cached


def test_a_crash_is_cached_until_the_missing_module_turns_up(tmp_path: Path) -> None:
    package = tmp_path / "pkg"
    package.mkdir()
    script = write_node(
        package, "try:\n    import rospy, missing\nexcept ImportError as error:\n    assert not error\n"
    )
    os.utime(script, (0, 0))
    tracer = Tracer(environment(package), TraceCache(tmp_path / "cache"))
    first = tracer.trace(request(script), threading.Event())
    assert first.outcome.status == "crashed"
    again = tracer.lookup(request(script))
    assert again is not None
    assert dataclasses.replace(again, cached=False) == first
    (package / "missing.py").write_text("")
    assert tracer.lookup(request(script)) is None


def test_what_was_not_run_is_not_cached(harness: Harness, tmp_path: Path) -> None:
    cancelled = threading.Event()
    cancelled.set()
    other = dataclasses.replace(harness.request, args=("x",))
    assert harness.tracer.trace(other, cancelled).outcome.status == "not-run"
    assert harness.tracer.lookup(other) is None


def test_a_file_saved_during_the_run_is_not_cached(harness: Harness) -> None:
    recipe = make(harness.tracer.environment, harness.request)
    spinning = Interface("trace", Outcome("spinning"))
    changed = Dependencies(files=(str(harness.settings),))
    os.utime(harness.settings)
    kept = harness.cache.store(recipe, harness.request, spinning, changed, started=time.time() - 60)
    assert not kept


def entries(cache: TraceCache) -> list[Path]:
    return sorted(cache.folder.glob("*/*/*.json"))


@pytest.mark.parametrize(
    "damage",
    [
        b"",
        b"\x00\xff" * 100,
        b"null",
        b"0" * 64 + b'\n{"schema": "ros-preflight/trace-cache/1"}',
        b"[" * 100_000,
    ],
)
def test_a_damaged_entry_is_a_miss(harness: Harness, damage: bytes) -> None:
    (path,) = entries(harness.cache)
    path.write_bytes(damage)
    assert not harness.hit()
    assert not harness.trace().cached
    assert harness.hit()


def test_a_truncated_entry_is_a_miss(harness: Harness) -> None:
    (path,) = entries(harness.cache)
    whole = path.read_bytes()
    for length in range(0, len(whole), 97):
        path.write_bytes(whole[:length])
        assert not harness.hit()


def test_an_entry_of_the_wrong_shape_is_a_miss(harness: Harness) -> None:
    import hashlib
    import json

    (path,) = entries(harness.cache)
    entry = json.loads(path.read_bytes().partition(b"\n")[2])
    for change in (
        {"dependencies": {}},
        {"dependencies": None},
        {"interface": {}},
        {"interface": entry["interface"] | {"outcome": {"nonsense": 1}}},
        {"interface": entry["interface"] | {"endpoints": [{"role": "publisher"}]}},
        {"schema": "ros-preflight/trace-cache/0"},
    ):
        data = json.dumps(entry | change).encode()
        path.write_bytes(hashlib.sha256(data).hexdigest().encode() + b"\n" + data)
        assert not harness.hit(), change


def test_a_folder_that_cannot_be_written_costs_the_cache_alone(tmp_path: Path) -> None:
    harness = Harness(tmp_path)
    (tmp_path / "cache").write_text("a file where the folder should be")
    assert harness.trace().outcome.status == "spinning"
    assert not harness.hit()


INTERFACE = Interface(
    "trace",
    Outcome("crashed", 1, None, ("last", "lines"), "why", 0.5),
    (
        Endpoint(
            "publisher", "a", "std_msgs/String", "0" * 32, {"latch": True}, "/x.py", 3, True, SEEN.but("made-up answer")
        ),
    ),
    (ParamUse("~p", "get", [1, {"k": None}], True, False, "/x.py", 4),),
    notes=("a note",),
)


def test_everything_survives_the_way_to_disk_and_back(harness: Harness) -> None:
    other = dataclasses.replace(harness.request, args=("other",))
    recipe = make(harness.tracer.environment, other)
    looks = Dependencies((), (ParamDependency("list", "/", True), ParamDependency("search", "size", True)))
    assert harness.cache.store(recipe, other, INTERFACE, looks, started=time.time())
    assert harness.cache.load(recipe, other) == dataclasses.replace(INTERFACE, cached=True)
    assert harness.cache.load(recipe, dataclasses.replace(other, params={})) is None


def test_the_least_recently_used_goes_first(harness: Harness, tmp_path: Path) -> None:
    cache = TraceCache(tmp_path / "small", max_bytes=1)
    requests = [dataclasses.replace(harness.request, args=(str(n),)) for n in range(6)]
    recipes = [make(harness.tracer.environment, r) for r in requests]
    cache.max_bytes = 10**9
    for n, (recipe, asked) in enumerate(zip(recipes, requests, strict=True)):
        cache.store(recipe, asked, INTERFACE, Dependencies(), started=time.time())
        place = cache._place(recipe, asked)
        for path in place.folder.glob(f"{place.recipe}-*.json"):
            os.utime(path, (1000 + n, 1000 + n))
    assert cache.load(recipes[0], requests[0])
    size = entries(cache)[0].stat().st_size
    cache.max_bytes = int(size * 3.5)
    cache.sweep()
    assert [n for n in range(6) if cache.load(recipes[n], requests[n])] == [0, 4, 5]


def test_several_processes_at_once(harness: Harness, tmp_path: Path) -> None:
    context = multiprocessing.get_context("spawn")
    shared = str(tmp_path / "shared")
    arguments = (shared, str(harness.script), str(harness.package), INTERFACE, 40)
    workers = [context.Process(target=hammer_cache, args=arguments) for _ in range(3)]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join(60)
    assert [w.exitcode for w in workers] == [0, 0, 0]
    assert not list(Path(shared).glob("*/*/.*.tmp"))


class Writer:
    """A process that writes entries until it is killed, and says after each whether it was kept."""

    def __init__(
        self, harness: Harness, folder: Path, prepare: Callable[[], object] = bool, max_bytes: int = 1 << 30
    ) -> None:
        self._said, said = os.pipe()
        self.pid = os.fork()
        if self.pid == 0:
            try:
                prepare()
                cache = TraceCache(folder, max_bytes)
                for number in range(100_000):
                    if number % 7 == 0:
                        cache.sweep()
                    os.write(said, b"y" if self.write(harness, cache, number) else b"n")
            finally:
                os._exit(0)
        os.close(said)

    @staticmethod
    def write(harness: Harness, cache: TraceCache, number: int) -> bool:
        asked = dataclasses.replace(harness.request, args=(f"n{number % 9}",), node=f"/n{number % 5}")
        notes = tuple("x" * 100 for _ in range(number * 37 % 500))
        interface = dataclasses.replace(INTERFACE, notes=notes)
        recipe = make(harness.tracer.environment, asked)
        return cache.store(recipe, asked, interface, Dependencies(asked=frozenset(["name"])), started=time.time())

    def says(self, number: int) -> bytes:
        """What it said of the first so many entries."""
        said = b""
        while len(said) < number and (more := os.read(self._said, number - len(said))):
            said += more
        return said

    def kill(self) -> None:
        os.kill(self.pid, signal.SIGKILL)
        os.waitpid(self.pid, 0)
        os.close(self._said)


def whole(cache: TraceCache) -> int:
    """How many entries there are; each of them is whole."""
    found = entries(cache)
    assert all(cache._read(path) is not None for path in found)
    return len(found)


def test_a_writer_that_is_killed_leaves_whole_entries(harness: Harness, tmp_path: Path) -> None:
    cache = TraceCache(tmp_path / "shared")
    chance = random.Random(4)
    for _ in range(25):
        # Two at once, killed wherever they are after so many entries.
        writers = [Writer(harness, cache.folder), Writer(harness, cache.folder)]
        for writer in writers:
            assert set(writer.says(chance.randrange(1, 30))) <= set(b"y")
            writer.kill()
        assert whole(cache)
    left = [path for path in cache.folder.glob("*/*/.*") if path.suffix == ".tmp"]
    cache.sweep()
    assert all(path.exists() for path in left), "another process may be writing them"
    for path in left:
        os.utime(path, (0, 0))
    (cache.folder / "ab" / "cd").mkdir(parents=True)
    abandoned = cache.folder / "ab" / "cd" / ".x.tmp"
    abandoned.write_text("half an ent")
    os.utime(abandoned, (0, 0))
    cache.sweep()
    assert not [path for path in cache.folder.glob("*/*/.*") if path.suffix == ".tmp"]
    assert Writer.write(harness, cache, 1)


def test_writers_that_sweep_each_others_entries_away(harness: Harness, tmp_path: Path) -> None:
    cache = TraceCache(tmp_path / "shared", max_bytes=100_000)
    writers = [Writer(harness, cache.folder, max_bytes=cache.max_bytes) for _ in range(3)]
    for writer in writers:
        assert set(writer.says(150)) <= set(b"y")
    for writer in writers:
        writer.kill()
    whole(cache)
    cache.sweep()
    assert sum(path.stat().st_size for path in entries(cache)) <= cache.max_bytes


def test_a_full_disk_costs_the_entry_alone(harness: Harness, tmp_path: Path) -> None:
    def fill() -> None:
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (300, 300))

    cache = TraceCache(tmp_path / "shared")
    assert Writer.write(harness, cache, 0)
    writer = Writer(harness, cache.folder, fill)
    assert writer.says(20) == b"n" * 20
    writer.kill()
    assert whole(cache) == 1
    assert [path for path in cache.folder.glob("*/*/*") if path.suffix != ".json"] == []


def test_a_folder_that_may_only_be_read_is_read(harness: Harness, tmp_path: Path) -> None:
    def no_root() -> None:
        header, none = (ctypes.c_uint32 * 2)(0x20080522, 0), (ctypes.c_uint32 * 6)()
        if ctypes.CDLL(None).capset(header, none) != 0:
            os._exit(1)

    folder = harness.cache.folder
    for path in (*folder.glob("*/*"), *folder.glob("*"), folder):
        path.chmod(0o555)
    before = {path: path.stat().st_mtime for path in entries(harness.cache)}
    writer = Writer(harness, folder, no_root)
    assert writer.says(10) == b"n" * 10
    writer.kill()
    assert {path: path.stat().st_mtime for path in entries(harness.cache)} == before
    assert harness.hit()
    for path in (folder, *folder.glob("*"), *folder.glob("*/*")):
        path.chmod(0o755)


def test_foreign_files_do_no_harm_and_come_to_none(harness: Harness, tmp_path: Path) -> None:
    cache = harness.cache
    (path,) = entries(cache)
    recipe = path.name.partition("-")[0]
    outside = tmp_path / "outside"
    (outside / "deep").mkdir(parents=True)
    (outside / "deep" / "theirs.json").write_text("{}" * 10_000)
    (cache.folder / "linked").symlink_to(outside)
    (cache.folder / "notes.json").write_text("{}")
    (cache.folder / "ab").mkdir(exist_ok=True)
    (cache.folder / "ab" / "file").write_text("where a folder should be")
    foreign = path.with_name("README")
    foreign.write_text("hello")
    path.with_name(f"{recipe}-folder.json").mkdir()
    os.mkfifo(path.with_name(f"{recipe}-fifo.json"))
    path.with_name(f"{recipe}-loop.json").symlink_to(f"{recipe}-loop.json")
    path.with_name(f"{recipe}-zero.json").symlink_to("/dev/zero")
    Path(os.fsdecode(os.fsencode(path.parent) + b"/\xff.json")).write_text("{}")
    assert harness.hit()
    assert [kept.node for kept in cache.traces_of(1, "pkg", harness.script.name, None)[1]] == ["/node"]
    cache.max_bytes = 1
    cache.sweep()
    assert not harness.hit()
    assert foreign.exists()
    assert (outside / "deep" / "theirs.json").exists()
    cache.max_bytes = 1 << 30
    assert not harness.trace().cached
    assert harness.hit()


def test_entries_of_other_versions_are_swept_as_any(harness: Harness) -> None:
    old = harness.cache.folder / "0a" / ("0" * 64)
    old.mkdir(parents=True)
    (old / f"{'1' * 32}.json").write_text("of version 2")
    os.utime(old / f"{'1' * 32}.json", (0, 0))
    harness.cache.max_bytes = sum(path.stat().st_size for path in entries(harness.cache)) - 1
    harness.cache.sweep()
    assert not old.exists()
    assert harness.hit()


def test_libraries_of_other_versions_are_bounded(tmp_path: Path) -> None:
    old = [tmp_path / f"roscpp-{number:032x}.so" for number in range(MOST_KEPT + 2)]
    for number, path in enumerate(old):
        path.write_text("of another compiler")
        os.utime(path, (number, number))
    broken_off, in_the_making = tmp_path / ".old", tmp_path / ".new"
    for folder in (broken_off, in_the_making):
        folder.mkdir()
        (folder / "made.so").write_text("half a libr")
    os.utime(broken_off, (0, 0))
    (tmp_path / "notes.so").write_text("not ours")
    library = Library(tmp_path)
    made = library.build().path
    assert made is not None
    assert {path.name for path in tmp_path.iterdir()} == {
        os.path.basename(made),
        seal_of(Path(made)).name,
        *(path.name for path in old[-MOST_KEPT + 1 :]),
        in_the_making.name,
        "notes.so",
    }
    os.utime(made, (0, 0))
    assert library.build().path == made
    assert Path(made).stat().st_mtime > 0, "it is in use"
