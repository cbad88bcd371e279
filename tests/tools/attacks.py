#!/usr/bin/env python3
"""The attacks of a hostile node with each backend, as root and as an ordinary user, as a table: `make attacks`.

The node tells of each attempt how it ended; what the host has to see is looked at on the host. An attempt that succeeds
does so with something of the run's own, but where the table in `docs/security.md` says otherwise: each result is
compared with that table. What cannot be tried on this machine is named.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import os
import pwd
import re
import shutil
import socket
import subprocess
import sys
import tempfile
import textwrap
import uuid
from collections.abc import Iterator, Mapping
from contextlib import ExitStack, closing
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))  # tests/, as pytest has it

import pytest
from preflight_analysis.tracing import sandbox
from support.ordinary_user import become, ordinary_user
from support.tracing_harness import planted_key, trace, write_node

ROOT = Path(__file__).parents[2]
SECURITY = ROOT / "docs" / "security.md"
COLUMNS = ("bubblewrap", "firejail", "landlock")
IDENTITIES = ("root", "user")
_CASES = re.compile(r"^\| `([a-z0-9-]+)` \| ([^|]*) \| ([^|]*) \| ([^|]*) \| ([^|]*) \|$", re.MULTILINE)
_SYSTEM_PYTHON = "/usr/bin/python3"

NODE = r"""
import ctypes, errno, json, os, platform, resource, socket, struct, sys
given = json.loads(sys.argv[1])
libc = ctypes.CDLL(None, use_errno=True)
column = ["x86_64", "aarch64"].index(platform.machine())
found = {}

def attempt(name):
    def run(action):
        try:
            found[name] = "done" if action() is not False else "nothing"
        except OSError as error:
            found[name] = errno.errorcode.get(error.errno, type(error).__name__)
        return action
    return run

def call(numbers, *arguments):
    passed = [ctypes.c_long(a) if isinstance(a, int) else a for a in arguments]
    if libc.syscall(ctypes.c_long(numbers[column]), *passed, *[ctypes.c_long(0)] * (6 - len(passed))) == -1:
        raise OSError(ctypes.get_errno(), "")

def connect(family, kind, address):
    with socket.socket(family, kind) as end:
        end.settimeout(2)
        end.connect(address)

host, key, precious, port = given["host"], given["key"], given["precious"], given["port"]
work = os.path.dirname(precious)

attempt("home-read")(lambda: open(key).read())
attempt("home-listed")(lambda: os.path.basename(os.path.dirname(key)) in os.listdir(given["home"]))
attempt("home-known")(lambda: os.stat(key))
attempt("home-write")(lambda: open(os.path.join(given["home"], given["name"]), "w"))
attempt("host-tmp-read")(lambda: open(given["shared"]).read())
attempt("host-tmp-write")(lambda: open("/tmp/" + given["name"], "w"))
attempt("etc-write")(lambda: open("/etc/" + given["name"], "w"))
attempt("root-write")(lambda: os.mkdir("/" + given["name"]))
def anywhere():
    for place in ("/sys/kernel", "/sys/power", "/proc/sys/kernel", "/proc/sys/vm", "/proc"):
        try:
            names = os.listdir(place)
        except OSError:
            continue
        for name in names:
            try:
                os.close(os.open(os.path.join(place, name), os.O_WRONLY | os.O_NONBLOCK))
            except OSError:
                continue
            return True
    return False
attempt("kernel-switches")(anywhere)
def writable():
    for place, folders, _ in os.walk("/run"):
        try:
            os.mkdir(os.path.join(place, given["name"]))
        except OSError:
            continue
        return not place.startswith("/run/firejail/mnt")
    return False
