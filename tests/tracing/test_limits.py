"""What a node ends for that only the sandbox lacks."""

from __future__ import annotations

import tempfile
import threading
from pathlib import Path

import pytest
from preflight_analysis.tracing import limits
from preflight_analysis.tracing.dependencies import Dependencies
from preflight_analysis.tracing.interface import Interface, Outcome
from preflight_analysis.tracing.observation import Observation
from preflight_analysis.tracing.request import TraceRequest
from preflight_analysis.tracing.trace import Tracer
from support.tracing_harness import environment, own, trace, write_node


def lacks(*said: str, status: str = "crashed", wrote: tuple[str, ...] = ()) -> str | None:
    outcome = Outcome(status, 1, None, said, f"it ended with exit code 1: {said[-1]}")  # type: ignore[arg-type]
    observed = Observation(Interface("trace", outcome), Dependencies(), lasting=True, wrote=wrote)
    return limits.explained(observed, ()).outcome.lacks


@pytest.mark.parametrize(
    ("said", "what"),
    [
        ("Less than 1G of space free on disk with /x.bag. Disabling recording.", "room"),
        ("OSError: [Errno 28] No space left on device", "room"),
        ("OSError: [Errno 30] Read-only file system: '/opt/x'", "write files"),
        ("[1:0101/1:FATAL:zygote_host_impl_linux.cc(90)] Running as root without --no-sandbox", "browsers"),
        ("selenium WebDriverException: unknown error: DevToolsActivePort file doesn't exist", "browsers"),
        ("qt.qpa.xcb: could not connect to display", "display"),
        ("_tkinter.TclError: no display name and no $DISPLAY environment variable", "display"),
        ("OSError: [Errno 101] Network is unreachable", "network"),
        ("ConnectionRefusedError: [Errno 111] Connection refused", "network"),
        ("OSError: [Errno 99] Cannot assign requested address", "network"),
        ("socket.gaierror: [Errno -3] Temporary failure in name resolution", "network"),
        ("serial.SerialException: could not open port /dev/ttyUSB0: No such file", "the device /dev/ttyUSB0"),
        ("/ws/bin/httpd: error while loading shared libraries: libssl.so.1.0.0: cannot open", "shared library"),
        ("OSError: [Errno 8] Exec format error: '/ws/lib/p/driver'", "a processor of another kind"),
        ("EOFError: EOF when reading a line", "a terminal"),
        ("termios.error: (25, 'Inappropriate ioctl for device')", "a terminal"),
        ("ERROR: Wrong input topic (or topic field): /imu", "publish a topic"),
    ],
)
def test_words_that_tell(said: str, what: str) -> None:
    found = lacks("before", said)
    assert found is not None
    assert what in found


@pytest.mark.parametrize(
    "said",
    [
        "KeyError: '~rate'",
        "FileNotFoundError: [Errno 2] No such file or directory: '/nowhere/model.json'",
        "ValueError: cannot display a map without cells",
        "OSError: [Errno 2] No such file or directory: '/etc/nothing'",
        "could not write to /dev/null",
        '  File "/home/me/dev/ws/src/p/nodes/lane_net.py", line 3, in <module>',
    ],
)
def test_words_that_are_the_nodes_own(said: str) -> None:
    assert lacks(said) is None


def test_a_node_that_ended_well_lacked_nothing() -> None:
    assert lacks("Network is unreachable", status="spinning") is None


def test_a_warning_long_before_is_not_what_it_ended_for() -> None:
    assert lacks("Network is unreachable", *["..."] * 10, "KeyError: 'x'") is None


def test_files_that_are_there_and_not_shown(tmp_path: Path) -> None:
    there = tmp_path / "map.yaml"
    there.write_text("")
    assert lacks(f"FileNotFoundError: '{there}'") == f"'{there}', which the sandbox does not show"
    assert lacks(f"FileNotFoundError: '{tmp_path}/mop.yaml'") is None


def test_files_that_it_would_write(tmp_path: Path) -> None:
    path = str(tmp_path / "log.csv")
    expected = f"to write '{path}', which the sandbox does not let it"
    assert lacks(f"FileNotFoundError: '{path}'", wrote=(path,)) == expected
    assert lacks(f"Error writing: Error opening file: {path}") == expected
    assert lacks(f"FileNotFoundError: '{path}'") is None
    assert lacks(f"Error writing: Error opening file: {tmp_path}/gone/x.bag") is None


@pytest.mark.ros
@pytest.mark.parametrize("args", [("-a",), ("/scan", "-o", "/tmp/x")])
def test_rosbag_finds_room_to_record(args: tuple[str, ...]) -> None:
    asked = TraceRequest("/rec", "rosbag", "/usr/lib/rosbag/record", args)
    found = Tracer(environment(), None).trace(asked, threading.Event())
    assert found.outcome.status == "spinning", found.outcome
    assert ("subscriber", "/scan", "*") in own(found) or args == ("-a",)


@pytest.mark.ros
def test_a_node_with_a_folder_that_it_may_not_write_to() -> None:
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder)
        node = write_node(
            place,
            f"""
            import rospy
            rospy.init_node("n")
            open({folder!r} + "/log.csv", "w")
            rospy.spin()
        """,
        )
        outcome = trace(node).outcome
        assert outcome.status == "crashed"
        assert outcome.lacks == "to write files where the sandbox lets nobody write"
