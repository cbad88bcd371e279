"""The sandbox's first process of ours: starts the node, is its master, and decides when the run is over.

The job comes on standard input as JSON; what is seen goes to standard output as JSON lines. The host treats those as
coming from the node itself, which could write them as well. When this process ends, the kernel ends every other
process of the sandbox's pid namespace with it, or where there is none, the keeper does (`landlock_launcher`).
"""

from __future__ import annotations

import binascii
import json
import os
import resource
import select
import signal
import socket
import struct
import sys
import threading
import time
from typing import TYPE_CHECKING, Any, Optional

from .census import Census
from .params import ParamTree

if TYPE_CHECKING:
    from .visits import Visits

MASTER_PORT = 11311
MAX_LINE = 64_000
MAX_EVENTS = 20_000
EVENTS = frozenset(
    (
        "endpoint",
        "frame",
        "node",
        "param",
        "asked",
        "answered",
        "feed",
        "state",
        "files",
        "wrote",
        "woven",
        "weave-failed",
    )
)
_SET_SECCOMP = 22
TICK = 0.02
"""Seconds between looks at the clock."""


class Run:
    """One node, from exec to the end. Times are seconds of the monotonic clock."""

    def __init__(self, job: dict[str, Any]) -> None:
        self.job = job
        self.census = Census(job["most_processes"], job["most_memory"], job["alone"], job["written"], job["most_disk"])
        self.lock = threading.Lock()
        self.told: set[str] = set()
        self.count = 0
        self.dropped = 0
        self.started = self.active = time.monotonic()
        self.spins = False
        self.idle = False
        self.looped = False
        self.starving = False
        self.ending = False
        self.fed_until = 0.0
        self.initialised = False
        self.woven = False
        self.registered = False
        self.pause_until = 0.0
        self.waits: list[tuple[str, str]] = []
        self.lookups: dict[str, int] = {}
        self.polled = ""
        self.polled_at = 0.0
        self.cpu = 0.0
        self.queued = 0.0
        """Seconds for which the node wanted a processor and got none."""
        self.stretch = 0.0
        """The part of it by which its time is longer."""
        self.pid = -1
        self.screen: Optional[int] = None
        """The process of the node's X server."""
        self.master: Any = None
        self.feeder: Any = None
        self.visits: Optional[Visits] = None

    def emit(self, record: dict[str, Any]) -> bool:
        """One line to the host; repetitions are left out. Whether it was new."""
        line = json.dumps(record, sort_keys=True)
        with self.lock:
            if line in self.told or self.count >= MAX_EVENTS:
                return False
            self.told.add(line)
            self.count += 1
            sys.stdout.write(line + "\n")
            sys.stdout.flush()
            return True

    def master_report(self, event: str, **fields: Any) -> None:
        """What the stub master hears. Polling for a service is no activity, or a waiting node would never be quiet."""
        if event == "m-lookup":
            self._lookup(fields["name"])
        self.registered = self.registered or event == "m-endpoint"
        if event == "m-endpoint" and fields["role"] == "service" and fields["name"].endswith("/set_logger_level"):
            self.initialised = True  # the last thing that roscpp and rospy do at their start
        # A parameter that is asked for again and again is none either.
        if self.emit({"own": dict(fields, ev=event)}) and event != "m-lookup":
            self.active = time.monotonic()

    def _lookup(self, service: str) -> None:
        self.lookups[service] = self.lookups.get(service, 0) + 1
        if self.lookups[service] > 2:
            self.polled, self.polled_at = service, time.monotonic()

    def node_line(self, line: bytes) -> None:
        """One line from the event FIFO."""
        try:
            event = json.loads(line)
        except (ValueError, RecursionError):
            event = None
        if not isinstance(event, dict) or event.get("ev") not in EVENTS:
            self.dropped += 1
            return
        self.woven = self.woven or event["ev"] == "woven"
        if event["ev"] == "state":
            self._state(event)
            return
        if event["ev"] == "feed":
            self.feed(str(event.get("topic"))[:300], str(event.get("goal") or "")[:300])
            return
        if event["ev"] == "endpoint":
            self._offer_visit(event)
        if self.emit({"node": event}) and event["ev"] in ("endpoint", "param"):
            # Only what is new: a parameter that a loop reads in each turn would keep the node from ever being quiet.
            self.active = time.monotonic()

    def feed(self, topic: str, goal: str = "") -> None:
        """The node gets made-up messages. Most need none, so it is imported only now."""
        if self.master is None:
            return
        if self.feeder is None:
            from . import feeder  # noqa: PLC0415

            self.feeder = feeder.Feeder(self.master)
        self.feeder.feed(topic, goal)

    def _offer_visit(self, endpoint: dict[str, Any]) -> None:
        """Whether somebody at the other end could make a difference."""
        role, topic = endpoint.get("role"), endpoint.get("resolved")
        lazy = (role == "publisher" and endpoint.get("awaits") is True) or (
            role == "subscriber" and endpoint.get("type") == "*"
        )
        if self.visits is not None and lazy and isinstance(topic, str):
            self.visits.offer(str(role), topic)

    def _state(self, event: dict[str, Any]) -> None:
        state, now = event.get("state"), time.monotonic()
        alone = not event.get("threads")
        if state == "spin" and alone:
            self.spins = True
        elif state in ("spin", "idle", "looped"):
            self.idle = True
            self.looped = self.looped or (state == "looped" and alone)
            self.starving = event.get("starving") is True
            self.pause_until = 0.0
        elif state == "busy":
            self.starving = False
        elif state == "ending":
            self.ending = True
        elif state == "fed":
            # Whatever loop it was in, it may leave now: it has to show one again.
            self.idle = self.looped = self.starving = False
            self.active = now
            seconds = event.get("seconds")
            self.fed_until = now + max(0.3, min(float(seconds), 2.0) if isinstance(seconds, (int, float)) else 0.0)
        elif state == "init":
            self.initialised = True
            self.active = now
        elif state == "sleep" and not self.idle and isinstance(event.get("seconds"), (int, float)):
            self.pause_until = now + min(float(event["seconds"]), 60.0)
        elif state in ("wait", "resume"):
            wait = (str(event.get("kind"))[:20], str(event.get("name"))[:300])
            if state == "wait":
                self.emit({"node": event})
                if event.get("main"):
                    self.waits.append(wait)
            elif wait in self.waits:
                self.waits.remove(wait)
                self.active = now

    def _polls(self) -> bool:
        """Whether a node that no hook watches (roscpp) asks for the same missing service over and over."""
        return bool(self.polled) and not self.idle and time.monotonic() - self.polled_at < 1.0

    def blocked_by(self) -> list[tuple[str, str]]:
        """What the node waits for, as far as known."""
        return self.waits[-1:] or ([("service", self.polled)] if self._polls() else [])

    def over(self) -> Optional[str]:
        """Why to stop now: `spinning`, `timed-out`, or None."""
        why = self._over()
        if why == "spinning" and self.visits is not None:
            fed = self.feeder is not None and self.feeder.busy()
            return None if self.visits.busy(self.pid, self.active, fed) else why
        return why

    def _leave_out_queueing(self, now: float) -> None:
        """What a node does must not depend on what else the machine does: while others have the processors it is
        neither quiet, nor is its time running."""
        queued = _queued_seconds(self.pid)
        if queued > self.queued:
            more, self.queued = queued - self.queued, queued
            self.active = min(now, self.active + more)
            self.stretch = min(self.job["limits"]["stretch"], self.stretch + more)

    def _over(self) -> Optional[str]:
        now = time.monotonic()
        if self.spins:
            return "spinning"
        self._leave_out_queueing(now)
        if now - self.started > self.job["limits"]["wall"] + self.stretch:
            return "timed-out"
        if self.ending:
            return None
        if self.feeder is not None and self.feeder.busy():
            self.fed_until = max(self.fed_until, now + 0.3)
        if self.waits or now < max(self.pause_until, self.fed_until) or self._polls():
            return None
        quiet = now - max(self.active, self.pause_until)
        if self.starving and quiet < self.job["limits"]["starving"]:
            return None
        if self.idle and quiet > self.job["limits"]["looped" if self.looped else "quiet"]:
            return "spinning"
        # An event loop that no hook knows: up and running, asleep, and nothing new for a good while.
        settled = self.job["limits"]["settled"]
        # Whose client library is none that we know has no sign of when it is up.
        if quiet > (settled if self.initialised else 2 * settled) and (
            self.initialised or (self.registered and not self.woven)
        ):
            used = _cpu_seconds(self.pid)
            if used - self.cpu < 0.05:
                return "spinning"
            self.cpu, self.active = used, now
        return None


