"""Files of a revision, written to a folder."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import pytest
from preflight_analysis.environment.revision import NoRevisionError, Revision, write_revision

AUTHOR = {f"GIT_{who}_{what}": "a@b" for who in ("AUTHOR", "COMMITTER") for what in ("NAME", "EMAIL")}


def git(repository: Path, *arguments: str, given: str = "") -> str:
    done = subprocess.run(
        ["git", "-C", str(repository), *arguments],
        input=given.encode(),
        capture_output=True,
        check=True,
        env={**os.environ, **AUTHOR},
    )
    return done.stdout.decode().strip()


def test_a_tree_made_by_hand_does_not_write_through_its_own_link(tmp_path: Path) -> None:
    repository, outside, folder = tmp_path / "repository", tmp_path / "outside", tmp_path / "folder"
    for each in (repository, outside, folder):
        each.mkdir()
    git(repository, "init", "-q")
    link = git(repository, "hash-object", "-w", "--stdin", given=str(outside))
    blob = git(repository, "hash-object", "-w", "--stdin", given="planted")
    inner = git(repository, "mktree", given=f"100644 blob {blob}\tplanted\n")
    tree = git(repository, "mktree", given=f"120000 blob {link}\ta\n040000 tree {inner}\ta\n")
    commit = git(repository, "commit-tree", tree, "-m", "m")
    with pytest.raises(NoRevisionError, match="behind a link"):
        write_revision(Revision(str(repository), commit, "a"), str(folder))
    assert list(outside.iterdir()) == []


def test_links_and_modes_are_those_of_the_revision(tmp_path: Path) -> None:
    repository, folder = tmp_path / "repository", tmp_path / "folder"
    (repository / "p" / "scripts").mkdir(parents=True)
    folder.mkdir()
    git(repository, "init", "-q")
    script = repository / "p" / "scripts" / "node"
    script.write_text("#!/bin/sh\n")
    script.chmod(0o755)
    (repository / "p" / "same").symlink_to("scripts")
    git(repository, "add", "-A")
    git(repository, "commit", "-qm", "m")
    write_revision(Revision(str(repository), git(repository, "rev-parse", "HEAD"), "p"), str(folder))
    assert (folder / "p/same").readlink() == Path("scripts")
    assert os.access(folder / "p/same/node", os.X_OK)
