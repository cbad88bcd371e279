"""Parts of the workspace index, made by processes of our own.

A cold index is seconds of computing. In a thread of the server these would be seconds in which each answer waits for
its turn at the interpreter, and texts that nobody looks at would stay in its memory. So processes of lower priority
do it, one for each core, and hand over plain data (`index_data.py`). That is believed as far as it is still right: what
is lacking, the caller makes itself.

Such a process is our own code on texts that it reads as the caller would, and it runs nothing. What it is asked comes
through a pipe; it ends when that does.
"""

from __future__ import annotations

import gc
import json
import logging
import os
import pickle
import selectors
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, suppress
from typing import Any

import preflight_analysis
from preflight_analysis.dataclass import dataclass
from preflight_analysis.environment.model import Environment
from preflight_analysis.evaluation.commands import Commands
from preflight_analysis.tracing.schedule import processors
from preflight_analysis.workspace.index import Root, WorkspaceIndex
from preflight_analysis.workspace.index_data import data_of_index, index_of_data
from preflight_analysis.workspace.indexing import parts_of_index
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace

MOST = 4
"""Processes at a time: each needs some 100 MB for 500 launch files."""
_FEWEST = 50
"""Launch files for which it is worth while to start another one."""
_STEP = 16
"""Files or roots that are handed over together."""
_PATIENCE = 0.2
"""Seconds after which is asked whether to go on."""
_PIPE_BYTES = 1 << 20
"""What may wait in a pipe while the caller has something better to do."""
_MOST_BYTES = 64 << 20
"""Of one answer, and of all that waits to be read."""
_PROGRAM = """\
import os, sys
os.nice(5)
sys.path.append(sys.argv[1])
from preflight_analysis.workspace.index_processes import answer
answer()
"""
_log = logging.getLogger(__name__)


@dataclass(frozen=True)
class _Order:
    environment: Environment
    cwd: str
    commands: Commands
    paths: Sequence[str]
    named: Sequence[Root]


def parts_by_processes(
    workspace: Workspace,
    paths: Sequence[str],
    named: Sequence[Root],
    cancelled: Callable[[], bool],
) -> Iterator[WorkspaceIndex]:
    """Parts of the index of these launch files, as they come; nothing is ever raised, and nothing left running."""
    count = max(1, min(MOST, processors(), len(paths) // _FEWEST))
    size = -(-len(paths) // count)
    shares = [paths[start : start + size] for start in range(0, len(paths), size)]
    try:
        with ExitStack() as at_end:
            helpers = [at_end.enter_context(_Helper()) for _ in shares]
            commands = workspace.commands.snapshot()
            for helper, share in zip(helpers, shares, strict=True):
                roots = [root for root in named if root.path in frozenset(share)]
                helper.ask(_Order(workspace.environment, workspace.cwd, commands, share, roots))
            for answer in _answers(helpers, cancelled):
                yield index_of_data(answer, workspace, cancelled)
    except (OSError, ValueError) as error:
        _log.info("launch files are indexed without further processes: %s", error)


class _Helper:
    """A process that makes a part."""

    def __init__(self) -> None:
        # Isolated, so that nothing of the folder that we were started in is imported.
        ours = os.path.dirname(os.path.dirname(preflight_analysis.__file__))
        command = [sys.executable, "-I", "-c", _PROGRAM, ours]
        self._process = subprocess.Popen(
            command, cwd="/", stdin=subprocess.PIPE, stdout=subprocess.PIPE, bufsize=0, pipesize=_PIPE_BYTES
        )
        self._read = b""

    def __enter__(self) -> _Helper:
        return self

    def __exit__(self, *_: object) -> None:
        self._process.kill()
        with suppress(OSError):
            self._process.communicate()

    def ask(self, order: _Order) -> None:
        """What to make. The pipe stays open: the process ends with it."""
        assert self._process.stdin is not None
        left = memoryview(pickle.dumps(order))
        while left:
            left = left[self._process.stdin.write(left) :]

    def fileno(self) -> int:
        """Where its answers can be waited for."""
        assert self._process.stdout is not None
        return self._process.stdout.fileno()

    def read(self) -> tuple[bool, list[dict[str, Any]]]:
        """Whether it has ended, and what it has answered since."""
        data = os.read(self.fileno(), 1 << 20)
        *lines, self._read = (self._read + data).split(b"\n")
        if len(self._read) > _MOST_BYTES:
            raise ValueError("too long an answer")
        return not data, [json.loads(line) for line in lines]


def _answers(helpers: Sequence[_Helper], cancelled: Callable[[], bool]) -> Iterator[dict[str, Any]]:
    with selectors.DefaultSelector() as selector:
        for helper in helpers:
            selector.register(helper, selectors.EVENT_READ)
        while selector.get_map() and not cancelled():
            for key, _ in selector.select(_PATIENCE):
                has_ended, answers = key.fileobj.read()  # type: ignore[union-attr]  # they are helpers
                if has_ended:
                    selector.unregister(key.fileobj)
                yield from answers


def answer() -> None:
    """The process: an order on standard input, lines of JSON on standard output."""
    order: _Order = pickle.load(sys.stdin.buffer)  # noqa: S301  # our own, of the process that started us
    threading.Thread(target=_end_with_asker, daemon=True).start()
    gc.disable()  # texts and trees have no cycles, and the process is short
    workspace = Workspace(order.environment, Sources(), order.cwd, order.commands)
    for part in parts_of_index(workspace, order.paths, order.named, _STEP):
        line = json.dumps(data_of_index(workspace.sources, part)).encode() + b"\n"
        sys.stdout.buffer.write(line)
        sys.stdout.buffer.flush()
    os._exit(0)  # all that is to be tidied up goes with the process


def _end_with_asker() -> None:
    os.read(sys.stdin.fileno(), 1)
    os._exit(0)
