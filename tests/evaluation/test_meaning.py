"""Our evaluation against real roslaunch: each file of fixtures/ros1/meaning is asked of both."""

from pathlib import Path
from typing import Any

import pytest
from against_roslaunch import differences
from meaning_desk import Job, Roslaunch, ask_us, write_case

pytestmark = pytest.mark.ros

CASES = sorted((Path(__file__).parents[2] / "fixtures" / "ros1" / "meaning").glob("*.txt"))


@pytest.fixture(scope="module")
def answers(tmp_path_factory: pytest.TempPathFactory) -> dict[str, tuple[Job, dict[str, Any]]]:
    jobs = [write_case(case.read_bytes().decode(), tmp_path_factory.mktemp(case.stem)) for case in CASES]
    with Roslaunch() as roslaunch:
        return {case.stem: (job, roslaunch.ask(job)) for case, job in zip(CASES, jobs, strict=True)}


@pytest.mark.parametrize("name", [case.stem for case in CASES])
def test_means_what_roslaunch_means(name: str, answers: dict[str, tuple[Job, dict[str, Any]]]) -> None:
    job, record = answers[name]
    assert differences(record, ask_us(job)) == []
