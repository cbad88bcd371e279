"""Launch files that hypothesis makes, asked of us and of real roslaunch: values, and the error with file and reason.

A difference belongs into fixtures/ros1/meaning as a case of its own.
"""

from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from support.launch_strategies import cases
from support.meaning_harness import Roslaunch, ask_us, write_case
from tools.against_roslaunch import differences

pytestmark = pytest.mark.ros


@pytest.fixture(scope="module")
def roslaunch() -> Iterator[Roslaunch]:
    with Roslaunch() as process:
        yield process


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("generated")


@settings(max_examples=400, derandomize=True, deadline=None, suppress_health_check=list(HealthCheck))
@given(text=cases())
def test_generated_launch_files_mean_what_roslaunch_means(text: str, roslaunch: Roslaunch, folder: Path) -> None:
    job = write_case(text, folder)
    record, answer = roslaunch.ask(job), ask_us(job)
    assert differences(record, answer) == []
