"""Launch files as people write them, asked of us and of real roslaunch: those of the fixtures, and of real projects.

The real projects are not part of the repository; where they lie beside it, every so many of their files is asked too
(`make corpus` compares all of them with what roslaunch said once).
"""

import json
import os
from pathlib import Path

import pytest
from support.meaning_harness import ENV, Job, Roslaunch, ask_us
from tools.against_roslaunch import differences

pytestmark = pytest.mark.ros

REPOSITORY = Path(__file__).parents[2]
FIXTURES = REPOSITORY / "fixtures" / "ros1"
CORPUS = REPOSITORY.parent / "shared" / "corpus" / "ros1"
EVERY = 67


def fixture_jobs() -> list[Job]:
    files = sorted(path for path in FIXTURES.rglob("*") if path.suffix in (".launch", ".test"))
    return [Job(str(file), (), tuple(ENV.items()), (str(FIXTURES),)) for file in files]


def corpus_jobs() -> list[Job]:
    if not CORPUS.is_dir():
        return []
    found = [json.loads(line) for line in (CORPUS / "jobs.jsonl").read_text().splitlines()[::EVERY]]
    return [
        Job(
            str(CORPUS / job["file"]),
            tuple(arg.replace("$ROOT", str(CORPUS)) for arg in job["args"]),
            tuple({**ENV, **{k: v.replace("$ROOT", str(CORPUS)) for k, v in job["env"].items()}}.items()),
            tuple(os.path.join(CORPUS, folder) for folder in job["package_path"]),
        )
        for job in found
    ]


def test_real_launch_files_mean_what_roslaunch_means() -> None:
    jobs = fixture_jobs() + corpus_jobs()
    assert len(jobs) > 5
    with Roslaunch() as roslaunch:
        found = {job: differences(roslaunch.ask(job), ask_us(job)) for job in jobs}
    assert {(job.file, job.args): different for job, different in found.items() if different} == {}
