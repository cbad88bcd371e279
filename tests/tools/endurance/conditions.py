"""The server and the command where something is not as usual: killed, many at once, no disk, no HOME, odd paths.

Each condition is met by a workspace with a demo whose nodes are run, a file that is not ASCII, and an include. What the
server publishes and `check` prints must be what they say of the same workspace where all is as usual, with the folder's
name taken out, and nothing may be logged as an error. Where no run is possible, because it has no place to write to,
that is what must be said.
"""

from __future__ import annotations

import json
import os
import random
import shutil
import subprocess
import tempfile
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from urllib.parse import unquote

from tools.endurance.lsp_process import COMMAND, Failure, LspProcess, descendants
from tools.endurance.materials import REPOSITORY

DEMO = REPOSITORY / "fixtures" / "ros1" / "demo"
ACCENTS = """<launch>
  <!-- größe, размер, 尺寸 𝄞 -->
  <arg name="größe" default="é"/>
  <include file="$(find preflight_demo)/launch/talker_listener.launch"/>
  <param name="x" value="$(arg größe)"/>
  <param name="y" textfile="$(find preflight_demo)/尺寸.txt"/>
</launch>
"""
KILLS = 12
SECONDS = 180.0
STILL_SECONDS = 1.0
"""Longer than the server waits after an edit before it runs anything."""
PATHS = (
    "with two  spaces",
    "line\nbreak",
    "größe",
    "размер",
    "尺寸",
    "مسار",
    "😀",
    "100% #1?",
    "a&b<c>'d\"",
    "x" * 200,
    os.fsdecode(b"gr\xf6\xdfe"),
)
C_LOCALE = {"LC_ALL": "C"}
Findings = dict[str, list[str]]


@dataclass(frozen=True)
class Row:
    """Of the table. `failure` is what did not hold."""

    title: str
    asserted: str
    measured: str
    failure: str | None = None


@dataclass
class Setting:
    """Where a workspace lies and what the server and the command are started with."""

    folder: Path
    home: Path
    variables: dict[str, str] = field(default_factory=dict)
    without: tuple[str, ...] = ()
    within: tuple[str, ...] = ()
    """What starts the commands."""
    trusted: bool = True

    def __post_init__(self) -> None:
        package = self.folder / "src" / "preflight_demo"
        if not package.exists():
            shutil.copytree(DEMO, package)
            (package / "launch" / "größe.launch").write_text(ACCENTS, encoding="utf-8")
            (package / "尺寸.txt").write_text("尺寸", encoding="utf-8")
        self.home.mkdir(parents=True, exist_ok=True)

    @property
    def launch_files(self) -> list[Path]:
        launch = self.folder / "src" / "preflight_demo" / "launch"
        return [launch / "talker_listener.launch", launch / "größe.launch"]

    @property
    def environment(self) -> dict[str, str]:
        usual = {
            "PATH": "/usr/bin:/bin",
            "HOME": str(self.home),
            "LANG": "C.UTF-8",
            "ROS_VERSION": "1",
            "ROS_DISTRO": "noetic",
            **self.variables,
        }
        return {name: value for name, value in usual.items() if name not in self.without}

    def server(self, log: Path) -> LspProcess:
        return LspProcess(
            [self.folder],
            log,
            self.environment,
            trusted=self.trusted,
            command=[*self.within, *COMMAND],
            cwd=self.folder,
        )

    def published(self) -> Findings:
        """What the server says, also after an edit and back, and that it ends as it should. Raises `Failure`."""
        with tempfile.TemporaryDirectory() as scratch:
            server = self.server(Path(scratch, "log"))
            try:
                found = self._published(server)
                if faults := server.faults():
                    raise Failure(faults[0])
                if (code := server.close()) != 0:
                    raise Failure(f"the server ended with {code}")
            finally:
                server.kill()
        return found

    def _published(self, server: LspProcess) -> Findings:
        for path in self.launch_files:
            _open(server, path)
        uri = self.launch_files[0].as_uri()
        start = {"line": 0, "character": 0}
        for version, end, text in ((2, start, "\n"), (3, {"line": 1, "character": 0}, "")):
            change = {"range": {"start": start, "end": end}, "text": text}
            document = {"uri": uri, "version": version}
            server.notify("textDocument/didChange", {"textDocument": document, "contentChanges": [change]})
        at_node = {"textDocument": {"uri": uri}, "position": {"line": 2, "character": 10}}
        if not server.request("textDocument/hover", at_node).get("result"):
            raise Failure("a hover has nothing to say")
        server.rest(1, STILL_SECONDS, SECONDS)
        return self._plain(server)

    def _plain(self, server: LspProcess) -> Findings:
        prefix = self.folder.as_uri()
        found: Findings = {}
        for uri, params in server.published.items():
            if params["diagnostics"]:
                said = [
                    json.dumps([each["range"], each.get("code"), each["message"]], ensure_ascii=False)
                    for each in params["diagnostics"]
                ]
                found[unquote(uri.removeprefix(prefix))] = sorted(self._without_folder(each) for each in said)
        return found

    def _without_folder(self, text: str) -> str:
        written = json.dumps(str(self.folder), ensure_ascii=False)[1:-1]
        return text.replace(written, "<folder>")

    def check(self) -> subprocess.Popen[bytes]:
        command = [*self.within, COMMAND[0], "check", "--format", "json"]
        files = [os.fspath(path) for path in self.launch_files[:1]]
        more = [] if self.trusted else ["--no-run"]
        return subprocess.Popen(
            [*command, *more, *files],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            env=self.environment,
            cwd=self.folder,
        )

    def checked(self, process: subprocess.Popen[bytes] | None = None) -> list[str]:
        """The findings of the command. Raises `Failure` if it broke."""
        process = process or self.check()
        output, errors = process.communicate(timeout=SECONDS)
        if process.returncode not in (0, 1) or b"Traceback" in errors:
            raise Failure(f"check ended with {process.returncode}: {errors.decode(errors='replace')[-2000:]}")
        findings = json.loads(output)["findings"]
        return sorted(
            self._without_folder(json.dumps([each["rule"], each["message"]], ensure_ascii=False)) for each in findings
        )


