"""Git's reading commands on a repository whose configuration is not obeyed.

A repository's configuration names programs that git runs even when it only reads: filters, hooks, file monitors,
difference drivers, what fetches a missing object. A list of all of them is never complete. So git is given a folder of
ours in place of the repository's `.git`: links to its objects and references and a copy of its index, beside a
configuration that holds the few settings of `_HARMLESS`. The user's and the system's configuration are left out as
well: filters for large files that they name (git-lfs) would take their orders from the repository.
"""

from __future__ import annotations

import contextlib
import os
import re
import resource
import shutil
import subprocess
import tempfile
import threading
from collections.abc import Iterator

from preflight_analysis.dataclass import dataclass

_TIMEOUT = 60
_MOST_BYTES = 256 << 20
"""What git may print: a tree of a few hundred bytes can have more files than any disk (a "git bomb")."""
_MOST_MEMORY = 4 << 30
_MOST_COPIED = 1 << 30
"""The size of an index or `HEAD`; both may be files with holes."""

# What changes how names, contents and revisions are read, and names no program.
_HARMLESS = (
    r"^(core\.(filemode|ignorecase|symlinks|autocrlf|eol|precomposeunicode|repositoryformatversion)"
    r"|extensions\.(objectformat|refstorage)|branch\..*\.(merge|remote)|remote\..*\.fetch)$"
)
# gitrepository-layout(5): of a working tree's own folder, and of the one that all working trees share.
_OWN = ("ORIG_HEAD", "FETCH_HEAD", "MERGE_HEAD")
_SHARED = ("objects", "refs", "packed-refs", "reftable", "shallow", "info", "logs")
_SHARED_INDEX = re.compile(r"sharedindex\.[0-9a-f]+")


class GitError(Exception):
    """Git is not installed, does not answer or says no; the message is a sentence for users."""


@dataclass(frozen=True, slots=True)
class Repository:
    """A repository that can be asked. `top` is the folder of its working tree."""

    top: str
    _folder: str

    def command(self, *arguments: str) -> list[str]:
        """What to run with `environment`."""
        return ["git", "--no-optional-locks", "--no-pager", "-C", self.top, *arguments]

    @property
    def environment(self) -> dict[str, str]:
        """The process's own variables without those of git."""
        own = {"GIT_DIR": self._folder, "GIT_WORK_TREE": self.top}
        # Git before 2.32 knows no other way to leave the user's configuration out.
        return {**_variables(), **own, "HOME": self._folder, "XDG_CONFIG_HOME": self._folder}

    def ask(self, *arguments: str, seconds: float = _TIMEOUT) -> bytes:
        """What git prints within that time. Raises `GitError`."""
        return _run(self.command(*arguments), self.environment, seconds)


@contextlib.contextmanager
def open_repository(path: str) -> Iterator[Repository]:
    """The repository of the working tree around a folder, as long as the block lasts. Bare repositories do not count:
    an ordinary clone may contain one. Raises `GitError`."""
    top = _top_of(os.path.realpath(path))
    if top is None:
        raise GitError(f"{path} is not in a git repository")
    if shutil.which("git") is None:
        raise GitError("git is not installed")
    own, shared = folders_of(top)
    with tempfile.TemporaryDirectory(prefix="ros-preflight-git-", ignore_cleanup_errors=True) as folder:
        try:
            for source, names in ((own, (*_OWN, *_shared_indices(own))), (shared, _SHARED)):
                for name in names:
                    if os.path.lexists(os.path.join(source, name)):
                        os.symlink(os.path.join(source, name), os.path.join(folder, name))
            # Copies: git takes no link for HEAD, and `git diff` writes what it found out of files into the index.
            for name in ("HEAD", "index"):
                if os.path.isfile(os.path.join(own, name)):
                    if os.path.getsize(os.path.join(own, name)) > _MOST_COPIED:
                        raise GitError(f"{own}/{name} is too large")
                    shutil.copyfile(os.path.join(own, name), os.path.join(folder, name))
            _configure(os.path.join(folder, "config"), os.path.join(shared, "config"))
        except OSError as error:
            raise GitError(f"the repository of {top} cannot be read: {error.strerror}") from None
        yield Repository(top, folder)


def _top_of(folder: str) -> str | None:
    while not os.path.lexists(os.path.join(folder, ".git")):
        parent = os.path.dirname(folder)
        if parent == folder:
            return None
        folder = parent
    return folder


