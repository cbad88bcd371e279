"""Traces on disk: what a run gave, with everything it depended on, valid for as long as none of that has changed.

A file per trace, JSON, in a folder per recipe; written to a temporary name and renamed, so that any number of processes
can share the folder. Whatever cannot be read, is cut off or was written by another version is a miss.
"""

from __future__ import annotations

import contextlib
import dataclasses
import functools
import hashlib
import json
import os
import stat
import tempfile
import threading
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import platformdirs

from preflight_analysis.evaluation import names
from preflight_analysis.tracing.agents.params import ParamTree
from preflight_analysis.tracing.interface import Endpoint, Interface, Outcome, ParamUse
from preflight_analysis.tracing.observation import Dependencies, ParamDependency
from preflight_analysis.tracing.recipe import Recipe
from preflight_analysis.tracing.request import TraceRequest
from preflight_analysis.tracing.run import encode_params

SCHEMA = "ros-preflight/trace-cache/1"
MAX_BYTES = 64 << 20
MAX_ENTRY_BYTES = 4 << 20
VARIANTS = 32
"""How many traces one recipe may have: nodes of one executable with different parameters or names."""

_HASHED_BYTES = 8 << 20
"""Larger files count by size and time."""
_SYSTEM = ("/usr/", "/lib/", "/lib64/", "/opt/", "/etc/", "/bin/", "/sbin/")
_SWEEP_EVERY = 32


class TraceCache:
    """Cached interfaces below `folder`; together they stay below about `max_bytes`, least recently used first out."""

    def __init__(self, folder: Path | None = None, max_bytes: int = MAX_BYTES) -> None:
        self.folder = folder or Path(platformdirs.user_cache_dir("ros-preflight")) / "traces"
        self.max_bytes = max_bytes
        self._stores = 0
        self._lock = threading.Lock()

    def load(self, recipe: Recipe, request: TraceRequest) -> Interface | None:
        """The interface, if a run of this recipe is known and nothing it depended on has changed."""
        try:
            entries = sorted(self._place(recipe, request).glob("*.json"))
        except OSError:
            return None
        view: _View | None = None
        for path in entries:
            entry = _read(path)
            if entry is None:
                continue
            view = view or _View(request, recipe.python)
            try:
                if not _valid(entry["dependencies"], view):
                    continue
                interface = _decode(entry["interface"])
            except (KeyError, TypeError, ValueError, AttributeError):
                continue
            with contextlib.suppress(OSError):
                os.utime(path)
            return dataclasses.replace(interface, cached=True)
        return None

    def store(
        self,
        recipe: Recipe,
        request: TraceRequest,
        interface: Interface,
        dependencies: Dependencies,
        *,
        listings: Iterable[str] = (),
        started: float,
    ) -> bool:
        """Keep a trace of a run that began at `started` (seconds since the epoch). `listings` are folders whose
        modules it depended on. False if it was not kept: a file has changed since, or the disk refused."""
        view = _View(request, recipe.python)
        files = {}
        for path in dict.fromkeys((request.executable, *dependencies.files)):
            files[path] = fingerprint(path)
            if _changed_since(path, started):
                return False
        known: dict[str, Any] = {
            "files": files,
            "listings": {folder: listing(folder) for folder in listings},
            "params": [[d.access, d.name, d.given, view.look(d)] for d in dependencies.params],
            "asked": {what: view.identity(what) for what in sorted(dependencies.asked)},
        }
        entry = {"schema": SCHEMA, "dependencies": known, "interface": _encode(interface)}
        try:
            data = json.dumps(entry, sort_keys=True).encode()
        except (TypeError, ValueError):
            return False
        # The check sum tells a truncated or overwritten file; the content is nobody's secret.
        data = hashlib.sha256(data).hexdigest().encode() + b"\n" + data
        if len(data) > MAX_ENTRY_BYTES:
            return False
        place = self._place(recipe, request)
        conditions = hashlib.sha256(json.dumps([known["params"], known["asked"]], sort_keys=True).encode()).hexdigest()
        try:
            place.mkdir(parents=True, exist_ok=True, mode=0o700)
            _write(place / f"{conditions[:32]}.json", data)
            self._trim(place)
            self._sweep()
        except OSError:
            return False
        return True

    def _place(self, recipe: Recipe, request: TraceRequest) -> Path:
        named = {
            "agents": _agents_digest(),
            "executable": os.path.realpath(request.executable),
            "given": request.executable,
            "package": request.package,
            "python": recipe.python,
            "interpreter": list(recipe.argv[: recipe.argv.index(request.executable)]),
            "args": list(request.args),
            "env": dict(recipe.stable),
            "cwd": recipe.cwd,
        }
        digest = hashlib.sha256(json.dumps(named, sort_keys=True).encode(errors="surrogatepass")).hexdigest()
        return self.folder / digest[:2] / digest

    def _trim(self, place: Path) -> None:
        entries = sorted(place.glob("*.json"), key=_used)
        for path in entries[: max(0, len(entries) - VARIANTS)]:
            path.unlink(missing_ok=True)

    def _sweep(self) -> None:
        with self._lock:
            self._stores += 1
            if self._stores % _SWEEP_EVERY != 1:
                return
        self.sweep()

    def sweep(self) -> None:
        """Remove the least recently used traces until the rest fits, and what interrupted writes left behind."""
        entries: list[tuple[float, int, Path]] = []
        for path in self.folder.glob("*/*/*"):
            with contextlib.suppress(OSError):
                info = path.stat()
                entries.append((info.st_mtime, info.st_size, path))
        total = sum(size for _, size, _ in entries)
        for _, size, path in sorted(entries):
            if total <= self.max_bytes:
                break
            with contextlib.suppress(OSError):
                path.unlink()
                total -= size
                path.parent.rmdir()


