"""The process around a run that Landlock and a filter of system calls keep in, where there are no name spaces.

Started as a program of its own, with nothing but the standard library; `landlock` writes what it is told: a file
descriptor with JSON. It puts a child into the sandbox, which becomes the supervisor, and stays outside as its keeper:

- Landlock cannot say "this machine's loopback, but only what the run itself listens on", and knows nothing of Unix
  sockets. So the filter hands each `connect`, `bind` and `listen` to the keeper, who does it himself with an address
  that he has copied; the node cannot change it between the look and the deed. Every address is the loopback's, every
  port one that the kernel chooses: the port that the node asked for is a name for it, within this run only.
- Signals, limits and scheduling reach descendants of the keeper only.
- There is no process name space that would end with the run. The keeper adopts what daemonises, and ends everything
  that descends from it when the supervisor ends or the host lets go of its end of a pipe. From Linux 6.12 on that is
  one call, as signals of the keeper's cannot leave its own Landlock domain; before, as many as it takes.

Numbers and structures are from the kernel's `linux/landlock.h`, `linux/seccomp.h` and `linux/prctl.h`.
"""

from __future__ import annotations

import contextlib
import ctypes
import errno
import fcntl
import json
import os
import select
import shutil
import signal
import socket
import stat
import struct
import sys
import threading
import time
from typing import Any

READ_FILES, LIST, READ = 0x5, 0x8, 0xD
"""EXECUTE, READ_FILE; READ_DIR; all of them."""
CHANGE_FILES = 0x4002
"""WRITE_FILE, TRUNCATE."""
CHANGE = CHANGE_FILES | 0x37B0
"""All but devices: REMOVE_DIR, REMOVE_FILE, MAKE_DIR, MAKE_REG, MAKE_SOCK, MAKE_FIFO, MAKE_SYM, REFER."""
MAKE_PIPE = 0x0402
"""WRITE_FILE, MAKE_FIFO."""
_DEVICE_CONTROL = 0x8000
_FILE_RIGHTS = READ_FILES | CHANGE_FILES | _DEVICE_CONTROL
_FS_RIGHTS = {1: 0x1FFF, 2: 0x3FFF, 3: 0x7FFF, 4: 0x7FFF}
"""What each version can handle; from 5 on all 16."""
_NET_RIGHTS = 0x3
_SCOPE_SIGNAL, _SCOPE_ALL = 0x2, 0x3

_CREATE_RULESET, _ADD_RULE, _RESTRICT_SELF = 444, 445, 446
_SECCOMP = {"x86_64": 317, "aarch64": 277}
_PIDFD_GETFD = 438
_RECEIVE, _SEND, _STILL_VALID = 0xC0502100, 0xC0182101, 0x40082102
_CONTINUE = 1
_SET_PDEATHSIG, _SET_NO_NEW_PRIVS, _SET_CHILD_SUBREAPER, _CAPBSET_DROP, _SET_SECUREBITS = 1, 38, 36, 24, 28
_NO_ROOT_LOCKED = 0xEF
"""SECBIT_NOROOT, NO_SETUID_FIXUP, NO_CAP_AMBIENT_RAISE, KEEP_CAPS_LOCKED and the other locks."""

_FAILED = 125
"""The exit code where it did not come to a run."""
_MOST_SOCKETS = 400
_MOST_WAITING = 64
_ENDING_SECONDS = 4.0
_SIGNALS = frozenset(("kill", "tkill", "tgkill", "rt_sigqueueinfo", "rt_tgsigqueueinfo"))

_libc = ctypes.CDLL(None, use_errno=True)


def _call(number: int, *arguments: Any) -> int:
    given = [a if isinstance(a, (ctypes.c_char_p, ctypes.c_void_p)) else ctypes.c_long(a) for a in arguments]
    done = int(_libc.syscall(ctypes.c_long(number), *given))
    if done < 0:
        raise OSError(ctypes.get_errno(), os.strerror(ctypes.get_errno()))
    return done


def _control(option: int, *arguments: int) -> None:
    given = [ctypes.c_ulong(a) for a in (*arguments, 0, 0, 0, 0)[:4]]
    if _libc.prctl(option, *given) != 0:
        raise OSError(ctypes.get_errno(), os.strerror(ctypes.get_errno()))


