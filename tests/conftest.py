"""What holds for all tests."""

from __future__ import annotations

import logging
import os
import shutil
import signal
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, settings
from preflight_analysis.edits.gate import RAISES
from preflight_analysis.findings.finding import Finding
from preflight_analysis.rules.rule import Rule
from support.build_once import VARIABLE, begin_run
from support.internals import shown_internals, texts_of
from support.logged_errors import LoggedErrors

_QUICK = ("git", "bash", "script", Path(sys.executable).name, "ros-preflight")
"""What a test may start that is marked neither `ros` nor `editor`: `make quick` runs it where nothing else is."""
_started: list[str] = []


def _record(event: str, args: tuple[Any, ...]) -> None:
    if event == "subprocess.Popen":
        _started.append(os.fsdecode(args[0]))


def pytest_configure(config: pytest.Config) -> None:
    # A shell that starts the tests in the background lets them ignore interrupts, and with them each program that a
    # test starts and interrupts.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    sys.addaudithook(_record)
    # The machine may be busy: how long an example takes says nothing.
    settings.register_profile("busy", deadline=None, suppress_health_check=[HealthCheck.too_slow])
    settings.load_profile("busy")
    if not hasattr(config, "workerinput"):
        folder = begin_run()
        config.add_cleanup(lambda: shutil.rmtree(folder, ignore_errors=True))
    assert VARIABLE in os.environ
    os.environ[RAISES] = "1"  # here and in the servers that tests start


def pytest_xdist_auto_num_workers() -> int:
    """Tests wait for nodes and editors a third of the time."""
    return max(1, len(os.sched_getaffinity(0)) * 3 // 2)


@pytest.fixture(autouse=True)
def nothing_of_ours_fails(request: pytest.FixtureRequest) -> Iterator[None]:
    """What breaks and costs a part of the result only is logged as an error; a test that wants that is marked."""
    errors = LoggedErrors()
    loggers = [logging.getLogger(name) for name in ("preflight_analysis", "preflight_server")]
    for logger in loggers:
        logger.addHandler(errors)
    yield
    for logger in loggers:
        logger.removeHandler(errors)
    if request.node.get_closest_marker("breaks") is None:
        assert errors.messages == [], "something of ours failed"


@pytest.fixture(autouse=True)
def findings_show_nothing_of_ours(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Whatever a rule says in a test is in words of users and of ROS; texts that are drawn at random have anything."""
    if "fuzzing" in request.path.parts:
        yield
        return
    said: dict[str, None] = {}
    make = Rule.claim

    def noted(*args: Any, **options: Any) -> Finding:
        finding = make(*args, **options)
        said.update(dict.fromkeys(texts_of((finding,))))
        return finding

    monkeypatch.setattr(Rule, "claim", noted)
    yield
    assert shown_internals(said) == []


@pytest.fixture(autouse=True)
def marked_for_what_it_starts(request: pytest.FixtureRequest) -> Iterator[None]:
    """A test that needs more than Python and git says so with its marker."""
    _started.clear()
    yield
    if request.node.get_closest_marker("ros") is None and request.node.get_closest_marker("editor") is None:
        strange = sorted({program for program in _started if Path(program).name not in _QUICK})
        assert strange == [], "a test that starts these is to be marked with `ros` or `editor`"
