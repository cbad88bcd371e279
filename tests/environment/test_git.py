"""Repositories that name programs for git to run: none of them runs, whatever is asked."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest
from preflight_analysis.environment import git as environment_git
from preflight_analysis.environment import revision as environment_revision
from preflight_analysis.environment.git import GitError, open_repository
from preflight_analysis.environment.revision import NoRevisionError, Revision, find_revision, write_revision
from preflight_server.cli.changes import changed_since
from preflight_server.cli.errors import CannotDoError

AUTHOR = {f"GIT_{who}_{what}": "a@b" for who in ("AUTHOR", "COMMITTER") for what in ("NAME", "EMAIL")}


def git(folder: Path, *arguments: str, check: bool = True) -> str:
    """Git as a user calls it, the repository's configuration included."""
    variables = {**os.environ, **AUTHOR, "GIT_CONFIG_NOSYSTEM": "1", "HOME": str(folder.parent)}
    done = subprocess.run(
        ["git", "-C", str(folder), *arguments], capture_output=True, check=check, env=variables, text=True
    )
    return done.stdout.strip()


def make(folder: Path) -> Path:
    """A repository with one commit, and a change since that git can only see by reading the file."""
    folder.mkdir()
    git(folder, "init", "-q", "-b", "main")
    (folder / "a.launch").write_text("<launch></launch>\n")
    (folder / "same.launch").write_text("<launch/>\n")
    git(folder, "add", "-A")
    git(folder, "commit", "-qm", "m")
    (folder / "a.launch").write_text("<launch> </launch>\n")
    os.utime(folder / "same.launch", (1, 1))
    return folder


def trap(repository: Path, marker: Path) -> Path:
    """A program that leaves the marker."""
    program = repository.parent / "trap"
    program.write_text(f"#!/bin/sh\ntouch '{marker}'\nexit 1\n")
    program.chmod(0o755)
    return program


def filtered(name: str) -> Callable[[Path, Path], None]:
    def arm(repository: Path, program: Path) -> None:
        git(repository, "config", f"filter.f.{name}", str(program))
        (repository / ".gitattributes").write_text("*.launch filter=f\n")

    return arm


def hooked(repository: Path, program: Path) -> None:
    (repository / ".git/hooks/post-index-change").symlink_to(program)


def hooked_elsewhere(repository: Path, program: Path) -> None:
    (repository / "hooks").mkdir()
    (repository / "hooks/post-index-change").symlink_to(program)
    git(repository, "config", "core.hooksPath", "hooks")


def monitored(repository: Path, program: Path) -> None:
    git(repository, "config", "core.fsmonitor", str(program))


def included(repository: Path, program: Path) -> None:
    (repository / "more").write_text(f"[core]\n\tfsmonitor = {program}\n")
    git(repository, "config", "include.path", "../more")


def for_this_tree(repository: Path, program: Path) -> None:
    git(repository, "config", "extensions.worktreeConfig", "true")
    git(repository, "config", "--worktree", "core.fsmonitor", str(program))


def in_a_submodule(repository: Path, program: Path) -> None:
    inner = make(repository / "inner")
    filtered("clean")(inner, program)
    git(repository, "add", "inner")


@pytest.mark.parametrize(
    "arm",
    [
        filtered("clean"),
        filtered("process"),
        hooked,
        hooked_elsewhere,
        monitored,
        included,
        for_this_tree,
        in_a_submodule,
    ],
    ids=["clean", "process", "hook", "hooks-path", "fsmonitor", "include", "worktree-config", "submodule"],
)
def test_a_repository_names_a_program(arm: Callable[[Path, Path], None], tmp_path: Path) -> None:
    repository, marker, folder = make(tmp_path / "repository"), tmp_path / "ran", tmp_path / "folder"
    folder.mkdir()
    arm(repository, trap(repository, marker))
    # Arming itself may have set it off.
    marker.unlink(missing_ok=True)
    os.utime(repository / "same.launch", (2, 2))
    index = (repository / ".git/index").read_bytes()
    changed = changed_since("main", str(repository))
    revision = find_revision("main:a.launch", str(repository))
    write_revision(revision, str(folder))
    assert not marker.exists()
    assert (repository / ".git/index").read_bytes() == index
    assert str(repository / "a.launch") in changed
    assert str(repository / "same.launch") not in changed
    assert (folder / "a.launch").read_text() == "<launch></launch>\n"
    # The trap is one: plain git sets it off.
    git(repository, "status", check=False)
    assert marker.exists()


