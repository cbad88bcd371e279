"""A name that a node makes up at random is another one in each run: none of them is a fact."""

from __future__ import annotations

import threading
from pathlib import Path
from typing import Any

import pytest
from preflight_analysis.tracing import run as runs
from preflight_analysis.tracing.cache import TraceCache
from preflight_analysis.tracing.interface import Endpoint, Interface, Outcome
from preflight_analysis.tracing.random_names import without_made_up
from preflight_analysis.tracing.trace import Tracer
from support.ros2_harness import Ros2Harness, node_of
from support.stand_in_harness import without_rospy
from support.tracing_harness import environment, own, request, write_node

NODE = """
    import rospy
    from std_msgs.msg import String
    {imports}
    rospy.init_node('n')
    rospy.Publisher('sure', String, queue_size=1)
    rospy.Publisher('t' + str({value}), String, queue_size=1)
    rospy.spin()
"""
RANDOM = [
    ("import random", "random.randint(0, 1)"),
    ("from random import choice", "choice(['a', 'b'])"),
    ("import random", "random.Random().randint(0, 1)"),
    ("import uuid", "uuid.uuid4().hex"),
    ("import secrets", "secrets.token_hex(4)"),
    ("import os", "os.urandom(4).hex()"),
    ("import os", "os.getpid()"),
    ("import time", "int(time.time())"),
    ("import time", "time.time_ns() // 10**9"),
]
FACTS = [
    ("import random; random.seed(3)", "'opic'"),
    ("import random; speed = random.random()", "'opic'"),
    ("import random; numbers = random.Random(3)", "'opic%d' % 12345"),
]


def run(tmp_path: Path, imports: str, value: str) -> Interface:
    script = write_node(tmp_path, NODE.format(imports=imports, value=value))
    return Tracer(without_rospy(tmp_path), None).trace(request(script), threading.Event())


@pytest.mark.ros
@pytest.mark.parametrize(("imports", "value"), RANDOM, ids=[value for _, value in RANDOM])
def test_a_random_name_is_no_endpoint(tmp_path: Path, imports: str, value: str) -> None:
    found = run(tmp_path, imports, value)
    assert own(found) == {("publisher", "sure", "std_msgs/String")}
    (unnamed,) = found.unnamed
    assert (unnamed.role, unnamed.type) == ("publisher", "std_msgs/String")
    assert not found.complete
    assert not found.likely_complete
    (note,) = found.notes
    assert note.startswith("unresolved name: it publishes a name that is random in each run (std_msgs/String), line 8")


@pytest.mark.ros
@pytest.mark.parametrize(("imports", "value"), FACTS, ids=[imports for imports, _ in FACTS])
def test_what_is_the_same_in_each_run_is_a_fact(tmp_path: Path, imports: str, value: str) -> None:
    found = run(tmp_path, imports, value)
    assert len(own(found)) == 2
    assert (found.unnamed, found.notes, found.complete) == ((), (), True)


@pytest.mark.ros
def test_with_the_real_library(tmp_path: Path) -> None:
    script = write_node(tmp_path, NODE.format(imports="import random", value="random.randint(0, 1)"))
    found = Tracer(environment(tmp_path), None).trace(request(script), threading.Event())
    assert own(found) == {("publisher", "sure", "std_msgs/String")}
    assert len(found.unnamed) == 1


@pytest.mark.ros
def test_in_ros_2(tmp_path: Path) -> None:
    constructor = """
        import random
        self.create_publisher(String, f'topic{random.randint(0, 1)}', 1)
        self.create_publisher(String, 'sure', 1)
    """
    harness = Ros2Harness(tmp_path, node=node_of(constructor, "from std_msgs.msg import String"))
    found = harness.trace("node")
    assert {name for role, name, _ in own(found) if role == "publisher"} == {"sure"}
    assert [each.role for each in found.unnamed] == ["publisher"]


@pytest.mark.ros
def test_the_cache_remembers_it(tmp_path: Path) -> None:
    script = write_node(tmp_path, NODE.format(imports="import random", value="random.randint(0, 1)"))
    cache = TraceCache(tmp_path / "cache")
    first, second = (Tracer(without_rospy(tmp_path), cache).trace(request(script), threading.Event()) for _ in range(2))
    assert (first.cached, second.cached) == (False, True)
    assert second.unnamed == first.unnamed != ()


@pytest.mark.ros
@pytest.mark.parametrize(
    ("extra", "wanted"), [("", 1), ("import random; random.random()", 2), ("import time; time.time()", 1)]
)
def test_only_a_node_that_draws_runs_twice(
    tmp_path: Path, extra: str, wanted: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    body = """
        import rospy
        from std_msgs.msg import String
        {}
        rospy.init_node('n', anonymous=True)
        rospy.Publisher('a', String, queue_size=1)
        rospy.spin()
    """
    script = write_node(tmp_path, body.format(extra))
    started: list[object] = []
    execute = runs.execute

    def counted(*args: Any) -> runs.RawRun:
        started.append(args)
        return execute(*args)

    monkeypatch.setattr(runs, "execute", counted)
    Tracer(without_rospy(tmp_path), None).trace(request(script), threading.Event())
    assert len(started) == wanted


def test_nothing_follows_from_a_run_that_ended_otherwise() -> None:
    one = Interface("trace", Outcome("spinning"), (Endpoint("publisher", "a1", "x/Y", source_line=3),))
    other = Interface("trace", Outcome("crashed"), (Endpoint("publisher", "a2", "x/Y", source_line=3),))
    assert without_made_up(one, other) is one
    again = Interface("trace", Outcome("spinning"), other.endpoints)
    assert without_made_up(one, again).unnamed == one.endpoints