def _confine(version: int, fs: int, net: int, scoped: int, rules: list[tuple[str, int]]) -> None:
    """Enter a Landlock domain. A path that is gone is left out; it cannot be opened then either."""
    attributes = struct.pack("=QQQ", fs, net, scoped)[: 8 if version < 4 else 16 if version < 6 else 24]
    ruleset = _call(_CREATE_RULESET, ctypes.c_char_p(attributes), len(attributes), 0)
    for path, rights in rules:
        try:
            place = os.open(path, os.O_PATH | os.O_CLOEXEC)
        except OSError:
            continue
        try:
            allowed = rights & fs
            if not stat.S_ISDIR(os.fstat(place).st_mode):
                allowed &= _FILE_RIGHTS
            if allowed:
                _call(_ADD_RULE, ruleset, 1, ctypes.c_char_p(struct.pack("=Qi", allowed, place)), 0)
        finally:
            os.close(place)
    _call(_RESTRICT_SELF, ruleset, 0)
    os.close(ruleset)


def _drop_capabilities() -> None:
    """Root's rights beyond those of the owner of root's files."""
    if os.geteuid() == 0:
        _control(_SET_SECUREBITS, _NO_ROOT_LOCKED)
        for capability in range(64):
            try:
                _control(_CAPBSET_DROP, capability)
            except OSError:
                break
    header, none = struct.pack("=Ii", 0x20080522, 0), bytes(24)
    if _libc.capset(ctypes.c_char_p(header), ctypes.c_char_p(none)) != 0:
        raise OSError(ctypes.get_errno(), "capset")