class _View:
    """What a run with this request would find: parameters, names."""

    def __init__(self, request: TraceRequest, python: bool) -> None:
        self._node = request.node
        self._remaps = names.resolve_remaps(request.remaps, request.node) if python else {}
        self._tree = ParamTree()
        for name, value in encode_params(request.params):
            self._tree.set(name, value)

    def look(self, dependency: ParamDependency) -> str:
        """A digest of the parameter server's answer; "" for nothing there."""
        answer: Any
        if dependency.access == "list":
            answer = sorted(self._tree.names())
        elif dependency.access == "search":
            answer = self._tree.search(self._node, dependency.name)
        else:
            name = dependency.name
            full = names.resolve(name, self._node, self._remaps) if dependency.given else name
            if not self._tree.has(full):
                return ""
            answer = True if dependency.access == "has" else self._tree.get(full)
        return hashlib.sha256(json.dumps(answer, sort_keys=True).encode(errors="surrogatepass")).hexdigest()

    def identity(self, what: str) -> Any:
        """The node's name, its namespace or its remaps."""
        if what == "remaps":
            return sorted([source, target] for source, target in self._remaps.items())
        return self._node if what == "name" else names.parent(self._node)


def _valid(known: Mapping[str, Any], view: _View) -> bool:
    return (
        all(view.identity(what) == value for what, value in known["asked"].items())
        and all(view.look(ParamDependency(a, n, bool(g))) == digest for a, n, g, digest in known["params"])
        and all(fingerprint(path) == value for path, value in known["files"].items())
        and all(listing(folder) == value for folder, value in known["listings"].items())
    )


def fingerprint(path: str) -> str:
    """What tells that a file is the same: its content's digest, for the system's files time and size; "" if absent.

    Only regular files are opened: the name may come from a node.
    """
    try:
        info = os.stat(path)
    except (OSError, ValueError):
        return ""
    if not stat.S_ISREG(info.st_mode):
        return "no file"
    if path.startswith(_SYSTEM) or info.st_size > _HASHED_BYTES:
        return f"{info.st_mtime_ns}:{info.st_size}"
    return _digest(path, info.st_mtime_ns, info.st_size, info.st_ino)


@functools.lru_cache(maxsize=4096)
def _digest(path: str, mtime: int, size: int, inode: int) -> str:
    try:
        with os.fdopen(os.open(path, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC), "rb") as file:
            return hashlib.sha256(file.read(_HASHED_BYTES)).hexdigest()
    except OSError:
        return "unreadable"


def listing(folder: str) -> str:
    """A digest of the names in a folder that an `import` could find."""
    try:
        found = sorted(n for n in os.listdir(folder) if n.endswith((".py", ".so", ".pth", ".zip")) or n.isidentifier())
    except OSError:
        return ""
    return hashlib.sha256("\0".join(found).encode(errors="surrogatepass")).hexdigest()


def _changed_since(path: str, moment: float) -> bool:
    try:
        return os.stat(path).st_mtime >= moment
    except (OSError, ValueError):
        return False


@functools.lru_cache(maxsize=1)
def _agents_digest() -> str:
    """Of our own code that makes a trace: another version of it sees other things."""
    digest = hashlib.sha256(SCHEMA.encode())
    for path in sorted(Path(__file__).parent.glob("**/*.py")):
        digest.update(path.read_bytes())
    return digest.hexdigest()


def _used(path: Path) -> float:
    try:
        return path.stat().st_mtime
    except OSError:
        return 0.0


def _read(path: Path) -> dict[str, Any] | None:
    try:
        if path.stat().st_size > MAX_ENTRY_BYTES:
            return None
        checksum, _, data = path.read_bytes().partition(b"\n")
        if hashlib.sha256(data).hexdigest().encode() != checksum:
            return None
        entry = json.loads(data)
    except (OSError, ValueError, RecursionError):
        return None
    return entry if isinstance(entry, dict) and entry.get("schema") == SCHEMA else None


def _write(path: Path, data: bytes) -> None:
    descriptor, temporary = tempfile.mkstemp(dir=path.parent, prefix=".", suffix=".tmp")
    try:
        with os.fdopen(descriptor, "wb") as file:
            file.write(data)
        os.replace(temporary, path)
    except OSError:
        with contextlib.suppress(OSError):
            os.unlink(temporary)
        raise


def _encode(interface: Interface) -> dict[str, Any]:
    return dataclasses.asdict(interface)


def _decode(data: Mapping[str, Any]) -> Interface:
    outcome = dict(data["outcome"])
    outcome["stderr_tail"] = tuple(outcome["stderr_tail"])
    return Interface(
        data["source"],
        Outcome(**outcome),
        tuple(Endpoint(**endpoint) for endpoint in data["endpoints"]),
        tuple(ParamUse(**use) for use in data["params"]),
        notes=tuple(data["notes"]),
    )