attempt("run-write")(writable)
attempt("var-tmp-write")(lambda: open("/var/tmp/" + given["name"], "w"))
attempt("shared-memory-write")(lambda: open("/dev/shm/" + given["name"], "w"))
attempt("shadow-read")(lambda: open("/etc/shadow").read(1) != "")
attempt("workspace-read")(lambda: open(precious).read())
attempt("workspace-write")(lambda: open(precious, "w"))
attempt("workspace-truncate")(lambda: os.truncate(precious, 0))
attempt("workspace-unlink")(lambda: os.unlink(precious))
attempt("workspace-rename")(lambda: os.rename(precious, precious + "2"))
attempt("workspace-link")(lambda: os.link(precious, os.environ["HOME"] + "/link"))
attempt("workspace-chmod")(lambda: os.chmod(precious, 0o777))
attempt("workspace-fchmod")(lambda: os.fchmod(os.open(precious, os.O_RDONLY), 0o777))
attempt("workspace-chown")(lambda: os.chown(precious, os.getuid(), os.getgid()))
attempt("workspace-utime")(lambda: os.utime(precious, (1, 1)))
attempt("workspace-xattr")(lambda: os.setxattr(precious, "user.x", b"x"))
attempt("workspace-empty")(lambda: os.open(precious, os.O_RDONLY | os.O_TRUNC))
def control(numbers, given):
    import fcntl
    last = None
    for number in numbers:
        for path in (precious, work):
            try:
                return fcntl.ioctl(os.open(path, os.O_RDONLY), number, given)
            except OSError as error:
                last = error
    raise last
attempt("workspace-flags")(lambda: control((0x40086602, 0x40046602), struct.pack("=Q", 0x80)))
attempt("workspace-flags-extended")(lambda: control((0x401C5820,), struct.pack("=I24x", 0x40)))
attempt("workspace-version")(lambda: control((0x40087602, 0x40047602, 0x40086604), struct.pack("=Q", 7)))
attempt("workspace-verity")(lambda: control((0x40806685,), struct.pack("=IIII112x", 1, 1, 4096, 0)))
attempt("workspace-encryption")(lambda: control((0x800C6613, 0xC0406618, 0xC0506617), bytes(80)))
def fcntl_of(path, *given):
    import fcntl
    fcntl.fcntl(os.open(path, os.O_RDONLY), *given)
attempt("workspace-lease")(lambda: fcntl_of(precious, 1024, 0))
attempt("workspace-delegation")(lambda: fcntl_of(work, 1040, struct.pack("=IHH", 0, 0, 0)))
attempt("workspace-notify")(lambda: fcntl_of(work, 1026, 0x1F))
def lock():
    import fcntl
    fcntl.flock(os.open(precious, os.O_RDONLY), fcntl.LOCK_EX | fcntl.LOCK_NB)
attempt("workspace-lock")(lock)
attempt("workspace-new")(lambda: os.mkdir(precious + "3"))
attempt("core-pattern")(lambda: open("/proc/sys/kernel/core_pattern", "w"))
attempt("device")(lambda: os.mknod(os.environ["HOME"] + "/disk", 0o60600, os.makedev(8, 0)))

attempt("host-environment")(lambda: open("/proc/%d/environ" % host).read())
attempt("host-memory")(lambda: open("/proc/%d/mem" % host, "rb"))
attempt("host-files")(lambda: os.readlink("/proc/%d/fd/0" % host))
attempt("host-command-line")(lambda: open("/proc/%d/cmdline" % host).read())
attempt("signal-host")(lambda: os.kill(host, 0))
attempt("signal-group")(lambda: os.killpg(given["group"], 0))
attempt("signal-queued")(lambda: call((129, 138), host, 0, ctypes.c_char_p(bytes(128))))
attempt("signal-by-handle")(lambda: call((424, 424), os.pidfd_open(host), 0))
attempt("limit-host")(lambda: resource.prlimit(host, resource.RLIMIT_CORE))
attempt("schedule-host")(lambda: os.sched_setaffinity(host, os.sched_getaffinity(0)))
def owner():
    import fcntl
    fcntl.fcntl(socket.socketpair()[0], 8, host)
attempt("signal-by-socket")(owner)

attempt("loopback-tcp")(lambda: connect(socket.AF_INET, socket.SOCK_STREAM, ("127.0.0.1", port)))
attempt("loopback-tcp6")(lambda: connect(socket.AF_INET6, socket.SOCK_STREAM, ("::ffff:127.0.0.1", port)))
def in_passing():
    with socket.socket() as end:
        end.sendto(b"x", 0x20000000, ("127.0.0.1", port))
attempt("loopback-fast-open")(in_passing)
def datagram():
    with socket.socket(type=socket.SOCK_DGRAM) as end:
        end.sendto(b"x", ("127.0.0.1", port))
attempt("loopback-udp")(datagram)
attempt("network-tcp")(lambda: connect(socket.AF_INET, socket.SOCK_STREAM, ("192.0.2.1", 9)))
attempt("network-raw")(lambda: socket.socket(socket.AF_INET, socket.SOCK_RAW, 1))
def connect_multipath():
    with socket.socket(socket.AF_INET, socket.SOCK_STREAM, 262) as end:
        end.settimeout(2)
        end.connect(("127.0.0.1", port))
