"""Real systems that run beside a test: roslaunch with a master of its own, nodes of rclpy in a domain of their own."""

from __future__ import annotations

import contextlib
import fcntl
import json
import os
import queue
import random
import signal
import socket
import subprocess
import sys
import threading
import time
import xmlrpc.client
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from support.command import Done, run_command
from support.ros2_harness import Ros2Harness, ros2_prefix
from support.tracing_harness import SYSTEM_PYTHON

LIMIT_SECONDS = 60
COMMAND = Path(sys.executable).with_name("ros-preflight")


def private_port() -> int:
    """A port that is free, and that no outgoing connection takes: those have higher numbers."""
    while True:
        port = random.randrange(12000, 32000)
        with socket.socket() as tried, suppress(OSError):
            tried.bind(("127.0.0.1", port))
            return port


@contextmanager
def private_domain() -> Iterator[int]:
    """A domain of ROS 2 that no other test has."""
    numbers = random.sample(range(10, 100), 90)
    for number in numbers:
        with Path("/tmp", f"ros-preflight-domain-{number}.lock").open("w") as lock:
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except OSError:
                continue
            yield number
            return
    raise AssertionError("there is no free domain")


@dataclass
class Ros1System:
    """A workspace with the package `pkg`, and a master of its own."""

    home: Path
    port: int = field(default_factory=private_port)
    running: list[subprocess.Popen[bytes]] = field(default_factory=list)
    elsewhere: Path | None = None
    """Another folder to look for packages in."""

    def __post_init__(self) -> None:
        self.package = self.home / "workspace/src/pkg"
        self.package.mkdir(parents=True)
        (self.package / "package.xml").write_text('<package format="2"><name>pkg</name></package>')

    @property
    def environment(self) -> dict[str, str]:
        return {
            "PATH": "/usr/bin:/bin",
            "HOME": str(self.home),
            "XDG_CACHE_HOME": str(self.home / "cache"),
            "ROS_HOME": str(self.home / "ros"),
            "ROS_LOG_DIR": str(self.home / "log"),
            "ROS_IP": "127.0.0.1",
            "ROS_PACKAGE_PATH": os.pathsep.join(str(p) for p in (self.package.parent, self.elsewhere) if p is not None),
            "ROS_MASTER_URI": f"http://127.0.0.1:{self.port}/",
        }

    def node(self, name: str, body: str) -> Path:
        """An executable of the package that makes what `body` says."""
        path = self.package / name
        path.write_text(
            "#!/usr/bin/python3\nimport rospy\nfrom std_msgs.msg import Int32, String\n"
            f"from std_srvs.srv import Empty, Trigger\nrospy.init_node('unnamed')\n{body}\nrospy.spin()\n"
        )
        path.chmod(0o755)
        return path

    def launch_file(self, content: str, name: str = "a.launch") -> Path:
        path = self.package / name
        path.write_text(f"<launch>\n{content}\n</launch>\n")
        return path

    def launch(self, file: Path) -> subprocess.Popen[bytes]:
        """Start the real roslaunch, which starts the master."""
        return self.start("/usr/bin/roslaunch", "-p", str(self.port), str(file))

    def start(self, program: str | Path, *args: str) -> subprocess.Popen[bytes]:
        """Start a program of Python."""
        process = subprocess.Popen(
            [SYSTEM_PYTHON, str(program), *args],
            env=self.environment,
            cwd=self.home,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        self.running.append(process)
        return process

    def stop(self, launch: subprocess.Popen[bytes]) -> None:
        """Have roslaunch end what it started."""
        launch.send_signal(signal.SIGINT)
        launch.wait(LIMIT_SECONDS)

    def node_names(self) -> set[str]:
        """The nodes that the master knows."""
        with xmlrpc.client.ServerProxy(f"http://127.0.0.1:{self.port}/") as master:
            state: Any = master.getSystemState("/test")
        return {node for side in state[2] for _, nodes in side for node in nodes}

    def pid(self, name: str) -> int:
        """The process of the node that registered under this name."""
        with self._node(name) as node:
            answer: Any = node.getPid("/test")
        return int(answer[2])

    def shut_down(self, name: str) -> None:
        """Have a node end, as `rosnode kill` does; a signal may come before it has its handler."""
        # It may be gone before it has answered.
        with self._node(name) as node, contextlib.suppress(ConnectionError):
            node.shutdown("/test", "the test wants it")

    def _node(self, name: str) -> xmlrpc.client.ServerProxy:
        with xmlrpc.client.ServerProxy(f"http://127.0.0.1:{self.port}/") as master:
            address: Any = master.lookupNode("/test", name)
        return xmlrpc.client.ServerProxy(address[2])

    def close(self) -> None:
        """End all that was started."""
        for process in self.running:
            if process.poll() is None:
                process.send_signal(signal.SIGINT)
        for process in self.running:
            try:
                process.wait(LIMIT_SECONDS)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
        for found in Path("/proc").glob("[0-9]*/environ"):
            with suppress(OSError):
                if f"ROS_HOME={self.home / 'ros'}".encode() in found.read_bytes().split(b"\0"):
                    os.kill(int(found.parent.name), signal.SIGKILL)


class Ros2System:
    """Nodes of the package `pkg` in a domain of their own."""

    def __init__(self, folder: Path, domain: int, launch: str, **modules: str) -> None:
        self.harness = Ros2Harness(folder, **modules)
        self.file = self.harness.write("launch/a.launch.xml", launch)
        self.environment = {
            **self.harness.variables,
            "XDG_CACHE_HOME": str(folder / "cache"),
            "ROS_DOMAIN_ID": str(domain),
            "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
            "ROS_LOG_DIR": str(folder / "log"),
        }
        self.running: list[subprocess.Popen[bytes]] = []

    def start(self, module: str, *rules: str, domain: int | None = None) -> subprocess.Popen[bytes]:
        """Start a node with these remaps, in another domain if given."""
        remaps = [word for rule in rules for word in ("-r", rule)]
        process = subprocess.Popen(
            [ros2_prefix() / "bin/python3", "-c", f"from pkg.{module} import main; main()", "--ros-args", *remaps],
            env=self.environment if domain is None else {**self.environment, "ROS_DOMAIN_ID": str(domain)},
            cwd=self.harness.package,
            stdin=subprocess.DEVNULL,
        )
        self.running.append(process)
        return process

    def close(self) -> None:
        for process in self.running:
            process.kill()
            process.wait()


class Watching:
    """A `ros-preflight watch --format json` that goes on, and what it says."""

    def __init__(self, environment: dict[str, str], *args: str | Path) -> None:
        self._lines: queue.Queue[dict[str, Any] | None] = queue.Queue()
        self.seen: list[dict[str, Any]] = []
        self.process = subprocess.Popen(
            [str(COMMAND), "watch", *map(str, args), "--format", "json"],
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        threading.Thread(target=self._read, daemon=True).start()

    def _read(self) -> None:
        assert self.process.stdout is not None
        for line in self.process.stdout:
            self._lines.put(json.loads(line))
        self._lines.put(None)

    def until(self, wanted: Callable[[dict[str, Any]], Any]) -> dict[str, Any]:
        """The next event that is wanted."""
        give_up = time.monotonic() + LIMIT_SECONDS
        while True:
            try:
                event = self._lines.get(timeout=max(0.0, give_up - time.monotonic()))
            except queue.Empty:
                raise AssertionError(f"not told within {LIMIT_SECONDS} s; last: {self.seen[-3:]}") from None
            assert event is not None, self.process.stderr and self.process.stderr.read()
            self.seen.append(event)
            if wanted(event):
                return event

    def until_told(self, *messages: str) -> dict[str, Any]:
        """The next state in which these are exactly the differences that count."""
        return self.until(lambda event: event["event"] == "state" and differences(event) == sorted(messages))

    def interrupted(self) -> tuple[int, dict[str, Any]]:
        """Its exit code after an interrupt, and the last event: on a busy machine a node may have failed to answer."""
        self.process.send_signal(signal.SIGINT)
        code = self.process.wait(LIMIT_SECONDS)
        while (event := self._lines.get(timeout=LIMIT_SECONDS)) is not None:
            self.seen.append(event)
        return code, self.seen[-1]

    def close(self) -> None:
        """Interrupt it, as a user does."""
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGINT)
        self.process.communicate(timeout=LIMIT_SECONDS)


def differences(state: dict[str, Any]) -> list[str]:
    """What counts."""
    return sorted(issue["message"] for issue in state.get("issues", ()) if issue["counts"])


def preflight(environment: dict[str, str], *args: str | Path, cwd: Path | None = None) -> Done:
    """The command as installed, with time for a system to come up."""
    return run_command(COMMAND, *args, environment=environment, cwd=cwd, seconds=180)


def registered(system: Ros1System, name: str, pids: list[int] | None = None) -> bool:
    """Whether a node can be asked; its process is added to `pids`."""
    try:
        pid = system.pid(name)
    except (OSError, xmlrpc.client.Error, TypeError, IndexError):
        return False
    if pids is not None:
        pids.append(pid)
    return True
