"""The commands of docs/watch.md, run beside a system that is really launched."""

from __future__ import annotations

import re
import signal
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest
from support.live_harness import COMMAND, LIMIT_SECONDS, Ros1System, preflight
from support.waiting import until

pytestmark = pytest.mark.ros

PAGE = Path(__file__).parents[2] / "docs/watch.md"
SHOWN = re.findall(r"^ros-preflight (.*)$", PAGE.read_text(), re.MULTILINE)
LAUNCH = """<arg name="sim" default="false"/>
<node pkg="pkg" type="lidar.py" name="lidar"/>"""


@pytest.fixture
def system(tmp_path: Path) -> Iterator[Ros1System]:
    system = Ros1System(tmp_path)
    (system.home / "device").write_text("")
    # It cannot be run in the sandbox, which has no such file.
    system.node("lidar.py", f"open({str(system.home / 'device')!r})\nrospy.Publisher('scan', String, queue_size=1)")
    (system.package / "launch").mkdir()
    system.launch(system.launch_file(LAUNCH, "launch/robot.launch"))
    yield system
    system.close()


def test_all_of_them_are_known() -> None:
    assert [line.split()[0] for line in SHOWN] == ["watch", "capture", "capture", "capture", "watch"]


@pytest.mark.parametrize("line", sorted(set(SHOWN)))
def test_a_command_of_the_page(system: Ros1System, line: str) -> None:
    args = line.split()
    if args[0] == "watch" and "--once" not in args:
        process = subprocess.Popen(
            [COMMAND, *args], env=system.environment, cwd=system.package, stdout=subprocess.PIPE, text=True
        )
        assert process.stdout is not None
        try:
            assert any("no differences, 1 node as expected" in told for told in process.stdout)
        finally:
            process.send_signal(signal.SIGINT)
            process.communicate(timeout=LIMIT_SECONDS)
        return
    # What waits for nodes gives up after its time, which may be too short while the machine is busy.
    until(lambda: preflight(system.environment, *args, cwd=system.package).code == 0)
    if "--write" in args:
        assert (
            '<topic name="scan" type="std_msgs/String" class="pub"/>'
            in (system.package / "launch/robot.launch").read_text()
        )