def _open(server: LspProcess, path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    item = {"uri": path.as_uri(), "languageId": "roslaunch", "version": 1, "text": text}
    server.notify("textDocument/didOpen", {"textDocument": item})


@dataclass(frozen=True)
class Usual:
    """What is said of the workspace where all is as usual, with runs and without."""

    published: Findings
    checked: list[str]
    published_untrusted: Findings
    checked_untrusted: list[str]

    def compare(self, setting: Setting) -> str:
        """How much is equal; raises `Failure` where it is not."""
        published = self.published if setting.trusted else self.published_untrusted
        checked = self.checked if setting.trusted else self.checked_untrusted
        _same("the server", setting.published(), published)
        _same("check", setting.checked(), checked)
        return f"{sum(map(len, published.values()))} diagnostics, {len(checked)} findings of `check`"


def _same(who: str, found: object, usual: object) -> None:
    if found != usual:
        raise Failure(f"{who} says {json.dumps(found, ensure_ascii=False)}, usually {json.dumps(usual)}"[:3000])


def conditions(seed: int = 0, kills: int = KILLS) -> list[Row]:
    """All of them, each in folders of its own."""
    with tempfile.TemporaryDirectory(prefix="preflight-conditions-") as scratch:
        top = Path(scratch)
        usual = _usual(top / "usual")
        table: Sequence[tuple[str, str, Callable[[Path], str]]] = (
            (
                "server killed (SIGKILL) at random moments of the first runs",
                "no process of the sandbox outlives it for more than 10 s; the cache is read, findings as usual",
                lambda folder: _killed(folder, usual, random.Random(seed), kills),
            ),
            (
                "two servers and three `check` at once on one empty cache",
                "findings of all five as usual, and of a sixth afterwards",
                lambda folder: _at_once(folder, usual),
            ),
            (
                "cache on a read-only disk",
                "findings as usual, no exception",
                lambda folder: _on_a_disk(folder, usual, "ro"),
            ),
            (
                "cache and temporary folder on a full disk",
                "findings as usual, or the static ones where nodes cannot be run, which is said then; no exception",
                lambda folder: _full(folder, usual),
            ),
            (
                "no HOME",
                "findings as usual, no exception",
                lambda folder: usual.compare(Setting(folder / "ws", folder / "home", without=("HOME",))),
            ),
            (
                "HOME that is not there",
                "findings as usual, no exception",
                lambda folder: usual.compare(Setting(folder / "ws", folder / "home", {"HOME": "/proc/nowhere"})),
            ),
            (
                "LC_ALL=C",
                "findings as usual, no exception",
                lambda folder: usual.compare(Setting(folder / "ws", folder / "home", C_LOCALE, without=("LANG",))),
            ),
            (
                "LC_ALL=C, and Python without its UTF-8 mode",
                "no exception; as usual where names are ASCII, others are not found",
                lambda folder: _ascii(folder, usual),
            ),
            (
                f"workspaces at {len(PATHS)} paths with spaces, line breaks, other scripts, marks of URIs and of XML",
                "findings as usual, no exception",
                lambda folder: _odd_paths(folder, usual),
            ),
        )
        rows = []
        for number, (title, asserted, condition) in enumerate(table):
            began = time.monotonic()
            try:
                row = Row(title, asserted, condition(top / str(number)))
            except (Failure, subprocess.TimeoutExpired, OSError) as error:
                row = Row(title, asserted, "", f"FAILED: {error}")
            rows.append(row)
            print(f"{time.monotonic() - began:5.0f} s  {title}: {row.failure or row.measured}", flush=True)
    return rows


def _usual(folder: Path) -> Usual:
    trusted = Setting(folder / "ws", folder / "home")
    static = Setting(folder / "ws", folder / "untrusted", trusted=False)
    usual = Usual(trusted.published(), trusted.checked(), static.published(), static.checked())
    codes = json.dumps(usual.published) + json.dumps(usual.checked)
    if "TOP001" not in codes:
        raise Failure(f"the demo's nodes cannot be run here: {codes}")
    return usual


def _killed(folder: Path, usual: Usual, chance: random.Random, kills: int) -> str:
    setting = Setting(folder / "ws", folder / "home")
    started = 0
    for number in range(kills):
        server = setting.server(folder / f"{number}.log")
        for path in setting.launch_files:
            _open(server, path)
        time.sleep(chance.uniform(0.0, 2.5))  # the moment is what is random here, nothing is waited for
        family = descendants(server.pid)
        started += bool(family)
        server.kill()
        if faults := server.faults():
            raise Failure(faults[0])
        _gone([pid for pid, _ in family])
    return f"{kills} kills, {started} with runs under way; {usual.compare(setting)}"


def _gone(pids: Sequence[int]) -> None:
    deadline = time.monotonic() + 10
    while left := [pid for pid in pids if _alive(pid)]:
        if time.monotonic() > deadline:
            raise Failure(f"processes outlive the server: {[_command(pid) for pid in left]}")
        time.sleep(0.05)  # between two looks


def _alive(pid: int) -> bool:
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


def _command(pid: int) -> str:
    return Path(f"/proc/{pid}/cmdline").read_bytes().replace(b"\0", b" ").decode(errors="replace")[:300]


def _at_once(folder: Path, usual: Usual) -> str:
    setting = Setting(folder / "ws", folder / "home")
    servers = [setting.server(folder / f"{number}.log") for number in range(2)]
    checks = [setting.check() for _ in range(3)]
    try:
        for server in servers:
            for path in setting.launch_files:
                _open(server, path)
        for process in checks:
            _same("check", setting.checked(process), usual.checked)
        for server in servers:
            server.rest(1, STILL_SECONDS, SECONDS)
            _same("a server", setting._plain(server), usual.published)
            if faults := server.faults():
                raise Failure(faults[0])
            server.close()
    finally:
        for server in servers:
            server.kill()
        for process in checks:
            process.kill()
            process.wait()
    return f"5 at once; afterwards {usual.compare(setting)}"


def _mounted(disk: Path, option: str, before: str = "true") -> tuple[str, ...]:
    """What starts a command with a small file system at `disk`, which nobody else sees."""
    disk.mkdir(parents=True)
    unshare = ["unshare", "--mount"] if os.geteuid() == 0 else ["unshare", "--user", "--map-root-user", "--mount"]
    script = (
        f'mount -t tmpfs -o size=64k,mode=700 tmpfs "$0" && {before} && mount -o remount,{option} "$0" && exec "$@"'
    )
    return (*unshare, "sh", "-c", script, str(disk))


def _on_a_disk(folder: Path, usual: Usual, option: str) -> str:
    within = _mounted(folder / "disk", option)
    variables = {"ROS_PREFLIGHT_CACHE_DIR": str(folder / "disk" / "cache")}
    return usual.compare(Setting(folder / "ws", folder / "home", variables, within=within))


def _full(folder: Path, usual: Usual) -> str:
    disk = folder / "disk"
    fill = 'mkdir "$0/tmp" && { head -c 1M /dev/zero > "$0/fill" 2>/dev/null; true; }'
    within = _mounted(disk, "rw", fill)
    variables = {"ROS_PREFLIGHT_CACHE_DIR": str(disk / "cache"), "TMPDIR": str(disk / "tmp")}
    said = usual.compare(Setting(folder / "ws", folder / "home", variables, within=within, trusted=False))
    setting = Setting(folder / "ws2", folder / "home", variables, within=within)
    published, checked = setting.published(), setting.checked()
    runs = "the nodes were run all the same"
    if checked != usual.checked:
        _same("the server, of what is static", _static(published, usual), usual.published_untrusted)
        runs = "not run: " + next((each for each in checked if "TRC" in each), "nothing is said")
    return f"{said}; trusted: {runs}"


def _static(published: Findings, usual: Usual) -> Findings:
    """Without what is said of runs."""
    kept = {uri: [each for each in found if '"TRC' not in each] for uri, found in published.items()}
    return {uri: found for uri, found in kept.items() if found}


def _ascii(folder: Path, usual: Usual) -> str:
    variables = {**C_LOCALE, "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"}
    setting = Setting(folder / "ws", folder / "home", variables, without=("LANG",))
    _same("check", setting.checked(), usual.checked)
    others = [each for found in setting.published().values() for each in found if not _is_known(each, usual)]
    if len(others) != 1 or "尺寸.txt" not in others[0]:
        raise Failure(f"unexpected: {others}")
    return f"{len(usual.checked)} findings of `check`; the server says of one file that it is not there"


def _is_known(said: str, usual: Usual) -> bool:
    """But for the confidence, which a file that is not found lessens."""
    known = [each.rpartition(" (")[0] for found in usual.published.values() for each in found]
    return said.rpartition(" (")[0] in known


def _odd_paths(folder: Path, usual: Usual) -> str:
    said = ""
    for name in PATHS:
        try:
            said = usual.compare(Setting(folder / name / "ws", folder / "home"))
        except Failure as error:
            raise Failure(f"{name!r}: {error}") from None
    return f"{said} at each"
