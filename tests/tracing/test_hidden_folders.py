"""A workspace whose links, index entries, variables and commands lead to the hidden files of its user: none is shown,
with any way to isolate; what the workspace and the own variables of the user have still is."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import threading
from pathlib import Path

import pytest
from preflight_analysis.environment import reach
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.environment.model import Environment
from preflight_analysis.tracing import interior, recipe, ros1_recipe, sandbox
from preflight_analysis.tracing.commands import CommandRunner
from preflight_analysis.tracing.trace import Tracer
from support.tracing_harness import known_backends, request, write_node

INDEX = "share/ament_index/resource_index/packages"
LOOK = """
import os, sys
for path in sys.argv[1:]:
    if path.startswith("/"):
        try:
            with open(path) as file:
                print(path, "read", file.read().strip(), file=sys.stderr)
        except OSError as error:
            print(path, "hidden", file=sys.stderr)
"""


class Home:
    """A home folder with secrets and with a workspace in it."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder / "home"
        self.workspace = self.folder / "ws"
        self.package = self.workspace / "src/pkg"
        for place in (self.package, self.folder / ".ssh", self.folder / "private/bin", self.folder / "other"):
            place.mkdir(parents=True)
        (self.package / "package.xml").write_text("<package><name>pkg</name></package>")
        (self.package / "open.txt").write_text("fine")
        for name in (".ssh/id_ed25519", "private/creds.txt", "private/more.txt", "other/file.txt"):
            (self.folder / name).write_text("hunter2")
        self.node = write_node(self.package, LOOK)
        self.variables = {"PATH": "/usr/bin:/bin", "HOME": str(self.folder)}

    def link(self, name: str, target: str) -> str:
        """A link of the workspace, to a path relative to itself; what it would lead to."""
        path = self.workspace / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.symlink_to(target)
        assert path.exists(), "leads somewhere"
        return str(path)

    def environment(self, **variables: str) -> Environment:
        return detect_environment(str(self.workspace), {**self.variables, **variables})

    def seen(self, *paths: str, **variables: str) -> list[str]:
        """Of these paths those that a node of the workspace could read."""
        found = Tracer(self.environment(**variables), None).trace(
            request(self.node, args=(*paths, str(self.package / "open.txt"))), threading.Event()
        )
        lines = [line for line in found.outcome.stderr_tail if line.startswith("/")]
        assert lines[-1:] == [f"{self.package}/open.txt read fine"], found
        return [line for line in lines[:-1] if not line.endswith(" hidden")]

    def command(self, line: str, **variables: str) -> str:
        """What a command comes to."""
        runner = CommandRunner(self.environment(**variables), str(self.workspace), None)
        return repr(runner.run(line, threading.Event()))


@pytest.fixture
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Home:
    home = Home(tmp_path)
    monkeypatch.setenv("HOME", str(home.folder))
    return home


@pytest.mark.ros
@pytest.mark.usefixtures("each_backend")
def test_links_of_the_workspace_show_nothing_of_where_they_lead(home: Home) -> None:
    share = home.link("install/share/k", "../../../.ssh")
    index = home.workspace / "install" / INDEX
    index.mkdir(parents=True)
    (index / "k").touch()
    modules = home.link("devel/lib/python3/dist-packages", "../../../../.ssh")
    (home.workspace / "devel/.catkin").touch()
    (home.workspace / ".catkin_workspace").touch()
    package = home.link("src/linked", "../../private")
    (home.folder / "private/package.xml").write_text("<package><name>linked</name></package>")
    paths = [f"{folder}/id_ed25519" for folder in (share, modules, home.folder / ".ssh")]
    paths += [f"{folder}/creds.txt" for folder in (package, home.folder / "private")]
    assert home.seen(*paths) == []
    environment = home.environment()
    assert {"k", "linked"} <= environment.packages.keys(), "they are known all the same"


@pytest.mark.ros
@pytest.mark.usefixtures("each_backend")
def test_programs_and_first_lines_of_the_workspace_show_nothing(home: Home) -> None:
    """A node that is a link to a program elsewhere, and one whose first line names a secret as its interpreter."""
    secret = home.folder / "private/bin/tool"
    secret.write_text("#!/bin/sh\ncat creds.txt ../creds.txt >&2\n")
    secret.chmod(0o755)
    linked = Path(home.link("src/pkg/linked", "../../../private/bin/tool"))
    named = home.package / "named"
    named.write_text(f"#!{home.folder}/.ssh/id_ed25519\n")
    named.chmod(0o755)
    for script, hidden in ((linked, secret), (named, home.folder / ".ssh/id_ed25519")):
        outcome = Tracer(home.environment(), None).trace(request(script), threading.Event()).outcome
        assert outcome.status == "not-run"
        assert str(outcome.reason).startswith(f"it needs '{hidden}', which lies outside of the workspace")
    assert "hunter2" not in home.command(str(linked))
    environment = home.environment()
    shown = recipe.command_paths(
        environment, ros1_recipe.make_command(environment, str(named), (), "/"), str(named), (), ""
    )
    assert not interior.shown(f"{home.folder}/.ssh/id_ed25519", shown)


