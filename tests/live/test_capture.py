"""`capture` beside real nodes: what it writes is what a run of them would have told."""

from __future__ import annotations

import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest
import yaml
from support.command import Done
from support.live_harness import Ros1System, preflight, private_domain
from support.ros2_harness import Ros2Harness, node_of, ros2_prefix
from support.waiting import until

pytestmark = pytest.mark.ros

BODY = """
rospy.Publisher('chatter', String, queue_size=1)
rospy.Publisher('~state', Int32, queue_size=1)
rospy.Publisher('/absolute', String, queue_size=1)
rospy.Subscriber('before', String, print)
rospy.Service('~reset', Trigger, print)
"""
LAUNCH = """<node pkg="pkg" type="node.py" name="n" ns="robot"><remap from="before" to="/after"/></node>
<node pkg="pkg" type="plain.py" name="plain"/>"""
ANNOTATION = """\
<!--
  <topics>
    <topic name="/absolute" type="std_msgs/String" class="pub"/>
    <topic name="chatter" type="std_msgs/String" class="pub"/>
    <topic name="~state" type="std_msgs/Int32" class="pub"/>
    <topic name="before" type="std_msgs/String" class="sub"/>
  </topics>
  <services>
    <service name="~reset" type="std_srvs/Trigger" class="server"/>
  </services>
-->
"""


@pytest.fixture
def system(tmp_path: Path) -> Iterator[Ros1System]:
    system = Ros1System(tmp_path)
    system.node("node.py", BODY)
    system.node("plain.py", "")
    yield system
    system.close()


def captured(environment: dict[str, str], *args: str | Path, code: int = 0) -> Done:
    """What `capture` says once it has seen the system: that takes its time."""
    found: list[Done] = []

    def tried() -> bool:
        found.append(preflight(environment, "capture", *args, "--timeout", "60"))
        return found[-1].code == code

    until(tried)
    return found[-1]


def test_the_annotation_of_a_running_node_is_what_it_does(system: Ros1System) -> None:
    file = system.launch_file(LAUNCH)
    system.launch(file)
    done = captured(system.environment, file, "--no-run", "--node", "robot/n")
    assert (done.out, done.err) == (f"{file}:2:1: /robot/n\n{ANNOTATION}", "")

    before = file.read_text()
    done = captured(system.environment, file, "--no-run", "--node", "/robot/n", "--write")
    assert (done.out, done.err) == ("", f"{file}: 1 annotation written\n")
    assert "".join(file.read_text().split()) == "".join(before.replace("<remap", ANNOTATION + "<remap", 1).split()), (
        "nothing else changed"
    )
    known = preflight(system.environment, "watch", file, "--no-run", "--once", "--timeout", "60")
    assert known.out == "no differences, 2 nodes as expected\n"
    again = captured(system.environment, file, "--no-run", "--node", "/robot/n", "--write")
    assert "is annotated already" in again.err


def test_those_that_cannot_be_run_are_captured_as_settings(system: Ros1System) -> None:
    # The sandbox has no such file, the running system has.
    (system.home / "device").write_text("")
    system.node("node.py", f"open({str(system.home / 'device')!r})\n" + BODY)
    file = system.launch_file(LAUNCH)
    system.launch(file)
    done = captured(system.environment, file, "--format", "settings")
    settings = yaml.safe_load(done.out)
    (entry,) = settings["nodes"]
    assert (entry["package"], entry["executable"], "name" in entry) == ("pkg", "node.py", False)
    assert {"name": "~reset", "type": "std_srvs/Trigger", "class": "server"} in entry["services"]
    assert {"name": "before", "type": "std_msgs/String", "class": "sub"} in entry["topics"]

    (system.package / ".ros-preflight.yaml").write_text(done.out)
    (system.package / ".git").mkdir()  # the top of the project
    done = preflight(system.environment, "graph", file, "--no-run")
    assert "node /robot/n  settings" in done.out
    assert "topic /after  std_msgs/String  none -> /robot/n" in done.out


def test_what_is_not_captured_is_told(system: Ros1System) -> None:
    file = system.launch_file(LAUNCH)
    done = preflight(system.environment, "capture", file, "--no-run", "--timeout", "0")
    assert (done.code, done.out, "connection refused" in done.err) == (2, "", True)
    system.launch(system.launch_file('<node pkg="pkg" type="plain.py" name="other"/>', "other.launch"))
    until(lambda: "/other" in preflight(system.environment, "watch", file, "--once", "--timeout", "0", "--no-run").out)
    done = preflight(system.environment, "capture", file, "--no-run", "--timeout", "0", "--node", "/plain")
    assert (done.code, done.out, done.err) == (1, "", "/plain is not captured: it is not running\n")
    done = preflight(system.environment, "capture", file, "--no-run", "--node", "/nothing")
    assert (done.code, "it has: /robot/n, /plain" in done.err) == (2, True)


def test_nodes_of_ros2_are_captured(tmp_path: Path) -> None:
    body = """
    self.create_publisher(String, 'chatter', 10)
    self.create_publisher(String, '~/state', 10)
    self.create_client(Trigger, '/map/load')
    """
    with private_domain() as domain:
        harness = Ros2Harness(tmp_path, talker=node_of(body, "from std_srvs.srv import Trigger"))
        launch = (
            "<launch>\n  <node pkg='pkg' exec='talker' name='talker' namespace='robot'>"
            "<remap from='chatter' to='/elsewhere'/></node>\n</launch>\n"
        )
        file = harness.write("launch/a.launch.xml", launch)
        environment = {
            **harness.variables,
            "XDG_CACHE_HOME": str(tmp_path / "cache"),
            "ROS_DOMAIN_ID": str(domain),
            "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
            "ROS_LOG_DIR": str(tmp_path / "log"),
        }
        remaps = ["-r", "__node:=talker", "-r", "__ns:=/robot", "-r", "chatter:=/elsewhere"]
        node = subprocess.Popen(
            [ros2_prefix() / "bin/python3", "-c", "from pkg.talker import main; main()", "--ros-args", *remaps],
            env=environment,
            cwd=harness.package,
        )
        wanted = """<!--
      <topics>
        <topic name="chatter" type="std_msgs/msg/String" class="pub"/>
        <topic name="~state" type="std_msgs/msg/String" class="pub"/>
      </topics>
      <services>
        <service name="/map/load" type="std_srvs/srv/Trigger" class="client"/>
      </services>
    -->"""
        try:

            def written() -> bool:
                file.write_text(launch)
                preflight(environment, "capture", file, "--no-run", "--all", "--write", "--timeout", "60")
                return wanted in file.read_text()

            until(written)
        finally:
            node.kill()
            node.wait()