def _cpu_seconds(pid: int) -> float:
    try:
        with open(f"/proc/{pid}/stat") as stat:
            fields = stat.read().rpartition(")")[2].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
    except (OSError, IndexError, ValueError):
        return 0.0


def _queued_seconds(pid: int) -> float:
    """How long the main thread of a process has waited for a processor; 0 where the kernel does not count it."""
    try:
        with open(f"/proc/{pid}/schedstat") as stat:
            return int(stat.read().split()[1]) * 1e-9
    except (OSError, IndexError, ValueError):
        return 0.0


def _shared_objects(pid: int) -> list[str]:
    try:
        with open(f"/proc/{pid}/maps") as maps:
            paths = {line.rstrip("\n").partition("/")[2] for line in maps if "/" in line}
    except OSError:
        return []
    return sorted("/" + path for path in paths if not path.endswith("(deleted)"))


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


def _limit(limits: dict[str, int]) -> None:
    for name, wanted in limits.items():
        which = getattr(resource, "RLIMIT_" + name)
        hard = resource.getrlimit(which)[1]
        value = wanted if hard == resource.RLIM_INFINITY else min(wanted, hard)
        resource.setrlimit(which, (value, value))


def _first_to_go() -> None:
    """Where the machine's memory ends all the same, the kernel ends us and not the user's programs."""
    try:
        with open("/proc/self/oom_score_adj", "w") as file:
            file.write("1000")
    except OSError:
        pass


