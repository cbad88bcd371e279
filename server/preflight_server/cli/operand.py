"""What `snapshot` and `diff` look at: a launch file with its arguments, a revision of one, or a snapshot."""

from __future__ import annotations

import argparse
import os
import tempfile
from contextlib import ExitStack

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.reading import Unreadable, read_text
from preflight_analysis.environment.detect import workspace_of
from preflight_analysis.environment.revision import (
    NoRevisionError,
    environment_at,
    find_revision,
    write_revision,
)
from preflight_analysis.snapshot.files import NotASnapshotError, from_yaml, is_snapshot
from preflight_analysis.snapshot.make import snapshot_of
from preflight_analysis.snapshot.model import Snapshot
from preflight_analysis.workspace.workspace import Analysis

from preflight_server.cli import options
from preflight_server.cli.errors import CannotDoError, require
from preflight_server.cli.project import analyse, run_nodes


@dataclass(frozen=True, slots=True)
class Operand:
    """One operand of a comparison as given on the command line."""

    file: str
    args: tuple[str, ...] = ()

    @property
    def title(self) -> str:
        """As given."""
        return " ".join((self.file, *self.args))


def operands(words: list[str]) -> list[Operand]:
    """Files, each followed by the `name:=value` words of its own."""
    found: list[Operand] = []
    for word in words:
        if not options.is_assignment(word):
            found.append(Operand(word))
        elif not found:
            raise CannotDoError(f"{word} stands before the launch file that it is an argument of")
        else:
            found[-1] = Operand(found[-1].file, (*found[-1].args, word))
    return found


def snapshot_of_operand(operand: Operand, args: argparse.Namespace, cleanup: ExitStack) -> Snapshot:
    """What stands in a snapshot, or what a launch file comes to. Folders that are made for it go with `cleanup`.

    Raises `CannotDoError`.
    """
    path = os.path.abspath(operand.file)
    values = options.launch_args(list(operand.args), path)
    if os.path.isdir(path):
        raise CannotDoError(f"{operand.file} is a folder; name a launch file or a snapshot")
    if not os.path.exists(path):
        if ":" not in operand.file:
            require(operand.file)
        return _at_revision(operand, values, args, cleanup)
    text = read_text(path)
    if isinstance(text, Unreadable):
        raise CannotDoError(f"{operand.file} {text.reason}")
    if not is_snapshot(text.text):
        return from_launch(path, values, args)[1]
    if values:
        raise CannotDoError(f"{operand.file} is a snapshot, which takes no arguments")
    return _read(operand, text.text)


def from_launch(path: str, values: dict[str, str], args: argparse.Namespace) -> tuple[Analysis, Snapshot]:
    """A launch file of the disk as it is now."""
    environment = options.environment(args, path)
    # What executables did elsewhere is known on this machine only.
    analysis = run_nodes(analyse(path, values, environment, args, similar=False), args)
    if analysis.graph is None:
        raise CannotDoError("the launch file has no graph")
    return analysis, snapshot_of(analysis, analysis.graph)


def _read(operand: Operand, text: str) -> Snapshot:
    try:
        return from_yaml(text)
    except NotASnapshotError as error:
        raise CannotDoError(f"{operand.file} {error}") from None


def _at_revision(operand: Operand, values: dict[str, str], args: argparse.Namespace, cleanup: ExitStack) -> Snapshot:
    try:
        revision = find_revision(operand.file, os.getcwd())
        folder = os.path.realpath(
            cleanup.enter_context(
                tempfile.TemporaryDirectory(prefix="ros-preflight-revision-", ignore_cleanup_errors=True)
            )
        )
        write_revision(revision, folder)
    except NoRevisionError as error:
        raise CannotDoError(f"{operand.file}: {error}") from None
    except OSError as error:
        raise CannotDoError(f"{operand.file} cannot be checked out: {error.strerror}") from None
    path = os.path.join(folder, revision.file)
    text = read_text(path)
    if not isinstance(text, Unreadable) and is_snapshot(text.text):
        return _read(operand, text.text)
    # The file may not be there any more.
    workspace = workspace_of(os.path.join(revision.repository, revision.file))
    now = options.environment(args, workspace)
    environment = environment_at(now, revision.repository, folder)
    analysis = run_nodes(analyse(path, values, environment, args, similar=False), args)
    if analysis.graph is None:
        raise CannotDoError("the launch file has no graph")
    return snapshot_of(analysis, analysis.graph)