def test_an_object_that_is_missing_is_not_fetched(tmp_path: Path) -> None:
    """A clone without contents names a program that would hand them over (`remote.NAME.uploadpack`)."""
    source, marker, folder = make(tmp_path / "source"), tmp_path / "ran", tmp_path / "folder"
    folder.mkdir()
    git(source, "config", "uploadpack.allowFilter", "true")
    git(tmp_path, "clone", "-q", "--no-checkout", "--filter=blob:none", f"file://{source}", "clone")
    clone = tmp_path / "clone"
    git(clone, "config", "remote.origin.uploadpack", str(trap(clone, marker)))
    revision = "main:a.launch"
    try:
        write_revision(find_revision(revision, str(clone)), str(folder))
        said = ""
    except Exception as error:
        said = str(error)
    assert "a.launch" in said
    assert not marker.exists()
    git(clone, "cat-file", "-p", revision, check=False)
    assert marker.exists()


def test_a_folder_that_looks_like_a_bare_repository_is_none(tmp_path: Path) -> None:
    """What an ordinary clone can contain: a bare repository whose working tree is itself."""
    outer = make(tmp_path / "outer")
    git(outer, "init", "-q", "--bare", "bare")
    marker = tmp_path / "ran"
    git(outer / "bare", "config", "core.bare", "false")
    git(outer / "bare", "config", "core.worktree", ".")
    git(outer / "bare", "config", "core.fsmonitor", str(trap(outer, marker)))
    with open_repository(str(outer / "bare")) as repository:
        assert repository.top == str(outer)
    changed_since("main", str(outer / "bare"))
    assert not marker.exists()
    git(outer / "bare", "status", check=False)
    assert marker.exists()


