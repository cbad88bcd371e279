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


def test_dots_behind_a_link_go_up_from_what_it_points_to(tmp_path: Path) -> None:
    text = """<launch>
<include file="$(dirname)/link/../child.launch"/>
<rosparam file="$(dirname)/link/../x.yaml"/>
</launch>
//- elsewhere/folder/x.txt
//- elsewhere/child.launch
<launch><param name="where" value="elsewhere"/></launch>
//- elsewhere/x.yaml
a: elsewhere
//- child.launch
<launch><param name="where" value="here"/></launch>
//- x.yaml
a: here
"""
    job = write_case(text, tmp_path)
    (tmp_path / "link").symlink_to("elsewhere/folder")
    with Roslaunch() as roslaunch:
        record = roslaunch.ask(job)
    answer = ask_us(job)
    record["includes"] = [{"file": str(tmp_path / "elsewhere" / "child.launch")}]
    answer["includes"] = [str(Path(path).resolve()) for path in answer["includes"]]
    assert differences(record, answer) == []
