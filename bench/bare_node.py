"""A node without any of us: under a real rosmaster."""

from __future__ import annotations

import socket
import subprocess
import time
import xmlrpc.client
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

PYTHON = "/usr/bin/python3"


@contextmanager
def rosmaster(folder: str) -> Iterator[dict[str, str]]:
    """A real master on a free port; gives the environment for its nodes."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    variables = {
        "PATH": "/usr/bin:/bin",
        "HOME": folder,
        "ROS_LOG_DIR": folder,
        "ROS_IP": "127.0.0.1",
        "ROS_MASTER_URI": f"http://127.0.0.1:{port}/",
    }
    command = [PYTHON, "/usr/bin/rosmaster", "--core", "-p", str(port)]
    process = subprocess.Popen(command, env=variables, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        yield variables
    finally:
        process.kill()
        process.wait()


def registered(master: xmlrpc.client.ServerProxy, topic: str, node: str) -> bool:
    try:
        state = master.getSystemState("/bench")
    except OSError:
        return False
    return any(name == topic and node in nodes for side in state[2][:2] for name, nodes in side)  # type: ignore[index,union-attr]


def bare(script: Path, topic: str, variables: dict[str, str], number: int) -> float:
    """Seconds from exec to the registration of `topic`. Each run has a name of its own: a node that is killed stays
    registered."""
    master = xmlrpc.client.ServerProxy(variables["ROS_MASTER_URI"])
    while True:
        try:
            master.getPid("/bench")
            break
        except OSError:
            time.sleep(0.01)
    node = f"/{script.stem}{number}"
    topic = topic.replace("~", node + "/")
    began = time.perf_counter()
    process = subprocess.Popen(
        [*([PYTHON] if script.suffix == ".py" else ()), str(script), f"__name:={node[1:]}"],
        env=variables,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    try:
        while not registered(master, topic, node):
            if time.perf_counter() - began > 20:
                raise SystemExit(f"{script} did not register {topic}")
            time.sleep(0.002)
        return time.perf_counter() - began
    finally:
        process.kill()
        process.wait()