@pytest.mark.ros
@pytest.mark.usefixtures("each_backend")
def test_of_what_a_command_names_the_file_alone_is_shown(home: Home) -> None:
    private, keys = f"{home.folder}/private", f"{home.folder}/.ssh"
    link = home.link("src/pkg/link", "../../../private/creds.txt")
    assert "'hunter2'" in home.command(f"cat {private}/creds.txt"), "whoever writes the command knows where it is"
    for line in (
        f"bash -c 'cat {private}/creds.txt > /dev/null; cat {private}/m*'",
        f"cat {keys}/id_ed25519",
        f"cat {link}",
        f"bash -c 'cd {private} && cat *'",
        f"bash -c 'cat {private}/creds.txt > /dev/null; ls {private}/bin; cat {home.folder}/other/*'",
    ):
        assert "hunter2" not in home.command(line), line
    assert "fine" in home.command(f"cat {home.package}/open.txt")


@pytest.mark.ros
@pytest.mark.usefixtures("each_backend")
def test_what_the_users_own_variables_name_is_shown(home: Home) -> None:
    home.link("src/linked", "../../other")
    (home.folder / "other/package.xml").write_text("<package><name>linked</name></package>")
    path = f"{home.workspace}/src/linked/file.txt"
    assert home.seen(path) == []
    assert home.seen(path, ROS_PACKAGE_PATH=f"{home.folder}/other") == [f"{path} read hunter2"]
    assert home.seen(f"{home.folder}/.ssh/id_ed25519", ROS_PACKAGE_PATH=f"{home.folder}") == []


def is_shown(environment: Environment, path: str | Path) -> bool:
    """Whether runs of the environment are shown a path."""
    return interior.shown(str(path), recipe.visible_paths(environment))


def test_packages_that_are_installed_by_links_are_shown(home: Home) -> None:
    """As `colcon build --symlink-install` makes them, in the workspace itself and in one that it builds upon."""
    for name in ("ws", "underlay"):
        top = home.folder / name
        (top / "install" / INDEX).mkdir(parents=True)
        (top / "install/COLCON_IGNORE").touch()
        package = f"made_{name}"
        (top / "install" / INDEX / package).touch()
        (top / "src" / package).mkdir(parents=True)
        (top / "src" / package / "package.xml").write_text(f"<package><name>{package}</name></package>")
        (top / "install/share" / package).mkdir(parents=True)
        (top / "install/share" / package / "package.xml").symlink_to(top / "src" / package / "package.xml")
    environment = home.environment(AMENT_PREFIX_PATH=f"{home.folder}/underlay/install")
    for name in ("ws", "underlay"):
        assert is_shown(environment, home.folder / name / "install/share" / f"made_{name}" / "package.xml")
        assert is_shown(environment, home.folder / name / "src" / f"made_{name}" / "package.xml")
    assert not is_shown(home.environment(), home.folder / "underlay/install/share/made_underlay/package.xml")


def test_a_sourced_workspace_does_not_name_dot_folders(home: Home) -> None:
    """Its set-up script lists what may be a link by now."""
    modules = home.link("install/lib/python3/dist-packages", "../../../../.ssh")
    assert not is_shown(home.environment(PYTHONPATH=modules), f"{home.folder}/.ssh/id_ed25519")
    own = home.folder / ".modules"
    own.mkdir()
    assert is_shown(home.environment(PYTHONPATH=str(own)), own)


def test_the_users_interpreters_are_shown(home: Home) -> None:
    """Those of the PATH, wherever they are; not one that the workspace alone has."""
    versions = home.folder / ".pyenv/versions/3.11"
    for place in (versions / "bin", versions / "lib/python3.11", home.folder / "venv/bin", home.folder / ".local/lib"):
        place.mkdir(parents=True)
    python = versions / "bin/python3"
    python.touch(0o755)
    (home.folder / "venv/pyvenv.cfg").touch()
    (home.folder / "venv/bin/python3").symlink_to(python)
    script = home.package / "script"
    script.write_text(f"#!{home.folder}/venv/bin/python3\n")

    def shown(path: str) -> bool:
        environment = home.environment(PATH=path)
        asked = request(script)
        paths = recipe.request_paths(environment, asked, ros1_recipe.make(environment, asked))
        return all(interior.shown(str(place), paths) for place in (python, home.folder / "venv/bin/python3"))

    assert shown(f"{home.folder}/venv/bin:/usr/bin")
    assert not shown("/usr/bin")
    home.link("bin/python3", "../../venv/bin/python3")
    assert shown(f"{home.workspace}/bin:/usr/bin"), "it is theirs that they have there"
    (home.workspace / "bin/python3").unlink()
    home.link("bin/python3", "../../.ssh/id_ed25519")
    environment = home.environment(PATH=f"{home.workspace}/bin")
    assert not any(".ssh" in os.path.realpath(folder) for folder in environment.named_folders)