def folders_of(top: str) -> tuple[str, str]:
    """The working tree's own git folder, and the one it shares with others (gitrepository-layout(5), `commondir`)."""
    own = os.path.join(top, ".git")
    if os.path.isfile(own):
        own = os.path.join(top, _pointer(own, "gitdir: "))
    shared = own
    if os.path.isfile(os.path.join(own, "commondir")):
        shared = os.path.join(own, _pointer(os.path.join(own, "commondir"), ""))
    if not os.path.isfile(os.path.join(own, "HEAD")):
        raise GitError(f"{top} is not a git repository: '{own}/HEAD' does not exist")
    return own, shared


def _pointer(file: str, prefix: str) -> str:
    try:
        with open(file, encoding="utf-8", errors="surrogateescape") as stream:
            text = stream.read(4096)
    except OSError as error:
        raise GitError(f"{file} cannot be read: {error.strerror}") from None
    if not text.startswith(prefix):
        raise GitError(f"{file} names no git folder")
    return text.removeprefix(prefix).rstrip("\n")


def _shared_indices(folder: str) -> list[str]:
    return [name for name in os.listdir(folder) if _SHARED_INDEX.fullmatch(name)]


def _configure(target: str, source: str) -> None:
    """Copy the harmless settings. No included files: what they hold is not of this repository."""
    entries = [("core.bare", "false")]
    if os.path.isfile(source):
        with contextlib.suppress(GitError):  # exit code 1 where none of them is set
            listed = _run(
                ["git", "config", "--file", source, "--no-includes", "--null", "--get-regexp", _HARMLESS], _variables()
            )
            for entry in filter(None, listed.split(b"\0")):
                name, equals, value = os.fsdecode(entry).partition("\n")
                entries.append((name, value if equals else "true"))
    ignored = _users_excludes()
    if ignored is not None:
        entries.append(("core.excludesfile", ignored))
    with open(target, "w", encoding="utf-8", errors="surrogateescape") as stream:
        stream.writelines(_setting(name, value) for name, value in entries)


def _setting(name: str, value: str) -> str:
    """An entry as git-config(1) reads it; the middle of a name may hold anything but line breaks."""
    section, _, rest = name.partition(".")
    middle, _, key = rest.rpartition(".")
    header = f'[{section} "{_quoted(middle)}"]' if middle else f"[{section}]"
    return f'{header}\n\t{key} = "{_quoted(value)}"\n'


def _quoted(text: str) -> str:
    return text.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n")


def _users_excludes() -> str | None:
    """The file of what the user ignores everywhere (gitignore(5))."""
    with contextlib.suppress(GitError):
        named = _run(["git", "config", "--global", "--path", "--get", "core.excludesFile"], _variables(users=True))
        return os.fsdecode(named).rstrip("\n")
    home = os.environ.get("XDG_CONFIG_HOME") or os.path.expanduser("~/.config")
    default = os.path.join(home, "git", "ignore")
    return default if os.path.isfile(default) else None


def _variables(*, users: bool = False) -> dict[str, str]:
    """Variables in which nothing of git's is set but that no configuration of user or system is read."""
    kept = {name: value for name, value in os.environ.items() if not name.startswith("GIT_")}
    if users:
        return kept
    nowhere = {"GIT_CONFIG_GLOBAL": os.devnull, "GIT_CONFIG_SYSTEM": os.devnull, "GIT_CONFIG_NOSYSTEM": "1"}
    return {**kept, **nowhere, "GIT_NO_LAZY_FETCH": "1", "GIT_ALLOW_PROTOCOL": "none", "GIT_TERMINAL_PROMPT": "0"}


def _run(command: list[str], environment: dict[str, str], seconds: float = _TIMEOUT) -> bytes:
    ended: list[str] = []
    try:
        with (
            tempfile.TemporaryFile() as errors,
            # Not in a folder of the repository: `git config` looks for one around it, too.
            subprocess.Popen(
                command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=errors, env=environment, cwd="/"
            ) as git,
        ):
            assert git.stdout is not None
            with contextlib.suppress(OSError):  # it has ended already
                resource.prlimit(git.pid, resource.RLIMIT_DATA, (_MOST_MEMORY, _MOST_MEMORY))

            def end(why: str) -> None:
                ended.append(why)
                git.kill()

            clock = threading.Timer(seconds, end, [f"it takes more than {seconds:g} s"])
            clock.start()
            said = git.stdout.read(_MOST_BYTES + 1)
            if len(said) > _MOST_BYTES:
                end(f"it prints more than {_MOST_BYTES >> 20} MiB")
            git.wait()
            clock.cancel()
            errors.seek(0)
            complaints = errors.read(4096).decode(errors="replace").strip().splitlines()
    except OSError as error:
        raise GitError(f"git does not answer: {error}") from None
    if ended:
        raise GitError(f"git does not answer: {ended[0]}")
    if git.returncode:
        raise GitError(f"git: {complaints[0] if complaints else command[-1]}")
    return said
