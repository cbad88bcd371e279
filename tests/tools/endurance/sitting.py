"""Edits of many workspaces in one server, compared again and again with a server that has just read the same."""

from __future__ import annotations

import json
import os
import random
import shutil
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from tools.endurance import materials
from tools.endurance.lsp_process import Failure, LspProcess, descendants
from tools.endurance.scripted_editor import AT_PLACE, OF_FILE, ScriptedEditor, Step, question, readable
from tools.endurance.typist import Typist

EQUAL_SECONDS = 90.0
"""For both servers to come to the same; then neither may say anything more."""
STILL_SECONDS = 0.7
"""Longer than the server waits after the last keystroke before it looks at the roots that are not shown."""
QUESTIONS = 16
"""That both servers are asked at each comparison."""
MAX_NAMES = 4
"""Of a format in one workspace, edited in one sitting."""
GUESTS_EVERY = 10
"""In one of so many sittings two more workspaces are opened, and closed again."""
_ROS1, _ROS2 = ("ros1",), ("xml", "yaml", "python")
_LARGE, _SMALL = 8, 1
"""How many packages of a format are drawn; what they find comes with them."""


@dataclass
class Figures:
    """What was done, and what the server used while nothing was open."""

    edits: int = 0
    requests: int = 0
    cancelled: int = 0
    changes_on_disk: int = 0
    comparisons: int = 0
    questions: int = 0
    guests: int = 0
    """How often two more workspaces were opened and closed."""
    launch_files: int = 0
    """Of the workspaces that are always there."""
    files: dict[str, int] = field(default_factory=dict)
    """How many were edited, by format."""
    idle: float = 0.0
    """MB before a workspace was opened."""
    megabytes: dict[int, float] = field(default_factory=dict)
    """By the number of edits; 0: indexed."""
    descriptors: list[int] = field(default_factory=list)
    threads: list[int] = field(default_factory=list)
    runs: int = 0
    """How often something began to be run in the sandbox."""
    seconds: float = 0.0


@dataclass(frozen=True)
class Room:
    """A workspace of ROS 1 and one of ROS 2, made from a seed in a folder of its own."""

    folders: tuple[Path, Path]
    samples: tuple[materials.Sample, materials.Sample]


def folders_of(root: Path, seed: int) -> tuple[Path, Path]:
    return (root / f"{seed}/ros1", root / f"{seed}/ros2")


def make_room(packages: Sequence[materials.Package], root: Path, seed: int, times: int) -> Room:
    """The same from the same seed and packages. So many packages are drawn of each format."""
    chance = random.Random(seed)
    one, two = folders_of(root, seed)
    return Room(
        (one, two),
        (
            materials.sample(packages, one, chance, _ROS1 * 2 * times, 6 * times),
            materials.sample(packages, two, chance, _ROS2 * times, 6 * times),
        ),
    )


def environments(root: Path, seeds: Sequence[int]) -> dict[Path, Mapping[str, str]]:
    return {
        folder: materials.variables(folder, generation, root / "home")
        for seed in seeds
        for generation, folder in enumerate(folders_of(root, seed), 1)
    }


