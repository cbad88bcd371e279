"""Every command that the documentation shows is run, and says what the page says.

A block of the language `console` has commands after `$ ` (the lines of a here-document follow theirs), and below each
the lines that it prints; `...` stands for any number of lines, and in a line for any text. All blocks of a page are run
one after another in one folder with a home of its own, after what `<!-- before: -->` says; `(exit code N)` is the last
line where that is not 0. Blocks of other languages of a shell are not allowed: a command that cannot be run here stands
in a `text` block.
"""

from __future__ import annotations

import getpass
import os
import pwd
import re
import shutil
import subprocess
import sys
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path

import pytest
from support.ordinary_user import become, ordinary_user
from support.ros2_harness import ros2_prefix

pytestmark = pytest.mark.ros

ROOT = Path(__file__).parent.parent.parent
PAGES = sorted(
    path.relative_to(ROOT)
    for path in (ROOT / "README.md", ROOT / "CONTRIBUTING.md", *(ROOT / "docs").rglob("*.md"))
    if "rules" not in path.parts
)
_FENCE = re.compile(r"^ *```(\w*)[^\n]*\n(.*?)^ *```$", re.MULTILINE | re.DOTALL)
_BEFORE = re.compile(r"^<!-- before: (.*) -->$", re.MULTILINE)
_HERE = re.compile(r"<<\s*'?(\w+)'?")


@dataclass
class Command:
    """A command of a page with what it should print."""

    text: str
    expected: list[str]


def commands(page: str) -> list[Command]:
    """The commands of a page in order."""
    found = [Command(text, []) for text in _BEFORE.findall(page)]
    for language, block in _FENCE.findall(page):
        if language != "console":
            continue
        until: str | None = None
        for line in block.splitlines():
            if until is not None:
                found[-1].text += "\n" + line
                until = None if line.strip() == until else until
            elif line.startswith("$ "):
                found.append(Command(line[2:], []))
                here = _HERE.search(line)
                until = here[1] if here else None
            elif found:
                found[-1].expected.append(line)
    return found


def met(expected: list[str], output: list[str]) -> bool:
    """Whether the output is what is expected, `...` standing for anything."""
    pattern = "".join(
        r"(?:.*\n)*?" if line.strip() == "..." else re.escape(line.rstrip()).replace(r"\.\.\.", ".*") + r"\n"
        for line in expected
    )
    return re.fullmatch(pattern, "".join(line.rstrip() + "\n" for line in output)) is not None


@pytest.mark.parametrize("page", [path for path in PAGES if commands((ROOT / path).read_text())], ids=str)
def test_the_commands_of_a_page(page: Path, tmp_path: Path) -> None:
    home, folder = tmp_path / "home", tmp_path / "folder"
    home.mkdir()
    folder.mkdir()
    (folder / "ros-preflight").symlink_to(ROOT)
    ros2 = [str(ros2_prefix() / "bin")] if "rclpy on" in (ROOT / page).read_text() else []
    path = os.pathsep.join([str(Path(sys.executable).parent), *ros2, os.environ["PATH"]])
    keep = {name: value for name, value in os.environ.items() if name in ("LANG", "LC_ALL", "PIP_INDEX_URL", "TMPDIR")}
    env = {**keep, "HOME": str(home), "PATH": path, "NO_COLOR": "1", "COLUMNS": "120"}
    for command in commands((ROOT / page).read_text()):
        done = subprocess.run(
            ["bash", "-c", f"{command.text}\nstatus=$?\npwd > {home}/.folder\nexit $status"],
            cwd=folder,
            env=env,
            capture_output=True,
            text=True,
            timeout=300,
            check=False,
        )
        folder = Path((home / ".folder").read_text().strip())
        output = (done.stdout + done.stderr).splitlines()
        if done.returncode:
            output.append(f"(exit code {done.returncode})")
        assert met(command.expected, output), f"{page}: $ {command.text}\n" + "\n".join(output)


def test_on_a_fresh_account_readme_is_all_it_takes(tmp_path: Path) -> None:
    """The line that installs, and after the next login the commands, with nothing but a clone in the home folder."""
    page = (ROOT / "README.md").read_text()
    install = re.search(r"^<!-- how to install: begin -->$.*?^ {4}(\S.*?)$", page, re.MULTILINE | re.DOTALL)
    assert install is not None
    with ExitStack() as at_end:
        if os.geteuid() == 0:
            user = at_end.enter_context(ordinary_user())
            home, before = Path(pwd.getpwnam(user).pw_dir), become(user)
        else:
            user, home, before = getpass.getuser(), tmp_path, []
            shutil.copytree("/etc/skel", home, dirs_exist_ok=True)
        assert not (home / ".local").exists()
        listed = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, text=True, check=True)
        for name in filter(None, listed.stdout.split("\0")):
            place = home / "ros-preflight" / name
            place.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / name, place)
        subprocess.run(["chown", "-R", user, str(home)], check=True)
        keep = {name: value for name, value in os.environ.items() if name.startswith("PIP_")}
        env = {**keep, "HOME": str(home), "USER": user, "LANG": "C.UTF-8", "NO_COLOR": "1"}

        def login(text: str) -> list[str]:
            done = subprocess.run(
                [*before, "bash", "-l"], input=text, cwd=home, env=env, capture_output=True, text=True, check=False
            )
            assert done.returncode == 0, done.stderr
            return done.stdout.splitlines()

        login(f"set -e; cd ros-preflight; {install[1]}")
        cd, first, *_ = commands(page)
        assert met(first.expected, login(f"{cd.text}\n{first.text}"))


@pytest.mark.parametrize("page", PAGES, ids=str)
def test_no_command_is_shown_that_is_not_run(page: Path) -> None:
    languages = {language for language, _ in _FENCE.findall((ROOT / page).read_text())}
    assert not languages & {"", "bash", "sh", "shell"}


def test_a_command_that_prints_something_else_is_noticed() -> None:
    assert met(["a", "...", "d ... f"], ["a", "b", "c", "d e f"])
    assert met(["..."], [])
    assert not met(["a"], ["a", "b"])
    assert not met([], ["a"])


def test_the_site_is_built_and_no_link_is_broken(tmp_path: Path) -> None:
    zensical = shutil.which("zensical", path=str(Path(sys.executable).parent))
    assert zensical is not None, "zensical is missing: pip install --group dev"
    shutil.copyfile(ROOT / "mkdocs.yml", tmp_path / "mkdocs.yml")
    shutil.copytree(ROOT / "docs", tmp_path / "docs")

    def built() -> subprocess.CompletedProcess[str]:
        command = [zensical, "build", "--strict", "--clean", "--config-file", tmp_path / "mkdocs.yml"]
        return subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, timeout=300, check=False)

    done = built()
    assert done.returncode == 0, done.stdout + done.stderr
    page = (tmp_path / "out/site/index.html").read_text()
    loaded = re.findall(r'<(?:script|img|link rel="(?:stylesheet|preload)")[^>]*(?:src|href)="(https?:[^"]+)', page)
    assert loaded == [], "nothing is loaded from elsewhere"
    (tmp_path / "docs/index.md").write_text("# Index\n[there is no such page](nothing.md)\n")
    assert built().returncode != 0, "a broken link is noticed"
