"""Launches a file with the real roslaunch and prints what the real master shows of it, as JSON.

Run by the system's Python, which has ROS: `observe_launch.py FILE PORT`. Not a test module. Nodes that never come, or
leave again, are named in `absent`.
"""

import json
import os
import shlex
import signal
import subprocess
import sys
import time

import rosgraph
import rosservice
from roslaunch.config import load_config_default
from roslaunch.node_args import create_local_process_args

STABLE_SECONDS = 1.5
ABSENT_SECONDS = 6
"""How long the graph has to be stable for nodes that lack in it, and have ended, to be given up."""
LIMIT_SECONDS = 60


def described(path, port):
    """The nodes as roslaunch is going to start them, and its parameters."""
    config = load_config_default([path], port)
    nodes = []
    for node in config.nodes:
        argv = create_local_process_args(node, None)
        given = len(shlex.split(node.args))
        nodes.append(
            {
                "name": rosgraph.names.ns_join(node.namespace, node.name),
                "package": node.package,
                "executable": argv[0],
                "args": argv[1 : 1 + given],
                "remaps": [list(pair) for pair in node.remap_args],
                "env": [list(pair) for pair in node.env_args],
                "cwd": node.cwd,
            }
        )
    return {"nodes": nodes, "params": {name: param.value for name, param in config.params.items()}}


def state(master):
    """The master's whole state, in an order that can be compared."""
    return [sorted((name, sorted(nodes)) for name, nodes in side) for side in master.getSystemState()]


def queued(pid):
    """How many seconds a process has waited for a processor; 0 where the kernel does not count it."""
    try:
        with open("/proc/%s/schedstat" % pid) as file:
            return int(file.read().split()[1]) / 1e9
    except (OSError, IndexError):
        return 0.0


def running():
    """The nodes that have a process: by name, how many seconds it has waited for a processor that others had."""
    found = {}
    for entry in os.listdir("/proc"):
        try:
            with open("/proc/%s/cmdline" % entry, "rb") as file:
                words = file.read().decode(errors="replace").split("\0")
            with open("/proc/%s/environ" % entry, "rb") as file:
                variables = dict(v.split("=", 1) for v in file.read().decode(errors="replace").split("\0") if "=" in v)
        except OSError:
            continue
        if variables.get("ROS_MASTER_URI") == os.environ["ROS_MASTER_URI"]:
            name = next((word[8:] for word in words if word.startswith("__name:=")), "")
            found[rosgraph.names.ns_join(variables.get("ROS_NAMESPACE", "/"), name)] = queued(entry)
    return found


def shown(master, wanted):
    """For each node what `rosnode info` would print, once the graph has stopped changing and all nodes are in it."""
    began = since = time.time()
    last = None
    absent = wanted
    waited = before = 0.0
    # A machine that is busy with other things is no sign that the nodes have done all they do.
    while time.time() - since - (waited - before) < (ABSENT_SECONDS if absent else STABLE_SECONDS):
        if time.time() - began > LIMIT_SECONDS:
            raise SystemExit("the graph did not become stable, or lacks %s: %s" % (absent, last))
        time.sleep(0.1)  # between two looks
        try:
            now = state(master)
        except (OSError, rosgraph.MasterException):
            now = None
        alive = running()
        waited = max(waited, sum(alive.values()))
        if now is None or now != last:
            last, since, before = now, time.time(), waited
            absent = wanted - {node for side in now or () for _, nodes in side for node in nodes}
        if absent & set(alive):
            since, before = time.time(), waited
    types = dict(master.getTopicTypes())
    publishers, subscribers, services = last
    return {
        node: {
            "publishers": sorted([name, types[name]] for name, nodes in publishers if node in nodes),
            "subscribers": sorted([name, types.get(name)] for name, nodes in subscribers if node in nodes),
            "services": sorted([name, rosservice.get_service_type(name)] for name, nodes in services if node in nodes),
        }
        for node in wanted - absent
    }


def main():
    path, port = sys.argv[1], int(sys.argv[2])
    os.environ["ROS_MASTER_URI"] = "http://127.0.0.1:%d/" % port
    result = described(path, port)
    launch = subprocess.Popen(
        ["/usr/bin/python3", "/usr/bin/roslaunch", "-p", str(port), path],
        stdout=sys.stderr,
        start_new_session=True,
    )
    try:
        master = rosgraph.Master("/observer")
        names = {node["name"] for node in result["nodes"]}
        result["shown"] = shown(master, names)
        result["absent"] = sorted(names - set(result["shown"]))
    finally:
        launch.send_signal(signal.SIGINT)
        try:
            launch.wait(20)
        except subprocess.TimeoutExpired:
            os.killpg(launch.pid, signal.SIGKILL)
    print(json.dumps(result))


main()