class Runner:
    """One long-lived server below `scratch`, and the editor in front of it."""

    def __init__(
        self,
        packages: Sequence[materials.Package],
        scratch: Path,
        seeds: Sequence[int],
        *,
        trusted: bool = False,
        equal_seconds: float = EQUAL_SECONDS,
    ) -> None:
        self.scratch = scratch
        self.root = scratch / "root"
        self.trusted = trusted
        self.equal_seconds = equal_seconds
        self.figures = Figures()
        self.steps: list[Step] = []
        """Of the present sitting."""
        (self.root / "home").mkdir(parents=True)
        self._packages = packages
        self._seeds = seeds
        self._rooms = {seeds[0]: make_room(packages, self.root, seeds[0], _LARGE)}
        self._base = self._rooms[seeds[0]]
        self.figures.launch_files = sum(len(p) for s in self._base.samples for p in s.launch_files.values())
        self.server = self._start("server", [])
        self.figures.idle = self.server.megabytes()
        self._open_folders(self._base)
        self._rest()
        self.figures.megabytes[0] = self.server.megabytes()
        self.editor = ScriptedEditor(self.root, self.server)

    def _start(self, name: str, folders: Sequence[Path]) -> LspProcess:
        home = self.root / "home"
        variables = {"PATH": "/usr/bin:/bin", "HOME": str(home), "LANG": "C.UTF-8"}
        known = environments(self.root, self._seeds)
        return LspProcess(
            folders, self.scratch / f"{name}.log", variables, environments=known, trusted=self.trusted, cwd=home
        )

    def _open_folders(self, room: Room, *, close: bool = False) -> None:
        folders = [{"uri": folder.as_uri(), "name": folder.name} for folder in room.folders]
        event = {"added": [] if close else folders, "removed": folders if close else []}
        self.server.notify("workspace/didChangeWorkspaceFolders", {"event": event})

    def _rest(self) -> None:
        self.server.rest(2 * len(self._rooms), STILL_SECONDS, EQUAL_SECONDS)

    # One sitting

    def sit(self, seed: int, edits: int, compare_every: int) -> None:
        """Edit files of the workspaces, now and then of two more, compare, and close all of it."""
        chance = random.Random(seed)
        typist = self._begin(seed, chance)
        before = self.editor.edits
        while (left := before + edits - self.editor.edits) > 0:
            for step in typist.steps(min(compare_every, left)):
                self._do(step)
            if self.trusted:
                # While a text cannot be run, its last good run stands in, which a fresh server does not know.
                for step in typist.restored(".py"):
                    self._do(step)
            self.compare(chance)
        for step in typist.restored():
            self._do(step)
        self._end(seed)

    def replay(self, seed: int, steps: Sequence[Step]) -> None:
        """The same from steps that were written down, compared at the end."""
        self._begin(seed, random.Random(seed))
        for step in steps:
            self._do(step)
        self.compare(random.Random(seed))

    def _begin(self, seed: int, chance: random.Random) -> Typist:
        self.steps = []
        if seed % GUESTS_EVERY == 0 and seed not in self._rooms:
            self._rooms[seed] = make_room(self._packages, self.root, seed, _SMALL)
            self._open_folders(self._rooms[seed])
        names, pool = self._names(chance)
        return Typist(self.editor, chance, names, pool, pauses=self.trusted)

    def _do(self, step: Step) -> None:
        self.steps.append(step)
        self.editor.do(step)

    def _end(self, seed: int) -> None:
        """Leave the server with the first workspaces alone, nothing open, and measure what it uses."""
        self.editor.do(["wait"])
        guest = self._rooms.pop(seed) if seed != self._seeds[0] and seed in self._rooms else None
        if guest is not None:
            self._open_folders(guest, close=True)
        self._rest()
        self.check_faults()
        if left := self.server.children():
            raise Failure(f"processes are left behind: {left}")
        if state := self.server.state():
            raise Failure(f"nothing is open, and diagnostics are left: {state}")
        self._take_over()
        self.figures.runs = self.server.runs
        self.figures.megabytes[self.figures.edits] = self.server.megabytes()
        self.figures.descriptors.append(self.server.descriptors())
        self.figures.threads.append(self.server.threads())
        if guest is not None:
            self.figures.guests += 1
            shutil.rmtree(self.root / str(seed))

    def _take_over(self) -> None:
        for what in ("edits", "requests", "cancelled", "changes_on_disk"):
            setattr(self.figures, what, getattr(self.editor, what))

    def _names(self, chance: random.Random) -> tuple[list[str], list[str]]:
        """Files to be edited, of all formats, and texts to take pieces from."""
        names = []
        for room in self._rooms.values():
            for made in room.samples:
                for form, paths in {**made.launch_files, "parameters": made.parameters}.items():
                    chosen = chance.sample(list(paths), min(len(paths), MAX_NAMES))
                    self.figures.files[form] = self.figures.files.get(form, 0) + len(chosen)
                    # Of what is run, more.
                    often = 4 if self.trusted and form == "python" else 1
                    names += [str(path.relative_to(self.root)) for path in chosen] * often
        return names, [readable(self.root / name) or "" for name in names]

    # The comparison

    def compare(self, chance: random.Random) -> None:
        """Raises `Failure` if a server that has just read the same has other findings or other answers."""
        self.editor.do(["wait"])
        self.check_faults()
        folders = [folder for room in self._rooms.values() for folder in room.folders]
        fresh = self._start("fresh", folders)
        try:
            self.editor.reopen_in(fresh)
            fresh.rest(len(folders), STILL_SECONDS, EQUAL_SECONDS)
            self._until_equal(fresh)
            for _ in range(QUESTIONS if self.editor.texts else 0):
                self._ask_both(fresh, chance)
            if faults := fresh.faults():
                raise Failure(f"the fresh server: {faults[0]}")
            if (code := fresh.close()) != 0:
                raise Failure(f"the fresh server ended with {code}")
        finally:
            fresh.kill()
        self.figures.comparisons += 1
        self.check_faults()

    def _until_equal(self, fresh: LspProcess) -> None:
        deadline = time.monotonic() + self.equal_seconds
        while True:
            both = self.server.still(STILL_SECONDS) and fresh.still(STILL_SECONDS)
            if both and self.server.state() == fresh.state():
                return
            if time.monotonic() > deadline:
                break
        raise Failure(f"other diagnostics than those of a fresh server: {_difference(self.server, fresh)}")

    def _ask_both(self, fresh: LspProcess, chance: random.Random) -> None:
        name = chance.choice(list(self.editor.texts))
        text = self.editor.texts[name]
        method = chance.choice((*AT_PLACE, *OF_FILE))
        asked = question(method, self.editor.uri(name), text, chance.randrange(len(text) + 1))
        answers = [each.request(f"textDocument/{method}", asked) for each in (self.server, fresh)]
        mine, other = (json.dumps({**each, "id": 0}, sort_keys=True) for each in answers)
        if mine != other:
            raise Failure(f"another answer to {method} {asked['textDocument']}:\n{mine[:1500]}\nfresh:\n{other[:1500]}")
        self.figures.questions += 1

    def check_faults(self) -> None:
        if faults := self.server.faults():
            raise Failure(faults[0])

    def close(self) -> None:
        """Leave as an editor does; raises `Failure` if a process is left or the exit code is not 0."""
        started = descendants(self.server.pid)
        if (code := self.server.close()) != 0:
            raise Failure(f"the server ended with {code}")
        if left := [words for pid, words in started if os.path.exists(f"/proc/{pid}")]:
            raise Failure(f"processes are left behind: {left}")

    def kill(self) -> None:
        """For when a failure has been seen."""
        self.server.kill()


def _difference(one: LspProcess, two: LspProcess) -> str:
    mine, other = one.state(), two.state()
    lines = []
    for uri in sorted({*mine, *other}):
        for title, has, lacks in (("long-lived", mine, other), ("fresh", other, mine)):
            only = [each for each in has.get(uri, []) if each not in lacks.get(uri, [])]
            lines += [f"only {title}: {uri} {each[:600]}" for each in only]
    return "\n".join(lines[:12]) or "one of them does not come to rest"