def _exec(job: dict[str, Any], failure: int, output: Optional[int]) -> None:
    """In the child: become the node or command. Returns never; what went wrong is written to the pipe `failure`."""
    try:
        os.setsid()
        _first_to_go()
        null = os.open(os.devnull, os.O_RDWR)
        os.dup2(null, 0)
        os.dup2(null if output is None else output, 1)
        signal.signal(signal.SIGPIPE, signal.SIG_DFL)  # Python ignores it, and what is ignored stays so over an exec
        os.chdir(job["cwd"])
        _limit(job["rlimits"])
        os.execve(job["argv"][0], job["argv"], job["env"])  # noqa: S606
    except OSError as error:
        os.write(failure, str(error.strerror).encode())
    finally:
        os._exit(127)


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

        compiling.tell(job["root"], job["temporary"], Run(job).emit)
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
    from .visits import Visits  # noqa: PLC0415

    params = ParamTree()
    _load(params, job["params"])
    run.master = stub_master.serve(listening, params, run.master_report)
    run.visits = Visits(run.master, run.feed, lambda event: run.emit({"own": {"ev": event}}))

    status, code, why = _watch(run, events, wake_read)
    if status == "ended" and code == 127:
        failed = os.read(failure_read, 1000)
        if failed:
            status, why = "exec-failed", failed.decode(errors="replace")
    run.emit({"own": {"ev": "maps", "paths": _shared_objects(run.pid)[:2000]}})
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
                "cpu": _cpu_seconds(run.pid),
                "queued": run.queued,
            }
        }
    )


def _screen(job: dict[str, Any]) -> int:
    """Start the X server that the job asks for, and tell the node of it."""
    from . import screen  # noqa: PLC0415

    pid, display = screen.start(job["screen"], lambda: _limit(job["rlimits"]))
    if display is not None:
        job["env"]["DISPLAY"] = display
    return pid


def start(run: Run, output: Optional[int] = None) -> tuple[int, int]:
    """Start the job's process, its standard output to the pipe `output`. Two pipes: one can be read when a child
    ended, the other has what kept the process from starting."""
    wake_read, wake_write = os.pipe()
    os.set_blocking(wake_write, False)
    failure_read, failure_write = os.pipe()
    signal.set_wakeup_fd(wake_write)
    signal.signal(signal.SIGCHLD, lambda *_: None)
    run.emit({"own": {"ev": "started"}})
    run.pid = os.fork()
    if run.pid == 0:
        _exec(run.job, failure_write, output)
    os.close(failure_write)
    return wake_read, failure_read


def _refuse(program: str) -> None:
    """Apply a filter of system calls (hexadecimal), where whoever made the sandbox could not."""
    if not program:
        return
    import ctypes  # noqa: PLC0415

    code = ctypes.create_string_buffer(bytes.fromhex(program))
    described = struct.pack("=HxxxxxxQ", len(program) // 16, ctypes.addressof(code))
    if ctypes.CDLL(None, use_errno=True).prctl(_SET_SECCOMP, 2, ctypes.c_char_p(described)) != 0:
        raise OSError(ctypes.get_errno(), "no filter of system calls")


def host_is_gone() -> bool:
    """Whether nobody reads our output any more."""
    poll = select.poll()
    poll.register(1, 0)
    return bool(poll.poll(0))


def exit_code(pid: int) -> Optional[int]:
    """The exit code of a child that has ended, minus the signal if one ended it."""
    done, status = os.waitpid(pid, os.WNOHANG)
    if done != pid:
        return None
    return -os.WTERMSIG(status) if os.WIFSIGNALED(status) else os.WEXITSTATUS(status)


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
            ended = None if run.census.left_behind(run.screen) else 0
        rest = drain(run, events, rest)
        if ended == 0 and not run.initialised and not followed and (left := run.census.left_behind(run.screen)):
            # It goes on as a daemon, or was a script that started the node in the background.
            followed, run.pid, ended = True, left[0], None
            run.queued = _queued_seconds(run.pid)
        if ended is not None:
            if run.visits is not None and run.visits.made:
                return "spinning", None, ""  # it was, until we talked to it
            return "ended", ended, ""
        reason = run.census.exceeded() or ("abandoned" if host_is_gone() else run.over())
        if reason is not None:
            return reason, None, ""


def drain(run: Run, events: int, rest: bytes) -> bytes:
    """What stands in the FIFO, but no more than fits into it at once: a flood must not keep us from the clock."""
    for _ in range(16):
        try:
            rest += os.read(events, 65536)
        except BlockingIOError:
            break
        *lines, rest = rest.split(b"\n")
        for line in lines:
            if len(line) > MAX_LINE or run.count >= MAX_EVENTS:
                run.dropped += 1
            else:
                run.node_line(line)
        # Too long already: its end is let go by, and the line counted once when it comes.
        rest = rest[: MAX_LINE + 1]
    return rest
