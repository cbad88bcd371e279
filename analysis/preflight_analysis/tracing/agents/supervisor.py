"""The sandbox's first process of ours: starts the node, is its master, and decides when the run is over.

The job comes on standard input as JSON; what is seen goes to standard output as JSON lines. The host treats those as
coming from the node itself, which could write them as well. When this process ends, the kernel ends every other
process of the sandbox's pid namespace with it, or where there is none, the keeper does (`landlock_launcher`).
"""

from __future__ import annotations

import binascii
import json
import os
import select
import signal
import socket
import struct
import sys
import time
from typing import Any, Optional

from .params import ParamTree
from .process import cpu_seconds, exit_code, host_is_gone, limit, queued_seconds, shared_objects
from .run import MAX_EVENTS, TICK, Run, drain, start

MASTER_PORT = 11311
_SET_SECCOMP = 22


def _load(params: ParamTree, pairs: list[list[Any]]) -> None:
    def decode(value: Any) -> Any:
        if isinstance(value, dict):
            if list(value) == ["$binary"]:
                from .xml_rpc import Binary  # noqa: PLC0415

                return Binary(binascii.a2b_base64(value["$binary"]))
            return {key: decode(below) for key, below in value.items()}
        return [decode(item) for item in value] if isinstance(value, list) else value

    for name, value in pairs:
        params.set(name, decode(value))


def main() -> None:
    """Run the job and end, and with it everything in the sandbox, whatever happens."""
    job: dict[str, Any] = {}
    try:
        job = json.load(sys.stdin)
        _refuse(job["filter"])
        _main(job)
    finally:
        # Process 1 stays for as long as it has children, and bubblewrap's dies with its own parent only once it has
        # asked for that: a host that was killed while the sandbox started would leave the node behind.
        try:
            if job.get("alone") or os.getpid() == 2:
                os.kill(-1, signal.SIGKILL)
        except ProcessLookupError:
            pass
        finally:
            os._exit(0)


def _main(job: dict[str, Any]) -> None:
    if host_is_gone():
        return
    if "compile" in job:
        from . import compiling  # noqa: PLC0415

        compiling.report(job["root"], job["temporary"], Run(job).emit)
        return
    for folder in job["folders"]:
        os.makedirs(folder, exist_ok=True)
    for path, text in job["files"].items():
        with open(path, "w", encoding="utf-8", errors="replace") as file:
            file.write(text)
    fifo = job["env"]["PREFLIGHT_EVENTS"]
    if not os.path.exists(fifo):
        os.mkfifo(fifo, 0o600)
    events = os.open(fifo, os.O_RDWR | os.O_NONBLOCK | os.O_CLOEXEC)
    server = _screen(job) if job.get("screen") else None
    run = Run(job)
    run.screen = server
    if "output" in job:
        from . import command  # noqa: PLC0415

        command.watch(run, events)
        return
    listening = socket.socket()
    listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    listening.bind(("127.0.0.1", MASTER_PORT))
    listening.listen(64)
    wake_read, failure_read = start(run)
    # After the fork on purpose: until the node reaches its first call, the sockets' backlog holds it.
    from . import stub_master  # noqa: PLC0415
    from .probe_topics import TopicProbes  # noqa: PLC0415

    params = ParamTree()
    _load(params, job["params"])
    run.master = stub_master.serve(listening, params, run.master_report)
    run.topic_probes = TopicProbes(run.master, run.publish, lambda event: run.emit({"own": {"ev": event}}))

    status, code, why = _watch(run, events, wake_read)
    if status == "ended" and code == 127:
        failed = os.read(failure_read, 1000)
        if failed:
            status, why = "exec-failed", failed.decode(errors="replace")
    run.emit({"own": {"ev": "maps", "paths": shared_objects(run.pid)[:2000]}})
    run.emit(
        {
            "own": {
                "ev": "end",
                "status": status,
                "code": code,
                "why": why,
                "waits": run.blocked_by() if status == "timed-out" else [],
                "withdrawn": run.master.withdrawn()[:MAX_EVENTS] if status == "spinning" else [],
                "initialised": run.initialised,
                "dropped": run.dropped,
                "seconds": time.monotonic() - run.started,
                "cpu": cpu_seconds(run.pid),
                "queued": run.queued,
            }
        }
    )


def _screen(job: dict[str, Any]) -> int:
    """Start the X server that the job asks for, and tell the node of it."""
    from . import screen  # noqa: PLC0415

    pid, display = screen.start(job["screen"], lambda: limit(job["rlimits"]))
    if display is not None:
        job["env"]["DISPLAY"] = display
    return pid


def _refuse(program: str) -> None:
    """Apply a filter of system calls (hexadecimal), where whoever made the sandbox could not."""
    if not program:
        return
    import ctypes  # noqa: PLC0415

    code = ctypes.create_string_buffer(bytes.fromhex(program))
    described = struct.pack("=HxxxxxxQ", len(program) // 16, ctypes.addressof(code))
    if ctypes.CDLL(None, use_errno=True).prctl(_SET_SECCOMP, 2, ctypes.c_char_p(described)) != 0:
        raise OSError(ctypes.get_errno(), "no filter of system calls")


def _watch(run: Run, events: int, wake: int) -> tuple[str, Optional[int], str]:
    """Read events until the node is over. The status, and where it ended itself its exit code or minus the signal."""
    rest = b""
    followed = False
    while True:
        ready = select.select([events, wake], [], [], TICK)[0]
        ended = None
        if wake in ready:
            os.read(wake, 512)
            ended = exit_code(run.pid)
        elif followed:
            ended = None if run.process_limits.left_behind(run.screen) else 0
        rest = drain(run, events, rest)
        if ended == 0 and not run.initialised and not followed and (left := run.process_limits.left_behind(run.screen)):
            # It goes on as a daemon, or was a script that started the node in the background.
            followed, run.pid, ended = True, left[0], None
            run.queued = queued_seconds(run.pid)
        if ended is not None:
            if run.topic_probes is not None and run.topic_probes.made:
                return "spinning", None, ""  # it was, until we talked to it
            return "ended", ended, ""
        reason = run.process_limits.exceeded() or ("abandoned" if host_is_gone() else run.over())
        if reason is not None:
            return reason, None, ""