def test_our_own_interpreter_is_shown_with_what_it_was_made_from(home: Home, monkeypatch: pytest.MonkeyPatch) -> None:
    """A copy of one whose prefix is the home folder, of which nothing else is shown."""
    own = home.folder / ".ros-preflight"
    modules = home.folder / "lib/python3.11"
    for place in (own / "bin", modules):
        place.mkdir(parents=True)
    (own / "pyvenv.cfg").touch()
    (own / "bin/python3").touch(0o755)
    for name, value in (("executable", own / "bin/python3"), ("prefix", own), ("base_prefix", home.folder)):
        monkeypatch.setattr(sys, name, str(value))
    named = home.environment().named_folders
    shown = interior.needs_binding(reach.interpreter_paths(sys.executable))
    for place in (own / "bin/python3", own / "pyvenv.cfg", modules / "os.py"):
        assert any(interior.within(str(place), folder) for folder in named)
        assert interior.shown(str(place), shown)
    assert not interior.shown(f"{home.folder}/other/file.txt", shown)


def test_programs_of_the_path_have_all_that_they_need(home: Home) -> None:
    """As pipx installs xacro: a link to a script of a virtual environment."""
    place = home.folder / ".local/share/pipx/venvs/xacro"
    (place / "bin").mkdir(parents=True)
    (place / "pyvenv.cfg").touch()
    (place / "bin/python").symlink_to("/usr/bin/python3")
    script = place / "bin/xacro"
    script.write_text(f"#!{place}/bin/python\n")
    (home.folder / ".local/bin").mkdir()
    program = home.folder / ".local/bin/xacro"
    program.symlink_to(script)
    environment = home.environment(PATH=f"{home.folder}/.local/bin:/usr/bin")
    made = ros1_recipe.make_command(environment, str(program), (), "/")
    shown = recipe.command_paths(environment, made, str(program), (), "/usr/bin/python3")
    assert all(interior.shown(str(path), shown) for path in (program, script, place / "pyvenv.cfg"))
    assert not interior.shown(f"{home.folder}/.local/share/keyrings", shown)


AS_USER = """
import os, sys, tempfile
from pathlib import Path
sys.path[:0] = sys.argv[1:3]
from preflight_analysis.tracing import cgroup, compiled, sandbox
from test_hidden_folders import Home
folder = Path(sys.argv[3])
home = Home(folder)
os.environ.update(HOME=str(home.folder), XDG_CACHE_HOME=str(folder / "cache"))
share = home.link("install/share/k", "../../../.ssh")
(home.package / ".git").mkdir()
(home.package / ".git/config").write_text("hunter2")
paths = [f"{share}/id_ed25519", f"{home.folder}/.ssh/id_ed25519", f"{home.folder}/private/creds.txt"]
paths.append(f"{home.package}/.git/config")
assert home.seen(*paths) == []  # and all modules are loaded: where they lie may be shut to others
if os.geteuid() == 0:
    for place in (folder, *folder.rglob("*")):
        os.lchown(place, 65534, 65534)
    os.setgroups([])
    os.setgid(65534)
    os.setuid(65534)
    sys.executable = "/usr/bin/python3"
    sandbox.forget()
    cgroup.places.cache_clear()
    compiled.copies.cache_clear()
    os.environ["XDG_CACHE_HOME"] = str(folder / "users")
print(os.geteuid() != 0, sandbox.probe().backend, home.seen(*paths))
print("hunter2" in home.command(f"cat {home.folder}/.ssh/id_ed25519"))
"""


@pytest.mark.ros
@pytest.mark.parametrize("backend", [name for name in known_backends() if name != "firejail"])
def test_a_user_is_as_safe_as_root(backend: str) -> None:
    """firejail has a list of who may use it."""
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run(
            [sys.executable, "-c", AS_USER, *(str(path) for path in Path(__file__).parents[:2]), folder],
            capture_output=True,
            text=True,
            env={**os.environ, sandbox.CHOICE: backend},
            check=False,
        )
    assert done.stdout == f"True {backend} []\nFalse\n", done.stderr