def test_what_the_user_configured_is_no_program_for_a_strange_repository(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As git-lfs is: it takes its orders from the repository's attributes and `.lfsconfig`."""
    repository, marker = make(tmp_path / "repository"), tmp_path / "ran"
    program = trap(repository, marker)
    (tmp_path / ".gitconfig").write_text(f'[filter "lfs"]\n\tclean = {program}\n[core]\n\texcludesFile = ~/mine\n')
    (tmp_path / "mine").write_text("*.swp\n")
    (repository / ".gitattributes").write_text("*.launch filter=lfs\n")
    (repository / "a.swp").touch()
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.setenv("GIT_CONFIG_COUNT", "1")
    monkeypatch.setenv("GIT_CONFIG_KEY_0", "core.fsmonitor")
    monkeypatch.setenv("GIT_CONFIG_VALUE_0", str(program))
    changed = changed_since("main", str(repository))
    assert changed == {str(repository / name) for name in (".gitattributes", "a.launch")}
    assert not marker.exists()


def test_worktrees_submodules_and_settings_that_matter(tmp_path: Path) -> None:
    """What git itself reads elsewhere than in `.git` is found, and a setting that changes the answer counts."""
    origin = make(tmp_path / "origin")
    git(origin, "worktree", "add", "-q", "-b", "side", str(tmp_path / "tree"))
    (tmp_path / "tree/new.launch").touch()
    assert changed_since("main", str(tmp_path / "tree")) == {str(tmp_path / "tree/new.launch")}
    git(origin, "commit", "-qam", "second")
    git(tmp_path, "clone", "-q", str(origin), "clone")
    clone = tmp_path / "clone"
    git(clone, "-c", "protocol.file.allow=always", "submodule", "--quiet", "add", str(origin), "sub")
    (clone / "sub/a.launch").write_text("<launch>  </launch>\n")
    assert changed_since("HEAD", str(clone / "sub")) == {str(clone / "sub/a.launch")}
    assert changed_since("@{upstream}", str(clone)) == {str(clone / name) for name in (".gitmodules", "sub")}
    (clone / "a.launch").chmod(0o755)
    assert str(clone / "a.launch") in changed_since("HEAD", str(clone))
    git(clone, "config", "core.fileMode", "false")
    assert str(clone / "a.launch") not in changed_since("HEAD", str(clone))


def test_a_branch_with_an_odd_name_does_not_write_into_the_configuration(tmp_path: Path) -> None:
    repository = make(tmp_path / "repository")
    config = repository / ".git/config"
    config.write_text(config.read_text() + '[branch "a\\"]\\\\[core"]\n\tmerge = "x\\"\\n[core]\\n\\tfsmonitor = y"\n')
    with open_repository(str(repository)) as opened:
        listed = opened.ask("config", "--null", "--list").decode().split("\0")
    assert 'branch.a"]\\[core.merge\nx"\n[core]\n\tfsmonitor = y' in listed
    assert not [entry for entry in listed if entry.startswith("core.fsmonitor")]


def test_without_a_repository(tmp_path: Path) -> None:
    with pytest.raises(GitError, match="is not in a git repository"), open_repository(str(tmp_path)):
        pass
    (tmp_path / ".git").mkdir()
    with pytest.raises(GitError, match="HEAD' does not exist"), open_repository(str(tmp_path)):
        pass


def bomb(repository: Path, levels: int) -> None:
    """A tree whose folders are all the same one, ten in each: ten to the power of so many files."""
    name = git(repository, "rev-parse", "HEAD:a.launch")
    entry = f"100644 blob {name}\t"
    for _ in range(levels):
        listed = "".join(f"{entry}{number}\n" for number in range(10))
        made = subprocess.run(
            ["git", "-C", str(repository), "mktree"], input=listed, capture_output=True, text=True, check=True
        )
        entry = f"040000 tree {made.stdout.strip()}\t"
    commit = git(repository, "commit-tree", made.stdout.strip(), "-m", "bomb")
    git(repository, "update-ref", "refs/heads/bomb", commit)


def test_more_files_than_any_disk_has(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Git is stopped at what it prints, or at what it keeps in mind."""
    repository, folder = make(tmp_path / "repository"), tmp_path / "folder"
    folder.mkdir()
    bomb(repository, 12)
    monkeypatch.setattr(environment_git, "_MOST_BYTES", 1 << 20)
    monkeypatch.setattr(environment_git, "_MOST_MEMORY", 64 << 20)
    revision = Revision(str(repository), git(repository, "rev-parse", "bomb"), "0")
    with pytest.raises(NoRevisionError, match="git does not answer: it prints more than 1 MiB"):
        write_revision(revision, str(folder))
    with pytest.raises(CannotDoError, match=r"(?i)git: fatal: .*out of memory|git does not answer: it prints"):
        changed_since("bomb", str(repository))


def test_a_file_that_fills_the_disk(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    repository, folder = make(tmp_path / "repository"), tmp_path / "folder"
    folder.mkdir()
    (repository / "zeros").write_bytes(bytes(3 << 20))
    git(repository, "add", "-A")
    git(repository, "commit", "-qm", "m")
    revision = Revision(str(repository), git(repository, "rev-parse", "HEAD"), "zeros")
    write_revision(revision, str(folder))
    assert (folder / "zeros").read_bytes() == bytes(3 << 20)
    (folder / "again").mkdir()
    monkeypatch.setattr(environment_revision, "_MOST_BYTES", 2 << 20)
    with pytest.raises(NoRevisionError, match="are more than"):
        write_revision(revision, str(folder / "again"))
    assert not (folder / "again/zeros").exists()


@pytest.mark.parametrize("name", ["HEAD", "index"])
def test_a_file_of_git_with_a_hole_is_not_copied(tmp_path: Path, name: str) -> None:
    repository = make(tmp_path / "repository")
    os.truncate(repository / ".git" / name, 1 << 40)
    with pytest.raises(GitError, match="is too large"), open_repository(str(repository)):
        raise AssertionError


@pytest.mark.parametrize(
    "name",
    [
        "HEAD",
        "index",
        "config",
        "packed-refs",
        "refs/heads/main",
        "objects/info/alternates",
        "info/exclude",
        "commondir",
    ],
)
def test_what_never_ends_in_the_place_of_a_file_of_git(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    """A named pipe that nobody writes to, or a link that leads to itself: an answer or an error, in time."""
    monkeypatch.setattr(environment_git, "_TIMEOUT", 1)
    for kind in (os.mkfifo, lambda path: os.symlink(path, path)):
        repository = make(tmp_path / kind.__name__.strip("<>"))
        place = repository / ".git" / name
        place.unlink(missing_ok=True)
        kind(place)
        try:
            assert str(repository / "a.launch") in changed_since("HEAD", str(repository))
        except CannotDoError as error:
            assert "git" in str(error) or "is no revision" in str(error)


def test_a_repository_that_leads_elsewhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """By its `.git` file, alternates, replaced objects and grafts: nothing there is changed, and nothing runs."""
    other, repository = make(tmp_path / "other"), make(tmp_path / "repository")
    marker = tmp_path / "ran"
    filtered("clean")(other, trap(other, marker))
    before = {path: path.stat().st_mtime_ns for path in (other / ".git").rglob("*")}
    (repository / ".git/objects/info/alternates").write_text(f"{other}/.git/objects\n{repository}/.git/objects\n/\n")
    head, blob = (git(repository, "rev-parse", name) for name in ("HEAD", "HEAD:a.launch"))
    git(repository, "replace", blob, git(repository, "rev-parse", "HEAD:same.launch"))
    (repository / ".git/info/grafts").write_text(f"{head} {head}\n")
    assert str(repository / "a.launch") in changed_since("HEAD", str(repository))
    pointing = tmp_path / "pointing"
    pointing.mkdir()
    (pointing / ".git").write_text(f"gitdir: {other}/.git\n")
    assert str(pointing / "a.launch") in changed_since("HEAD", str(pointing))
    assert {path: path.stat().st_mtime_ns for path in (other / ".git").rglob("*")} == before
    assert not marker.exists()
    for text in (f"gitdir: {pointing}/.git\n", "gitdir: \0\n", "gitdir: \n", "x" * 9000, "gitdir: /proc/self/fd/0\n"):
        (pointing / ".git").write_text(text)
        with pytest.raises(CannotDoError):
            changed_since("HEAD", str(pointing))


@pytest.mark.parametrize(
    "name", ["-x", "--upload-pack=touch ran", "--output=ran", "HEAD\n--output=ran", "@{-1}", ":/x"]
)
def test_a_revision_that_looks_like_an_option(tmp_path: Path, name: str) -> None:
    repository = make(tmp_path / "repository")
    with pytest.raises(CannotDoError, match="is no revision"):
        changed_since(name, str(repository))
    with pytest.raises(NoRevisionError, match="is no revision"):
        find_revision(f"{name}:a.launch", str(repository))
    assert not list(tmp_path.rglob("ran"))


def test_a_submodule_whose_address_is_an_option(tmp_path: Path) -> None:
    repository, marker = make(tmp_path / "repository"), tmp_path / "ran"
    (repository / ".gitmodules").write_text(
        f'[submodule "-x"]\n\tpath = -x\n\turl = -u./{marker}\n\tupdate = !touch {marker}\n'
        f'[submodule "../../x"]\n\tpath = inner\n\turl = ext::touch {marker}\n'
    )
    git(repository, "update-index", "--add", "--cacheinfo", f"160000,{git(repository, 'rev-parse', 'HEAD')},-x")
    git(repository, "add", "-A")
    git(repository, "commit", "-qm", "m")
    changed_since("HEAD~1", str(repository))
    folder = tmp_path / "folder"
    folder.mkdir()
    write_revision(find_revision("HEAD:a.launch", str(repository)), str(folder))
    assert not marker.exists()
    assert not (folder / "-x").exists()