def _filter(program: bytes) -> int:
    """Apply the filter of system calls; the descriptor by which it asks."""
    code = ctypes.create_string_buffer(program, len(program))
    described = struct.pack("=HxxxxxxQ", len(program) // 8, ctypes.addressof(code))
    return _call(_SECCOMP[os.uname().machine], 1, 8, ctypes.c_char_p(described))


def _enter(order: dict[str, Any], send: socket.socket) -> None:
    """In the child: into the sandbox for good, and become the supervisor."""
    _control(_SET_PDEATHSIG, signal.SIGKILL)
    os.setsid()
    with contextlib.suppress(OSError), open("/proc/self/oom_score_adj", "w") as file:
        file.write("1000")  # the run may not later
    version = order["version"]
    fs = _FS_RIGHTS.get(version, 0xFFFF)
    rules = [(path, READ) for path in order["read"]]
    rules += [(path, LIST) for path in order["list"]]
    rules += [(path, READ | CHANGE) for path in order["write"]]
    rules += [(path, READ | MAKE_PIPE) for path in order["pipes"]]
    rules += [(path, 0x4 | CHANGE_FILES | _DEVICE_CONTROL) for path in order["devices"]]
    _confine(version, fs, _NET_RIGHTS if version >= 4 else 0, _SCOPE_ALL if version >= 6 else 0, rules)
    _drop_capabilities()
    listener = _filter(bytes.fromhex(order["filter"]))
    socket.send_fds(send, [b"x"], [listener])
    os.close(listener)
    os.execve(order["argv"][0], order["argv"], {})  # noqa: S606


class Keeper:
    """Answers what the filter asks, until the run is over."""

    def __init__(self, listener: int, asked: dict[int, str]) -> None:
        self._listener = listener
        self._asked = asked
        self._lock = threading.Lock()
        self._ports: dict[tuple[int, int], int] = {}
        """Family and port as the run knows it, to the port that it is."""
        self._kept: list[socket.socket] = []
        """So that no port becomes somebody else's while the run may connect to it."""
        self._waiting = 0

    def serve(self, ends: list[int]) -> None:
        """Until one of `ends` can be read or has no other side any more."""
        poll = select.poll()
        poll.register(self._listener, select.POLLIN)
        for end in ends:
            poll.register(end, select.POLLIN)
        while True:
            for ready, event in poll.poll():
                if ready != self._listener:
                    return
                if not event & select.POLLIN:
                    poll.unregister(ready)  # nobody is left who could ask
                    continue
                self._answer()

    def _answer(self) -> None:
        notice = bytearray(80)
        try:
            fcntl.ioctl(self._listener, _RECEIVE, notice)
        except OSError:
            return
        key, thread, _, number, _, _, *arguments = struct.unpack("=QIIiIQ6Q", notice)
        name = self._asked.get(number, "")
        if name in ("connect", "listen"):
            # Both can block: on a queue that is full, or a lock that somebody holds.
            with self._lock:
                refused = self._waiting >= _MOST_WAITING
                self._waiting += not refused
            if refused:
                self._reply(key, errno.EAGAIN)
                return
            threading.Thread(target=self._decide_apart, args=(key, thread, name, arguments), daemon=True).start()
        else:
            self._decide(key, thread, name, arguments)

    def _decide_apart(self, key: int, thread: int, name: str, arguments: list[int]) -> None:
        try:
            self._decide(key, thread, name, arguments)
        finally:
            with self._lock:
                self._waiting -= 1

    def _decide(self, key: int, thread: int, name: str, arguments: list[int]) -> None:
        error, flags = errno.EPERM, 0
        try:
            if name in ("connect", "bind", "listen"):
                self._network(key, thread, name, arguments)
                error = 0
            elif name and _may_reach(_signed(arguments[0])):
                error, flags = 0, _CONTINUE
            elif name in _SIGNALS:
                error = errno.ESRCH
        except OSError as failed:
            error = failed.errno or errno.EPERM
        except (ValueError, OverflowError):
            error = errno.EINVAL
        self._reply(key, error, flags)

    def _reply(self, key: int, error: int, flags: int = 0) -> None:
        # An error: the caller is gone, or was interrupted and asks again.
        with contextlib.suppress(OSError):
            fcntl.ioctl(self._listener, _SEND, struct.pack("=QqiI", key, 0, -error, flags))

    def _network(self, key: int, thread: int, name: str, arguments: list[int]) -> None:
        tasks = os.pidfd_open(_process_of(thread))
        try:
            descriptor = _call(_PIDFD_GETFD, tasks, arguments[0] & 0xFFFFFFFF, 0)
        finally:
            os.close(tasks)
        if not stat.S_ISSOCK(os.fstat(descriptor).st_mode):
            os.close(descriptor)
            raise OSError(errno.ENOTSOCK, "")
        address = b""
        with socket.socket(fileno=descriptor) as theirs:
            if name != "listen":
                address = _copied(thread, arguments[1], arguments[2] & 0xFFFFFFFF)
            # Only now is it sure that thread and memory were those of the asker.
            fcntl.ioctl(self._listener, _STILL_VALID, struct.pack("=Q", key))
            if name == "connect":
                self._connect(theirs, address)
            elif name == "bind":
                self._bind(theirs, address)
            else:
                self._listen(theirs, arguments[1])

    def _connect(self, theirs: socket.socket, address: bytes) -> None:
        family = theirs.family
        if family not in (socket.AF_INET, socket.AF_INET6):
            raise OSError(errno.ECONNREFUSED if family == socket.AF_UNIX else errno.EACCES, "")
        port, ours = _internet(family, address)
        if not ours:
            raise OSError(errno.ENETUNREACH, "")
        with self._lock:
            real = self._ports.get((family, port))
        if real is None:
            raise OSError(errno.ECONNREFUSED, "")
        theirs.connect((_loopback(family), real))

    def _bind(self, theirs: socket.socket, address: bytes) -> None:
        family = theirs.family
        if family == socket.AF_NETLINK:
            # With a number of the kernel's choice and no news: what the C library does to list interfaces.
            theirs.bind((0, 0))
            return
        if family not in (socket.AF_INET, socket.AF_INET6):
            raise OSError(errno.EACCES, "")
        port, ours = _internet(family, address)
        if not ours:
            raise OSError(errno.EADDRNOTAVAIL, "")
        self._bind_loopback(theirs, family, port)

    def _bind_loopback(self, theirs: socket.socket, family: int, port: int) -> None:
        with self._lock:
            if len(self._kept) >= _MOST_SOCKETS:
                raise OSError(errno.EADDRINUSE, "")
            theirs.bind((_loopback(family), 0))
            real = theirs.getsockname()[1]
            self._ports[family, real] = real
            if port:
                self._ports[family, port] = real
            self._kept.append(theirs.dup())

    def _listen(self, theirs: socket.socket, backlog: int) -> None:
        family = theirs.family
        if family in (socket.AF_INET, socket.AF_INET6) and theirs.getsockname()[1] == 0:
            self._bind_loopback(theirs, family, 0)  # the kernel would take all interfaces
        theirs.listen(max(0, min(_signed(backlog), 4096)))


def _signed(argument: int) -> int:
    """An `int` argument from its register."""
    value = argument & 0xFFFFFFFF
    return value - (1 << 32) if value >> 31 else value


def _copied(thread: int, at: int, length: int) -> bytes:
    if not 2 <= length <= 128:
        raise OSError(errno.EINVAL, "")
    with open(f"/proc/{thread}/mem", "rb", buffering=0) as memory:
        try:
            return os.pread(memory.fileno(), length, at)
        except OSError:
            raise OSError(errno.EFAULT, "") from None


def _internet(family: int, address: bytes) -> tuple[int, bool]:
    """The port of a `struct sockaddr_in` or `sockaddr_in6`, and whether the address is the loopback's or any."""
    given = struct.unpack_from("=H", address)[0] if len(address) >= 2 else 0
    if given != family or len(address) < (16 if family == socket.AF_INET else 24):
        raise OSError(errno.EAFNOSUPPORT, "")
    port = struct.unpack_from("!H", address, 2)[0]
    if family == socket.AF_INET:
        return port, address[4] == 127 or address[4:8] == bytes(4)
    return port, address[8:23] == bytes(15) and address[23] in (0, 1)


def _loopback(family: int) -> str:
    return "127.0.0.1" if family == socket.AF_INET else "::1"


def _process_of(thread: int) -> int:
    with open(f"/proc/{thread}/status") as file:
        for line in file:
            if line.startswith("Tgid:"):
                return int(line.split()[1])
    raise OSError(errno.ESRCH, "")


def _may_reach(target: int) -> bool:
    """Whether a process of the run may signal, limit or schedule this one: itself and what else is in the run."""
    # A group is named after the process that made it; -1 would be everybody.
    return target == 0 or (target != -1 and _descends(abs(target)))


def _descends(process: int) -> bool:
    """From us. What has lost its parent was adopted by us, so that no chain is broken."""
    own = os.getpid()
    for _ in range(600):
        try:
            with open(f"/proc/{process}/stat") as file:
                process = int(file.read().rpartition(")")[2].split()[1])
        except (OSError, ValueError, IndexError):
            return False
        if process == own:
            return True
        if process <= 1:
            return False
    return False


def _end_all(scoped: bool) -> None:
    """End everything that descends from us. `scoped`: our signals reach nothing else."""
    deadline = time.monotonic() + _ENDING_SECONDS
    while time.monotonic() < deadline:
        if scoped:
            with contextlib.suppress(OSError):
                os.kill(-1, signal.SIGKILL)
        else:
            for process in [int(name) for name in os.listdir("/proc") if name.isdigit()]:
                if _descends(process):
                    with contextlib.suppress(OSError):
                        os.kill(process, signal.SIGKILL)
        try:
            while os.waitpid(-1, os.WNOHANG)[0]:
                pass
        except ChildProcessError:
            return
        time.sleep(0.001)


def _removed(folder: str) -> None:
    """Remove what the run wrote. Nobody in it can change modes, but make a folder that has no rights to itself."""
    for path, folders, _ in os.walk(folder):
        for name in folders:
            inner = os.path.join(path, name)
            if not os.path.islink(inner):
                os.chmod(inner, 0o700)
    shutil.rmtree(folder, ignore_errors=True)


def main() -> None:
    """Run the order in the descriptor that the first argument names."""
    with os.fdopen(int(sys.argv[1])) as file:
        order = json.load(file)
    leash = order["leash"]
    os.set_inheritable(leash, False)
    scoped = False
    failed = True
    try:
        _control(_SET_CHILD_SUBREAPER, 1)
        _control(_SET_NO_NEW_PRIVS, 1)
        if order["version"] >= 6:
            _confine(order["version"], 0, 0, _SCOPE_SIGNAL, [])
            scoped = True
        failed = not _run(order, leash)
    finally:
        _end_all(scoped)
        _removed(order["folder"])
    os._exit(_FAILED if failed else 0)


def _run(order: dict[str, Any], leash: int) -> bool:
    """Whether it came to a run at all."""
    ours, theirs = socket.socketpair()
    child = os.fork()
    if child == 0:
        try:
            ours.close()
            _enter(order, theirs)
        except OSError as error:
            os.write(2, f"landlock: {error}\n".encode())
        finally:
            os._exit(_FAILED)
    theirs.close()
    ended = os.pidfd_open(child)
    _, listeners, _, _ = socket.recv_fds(ours, 1, 1)
    if not listeners:
        os.waitpid(child, 0)
        return False
    Keeper(listeners[0], {int(number): name for number, name in order["asked"].items()}).serve([leash, ended])
    status = os.waitpid(child, os.WNOHANG)[1] if _readable(ended) else 0
    return os.waitstatus_to_exitcode(status) != _FAILED


def _readable(descriptor: int) -> bool:
    return bool(select.select([descriptor], [], [], 0)[0])


if __name__ == "__main__":
    main()