attempt("multipath-tcp")(connect_multipath)
attempt("virtual-machine-socket")(lambda: socket.socket(40, socket.SOCK_STREAM))
attempt("unix-socket")(lambda: connect(socket.AF_UNIX, socket.SOCK_STREAM, given["editors"]))
attempt("unix-socket-in-workspace")(lambda: connect(socket.AF_UNIX, socket.SOCK_STREAM, given["workspaces"]))
for name in ("renamed", "linked", "moved", "relative"):
    attempt("unix-socket-" + name)(lambda: connect(socket.AF_UNIX, socket.SOCK_STREAM, given[name]))
attempt("abstract-socket")(lambda: connect(socket.AF_UNIX, socket.SOCK_STREAM, given["abstract"]))
def log():
    socket.socketpair(socket.AF_UNIX, socket.SOCK_DGRAM)[0].sendto(b"x", given["log"])
attempt("unix-datagram")(log)

attempt("ptrace")(lambda: call((101, 117), 16, host))
attempt("memory-of-process")(lambda: call((310, 270), host))
attempt("key-ring")(lambda: call((250, 219), 0, -3))
attempt("io-uring")(lambda: call((425, 425), 1))
attempt("user-name-space")(lambda: call((272, 97), 0x10000000))
attempt("mount")(lambda: call((165, 40)))
attempt("kernel-program")(lambda: call((321, 280)))
attempt("terminal-input")(lambda: call((16, 29), 0, 0x5412))
attempt("fifo-write")(lambda: os.open(given["fifo"], os.O_WRONLY | os.O_NONBLOCK))
attempt("second-proc")(lambda: any(n.isdigit() for n in os.listdir(given["proc"])))
attempt("second-proc-root")(lambda: os.listdir("%s/%d/root" % (given["proc"], host)))
attempt("second-disk-write")(lambda: open(os.path.dirname(given["proc"]) + "/disk/" + given["name"], "w"))
attempt("linked-home")(lambda: open(work + "/keys/id_ed25519").read())
attempt("git-config")(lambda: open(work + "/.git/config").read())
attempt("interfaces")(lambda: set(os.listdir("/sys/class/net")) - {"lo"} != set())
def addresses():
    found = [path for path in given["addresses"] if os.path.exists(path) and open(path).read().strip()]
    return found != []
attempt("interface-addresses")(addresses)
attempt("interfaces-by-netlink")(lambda: {name for _, name in socket.if_nameindex()} - {"lo"} != set())
attempt("environment-token")(lambda: os.environ.get("PREFLIGHT_TOKEN") is not None)
attempt("environment-address")(lambda: any("user:pw" in value for value in os.environ.values()))
attempt("shared-memory-of-host")(lambda: call((30, 196), given["segment"], 0, 0o10000))
attempt("setuid")(lambda: os.setuid(12345))

text = json.dumps(found)
for start in range(0, len(text), 400):
    print("part", text[start:start + 400], file=sys.stderr)
"""

GREED = {
    "memory-private": "kept.append(bytearray(b'x') * size)",
    "memory-file": "kept.append(os.memfd_create('x')); os.write(kept[-1], bytes(size))",
    "memory-mapped": """
kept.append(mmap.mmap(-1, size))
kept[-1].write(bytes(size))
kept[-1].madvise(mmap.MADV_DONTNEED)
""",
    "memory-file-systems": """
for folder in ("/tmp", "/dev/shm", "/var/tmp", "/run", os.path.expanduser("~"), os.environ.get("TMPDIR", "/")):
    try:
        with open("%s/%d" % (folder, n), "wb", 0) as file:
            kept.append(file.write(bytes(size)))
    except OSError:
        pass
""",
    "memory-sockets": """
sent = 0
while sent < size:
    kept += socket.socketpair()
    sent += fill(kept[-1])
""",
    "memory-closed-sockets": """
sent = 0
while sent < size:
    end, other = socket.socketpair()
    kept.append(other)
    sent += fill(end)
    end.close()
""",
    "memory-in-flight": """
file = os.memfd_create("x")
os.write(file, bytes(size))
kept += kept or socket.socketpair()
socket.send_fds(kept[0], [b"x"], [file])
os.close(file)
""",
    "memory-of-system-v": """
segment = libc.shmget(0, size, 0o1600)
if segment < 0:
    raise PermissionError("refused")
