"""Our evaluation against real roslaunch: each file of fixtures/ros1/meaning is asked of both."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from support.meaning_harness import Job, Roslaunch, ask_us, write_case
from tools.against_roslaunch import differences

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


PARAMETER_FILES = {
    "crlf.txt": b"a\r\nb\rc\n",
    "mark.txt": b"\xef\xbb\xbfx",
    "latin.txt": b"\xe4",
    "declared.txt": b'<?xml version="1.0" encoding="latin-1"?>\xe4',
    "declared-wrongly.txt": '<?xml version="1.0" encoding="latin-1"?>\u00e4'.encode(),
    "wide.txt": "x".encode("utf-16"),
    "crlf.yaml": b'a: |\r\n  x\r\n  y\r\nb: "c\r\n  d"\r\n',
    "mark.yaml": b"\xef\xbb\xbfa: 1\n",
    "latin.yaml": b"a: \xe4\n",
    "wide.yaml": "a: 1\n".encode("utf-16"),
    "two.yaml": b"--- {a: 1}\n--- {b: 1}\n",
    "separators.yaml": 'a: "x\x85y"\nb: "x\u2028y"\n'.encode(),
    "numbers.yaml": b"a: 0o17\nb: 017\nc: 0b11\nd: 1_000\ne: 1.e3\nf: 1.5e+3\ng: 1:30\nh: .5\ni: -0\nj: 09\nk: 1e3\n",
    "words.yaml": b"a: [y, Y, yes, YES, n, on, Off, TRUE, tRue, Null, ~, .inf, .nan, 2001-12-14, 4294967296]\n",
    "angles.yaml": b"a: deg(90) \nb: rad(2*pi)\nc: [deg(1), rad(1)]\nd: deg(-4.5)\ne: !degrees 180\nf: rad(sqrt(2))\n",
    "not-an-angle.yaml": b"a: rad(x)\n",
}


@pytest.fixture(scope="module")
def process() -> Iterator[Roslaunch]:
    with Roslaunch() as roslaunch:
        yield roslaunch


@pytest.mark.parametrize("name", PARAMETER_FILES)
def test_parameter_files_are_read_as_roslaunch_reads_them(name: str, tmp_path: Path, process: Roslaunch) -> None:
    tag = (
        f'rosparam file="$(dirname)/{name}"'
        if name.endswith(".yaml")
        else f'param name="p" textfile="$(dirname)/{name}"'
    )
    job = write_case(f"<launch><{tag}/></launch>", tmp_path)
    (tmp_path / name).write_bytes(PARAMETER_FILES[name])
    assert differences(process.ask(job), ask_us(job)) == []