at = libc.shmat(segment, None, 0)
ctypes.memset(at, 1, size)
libc.shmdt(ctypes.c_void_p(at))
""",
    "inotify-instances": "kept.append(libc.inotify_init1(0))",
    "inotify-watches": """
kept = kept or [libc.inotify_init1(0)]
for m in range(100):
    path = "%s/%d-%d" % (os.path.expanduser("~"), n, m)
    os.mkdir(path)
    libc.inotify_add_watch(kept[0], path.encode(), 2)
""",
}
"""What takes more and more of something that the machine or its user has, in turns, each of 8 MiB if it is memory."""
GREEDY = """
import ctypes, mmap, os, resource, socket, sys, time
libc = ctypes.CDLL(None)
libc.shmat.restype = ctypes.c_void_p
kept, size = [], 8 << 20

def fill(end):
    sent = 0
    end.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, 4 << 20)
    end.setblocking(False)
    try:
        while True:
            sent += end.send(bytes(1 << 16))
    except BlockingIOError:
        return sent

for n in range(60):
    {turn}
    time.sleep(0.01)
time.sleep(0.5)
sys.exit(3)
"""
GREEDY_BYTES = 150 << 20
"""How much memory such a node may have."""


def documented() -> dict[str, dict[str, set[str]]]:
    """The table of docs/security.md: what each attempt may come to, by backend."""
    rows = _CASES.findall(SECURITY.read_text())
    return {row[0]: {name: set(cell.split(", ")) for name, cell in zip(COLUMNS, row[2:], strict=True)} for row in rows}


def _silent(receiver: socket.socket) -> bool:
    """Whether nothing came."""
    receiver.setblocking(False)
    try:
        receiver.recv(1) if receiver.type == socket.SOCK_DGRAM else receiver.accept()
    except BlockingIOError:
        return True
    return False


@contextlib.contextmanager
def _sockets_with_other_names(folder: Path, streams: list[socket.socket]) -> Iterator[dict[str, str]]:
    """Listeners in the workspace that the kernel knows by a name that they do not have any more, or not only, or not
    whole. They are added to `streams`."""
    other = folder / "other"
    other.mkdir()
    found = {name: str(folder / name) for name in ("renamed", "linked", "relative")} | {"moved": str(other / "moved")}
    with ExitStack() as at_end:
        for name in found:
            streams.append(at_end.enter_context(closing(socket.socket(socket.AF_UNIX))))
            if name == "relative":
                before = os.getcwd()
                os.chdir(folder)
                streams[-1].bind(name)
                os.chdir(before)
            else:
                streams[-1].bind(str(folder / f"{name}-at-first"))
            streams[-1].listen()
        os.rename(folder / "renamed-at-first", found["renamed"])
        os.link(folder / "linked-at-first", found["linked"])
        os.rename(folder / "moved-at-first", found["moved"])
        yield found


def attack(folder: Path, proc: str = "") -> dict[str, str]:
    """Run the node in an empty folder, with the backend that the environment chooses: how each attempt ended.

    Raises `AssertionError` if the host was touched. `proc` is a second procfs of the host's, with a disk beside it;
    without one, which only root can mount, that is not tried.
    """
    name = f"preflight-{uuid.uuid4().hex[:10]}"
    precious = folder / "precious"
    precious.write_text("as it was")
    before = precious.stat()
    with ExitStack() as at_end:
        key = at_end.enter_context(planted_key())
        shared = at_end.enter_context(tempfile.NamedTemporaryFile(prefix="preflight-", dir="/tmp"))
        shared.write(b"x")
        shared.flush()
        tcp = at_end.enter_context(closing(socket.create_server(("127.0.0.1", 0))))
        port = tcp.getsockname()[1]
        udp = at_end.enter_context(closing(socket.socket(type=socket.SOCK_DGRAM)))
        udp.bind(("127.0.0.1", port))
        sockets = {"editors": f"/tmp/{name}.sock", "workspaces": str(folder / "s"), "abstract": "\0" + name}
        streams = [at_end.enter_context(closing(socket.socket(socket.AF_UNIX))) for _ in sockets]
        for stream, address in zip(streams, sockets.values(), strict=True):
            stream.bind(address)
            stream.listen()
        at_end.callback(os.unlink, sockets["editors"])
        sockets |= at_end.enter_context(_sockets_with_other_names(folder, streams))
        log = at_end.enter_context(closing(socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)))
        log.bind(f"/tmp/{name}.log")
        at_end.callback(os.unlink, f"/tmp/{name}.log")
        (folder / "keys").symlink_to(key.parent)
        (folder / ".git").mkdir()
        (folder / ".git" / "config").write_text("token")
        os.mkfifo(folder / "pipe")
        pipe = os.open(folder / "pipe", os.O_RDONLY | os.O_NONBLOCK)
        at_end.callback(os.close, pipe)
        host = subprocess.Popen([sys.executable, "-c", "input()"], stdin=subprocess.PIPE, start_new_session=True)
        at_end.callback(host.wait)
        at_end.callback(host.kill)
        assert host.stdin is not None
        at_end.callback(host.stdin.close)
        given = {
            **sockets,
            "log": f"/tmp/{name}.log",
            "host": host.pid,
            "group": host.pid,
            "key": str(key),
            "home": str(Path.home()),
            "name": name,
            "shared": shared.name,
            "precious": str(precious),
            "port": port,
            "segment": 0,
            "fifo": str(folder / "pipe"),
            "proc": proc or "/nonexistent",
            "addresses": [os.path.realpath(path) for path in Path("/sys/class/net").glob("[!l]*/address")],
        }
        secrets = {"PREFLIGHT_TOKEN": "secret", "ROS_PACKAGES_FROM": "https://user:pw@example.org/"}
        outcome = trace(write_node(folder, NODE), args=(json.dumps(given),), variables=secrets).outcome
        assert outcome.exit_code == 0, outcome
        assert all(map(_silent, (tcp, *streams, udp, log))), "something came to a socket of the host's"
        assert host.poll() is None, "a process of the host's was ended"
    assert precious.read_text() == "as it was"
    after = precious.stat()
    for what in ("st_mode", "st_uid", "st_mtime", "st_nlink", "st_ctime"):
        assert getattr(after, what) == getattr(before, what), f"{what} of a file of the workspace was changed"
    assert sorted(path.name for path in folder.iterdir()) == sorted(
        [
            ".git",
            "keys",
            "linked",
            "linked-at-first",
            "node.py",
            "other",
            "pipe",
            "precious",
            "relative",
            "renamed",
            "s",
        ]
    )
    places = (Path.home(), Path("/tmp"), Path("/etc"), Path("/var/tmp"), Path("/dev/shm"), Path("/"))
    assert not [place for place in places if (place / name).exists()]
    said = [line.partition(" ")[2] for line in outcome.stderr_tail if line.startswith("part ")]
    found: dict[str, str] = json.loads("".join(said))
    return found if proc else {case: ended for case, ended in found.items() if not case.startswith("second-")}


def take(folder: Path, what: str) -> str:
    """Run the node that takes too much of something, in a folder of its own, where it may have `GREEDY_BYTES`."""
    body = GREEDY.format(turn=textwrap.indent(GREED[what], "    ").strip())
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(sandbox, "MEMORY_BYTES", GREEDY_BYTES)
        outcome = trace(write_node(folder, body)).outcome
    if outcome.exit_code == 3:
        return "done"
    if outcome.exit_code == 1:
        return "EPERM" if "PermissionError" in str(outcome.reason) else str(outcome.reason)
    return "ended" if str(outcome.reason).endswith("was stopped") else str(outcome.reason)


# As whom


def attack_all(proc: str) -> dict[str, dict[str, str]]:
    """How the attempts ended with each backend, as the user that this process is; where one does not work, why."""
    found: dict[str, dict[str, str]] = {}
    for name in COLUMNS:
        os.environ[sandbox.CHOICE] = name
        sandbox.forget()
        status = sandbox.probe()
        if not status.works:
            found[name] = {"": str(status.reason)}
            continue
        with tempfile.TemporaryDirectory(prefix="preflight-attack-", dir="/tmp") as folder:
            try:
                found[name] = attack(Path(folder), proc)
            except AssertionError as error:
                found[name] = {"": f"the host was touched: {error}"}
        for what in GREED:
            with tempfile.TemporaryDirectory(prefix="preflight-attack-", dir="/tmp") as folder:
                found[name][what] = take(Path(folder), what)
    return found


def readable_python(name: str) -> list[str]:
    """A Python for another user that has what this one has."""
    site = next(path for path in sys.path if path.endswith("site-packages"))
    path = os.pathsep.join((str(ROOT / "analysis"), str(ROOT / "server"), str(ROOT / "tests"), site))
    for python in (sys.executable, _SYSTEM_PYTHON):
        probe = [*become(name), "env", f"PYTHONPATH={path}", python, "-c", "import tools.attacks"]
        if subprocess.run(probe, capture_output=True, check=False, cwd="/").returncode == 0:
            return [f"PYTHONPATH={path}", python]
    raise LookupError("neither this Python nor the system's can be used by another user")


def as_user(proc: str) -> dict[str, dict[str, str]]:
    """As an ordinary user; only root can become one."""
    with ordinary_user() as name:
        home = pwd.getpwnam(name).pw_dir
        variables = [f"HOME={home}", f"USER={name}", "PATH=/usr/bin:/bin:/usr/games"]
        command = [*become(name), "env", "-i", *variables, *readable_python(name), __file__, "--json", "--proc", proc]
        done = subprocess.run(command, capture_output=True, text=True, cwd=home, check=False)
    if done.returncode != 0:
        raise RuntimeError(done.stderr[-3000:])
    found: dict[str, dict[str, str]] = json.loads(done.stdout)
    return found


def wrong(found: Mapping[str, str], backend: str) -> dict[str, str]:
    """What is not as the page says."""
    documentation = documented()
    if "" in found:
        return dict(found)
    return {
        case: ended for case, ended in found.items() if ended not in documentation.get(case, {}).get(backend, set())
    }


@contextlib.contextmanager
def _second_proc() -> Iterator[str]:
    """A procfs where chroots have theirs, and beside it a disk that everybody may write to, in the mount name space of
    this process."""
    outside = Path(f"/opt/ros-preflight-{os.getpid()}")
    place = outside / "proc"
    disk = outside / "disk"
    for folder, kind in ((place, ("proc",)), (disk, ("tmpfs", "-o", "mode=1777"))):
        folder.mkdir(parents=True)
        subprocess.run(["mount", "-t", *kind, kind[0], folder], check=True)
    try:
        yield str(place)
        assert list(disk.iterdir()) == []
    finally:
        for folder in (place, disk):
            subprocess.run(["umount", "--lazy", folder], check=False)
        shutil.rmtree(outside, ignore_errors=True)


def everyone() -> dict[str, dict[str, dict[str, str]]]:
    """By identity and backend, how the attempts ended; an identity that cannot be had is not there.

    Root does it in a mount name space of its own, so that nothing is left behind whatever happens.
    """
    if os.geteuid() != 0:
        return {"user": attack_all("")}
    command = ["unshare", "--mount", "--propagation", "private", sys.executable, __file__, "--everyone"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError(done.stderr[-3000:])
    found: dict[str, dict[str, dict[str, str]]] = json.loads(done.stdout)
    return found


def table(found: Mapping[str, Mapping[str, Mapping[str, str]]]) -> Iterator[str]:
    """The lines of the table, and below it what could not be tried."""
    columns = [(backend, who) for backend in COLUMNS for who in IDENTITIES]
    documentation = documented()
    width = max(map(len, documentation))
    yield f"{'':{width}}" + "".join(f"  {f'{backend}/{who}':16}" for backend, who in columns)
    for case in documentation:
        cells = []
        for backend, who in columns:
            ended = found.get(who, {}).get(backend, {}).get(case, "not tried")
            cells.append(ended if ended in (*documentation[case][backend], "not tried") else f"! {ended}")
        yield f"{case:{width}}" + "".join(f"  {cell:16}" for cell in cells)
    for who in IDENTITIES:
        if who not in found:
            yield f"{who}: not tried: only root can be both"
        for backend, ended in found.get(who, {}).items():
            if "" in ended:
                yield f"{backend}/{who}: {ended['']}"


def main() -> int:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--json", action="store_true", help="as this user alone, as JSON")
    parser.add_argument("--proc", default="", help=argparse.SUPPRESS)
    parser.add_argument("--everyone", action="store_true", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.json:
        print(json.dumps(attack_all(options.proc)))
        return 0
    if options.everyone:
        with _second_proc() as proc:
            print(json.dumps({"root": attack_all(proc), "user": as_user(proc)}))
        return 0
    found = everyone()
    print("\n".join(table(found)))
    failures = {
        f"{backend}/{who}": bad
        for who, backends in found.items()
        for backend, ended in backends.items()
        if (bad := {case: how for case, how in wrong(ended, backend).items() if case})
    }
    for where, bad in failures.items():
        print(f"not as docs/security.md says with {where}: {bad}")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
