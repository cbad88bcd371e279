"""Which distributions of ROS a workspace is for, by what it says of itself. Where none is sourced or installed, what is
known of packages is known of that one; where another is, what is said may not hold on the robot.

Sources, the first that names one distribution and no other counts: `distribution:` in the settings file; images of
containers; workflows of CI; scripts and read-me files; the words of these, such as "ROS Kinetic"; files of folders
further below; the branch that is checked out; conditions in package.xml (REP 149); the packages that it needs, where
one distribution alone has released all of them.
"""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Collection, Iterable, Iterator
from typing import NamedTuple

import yaml

from preflight_analysis.catalogue.released import DISTRIBUTIONS, distributions_with
from preflight_analysis.documents.reading import Text, read_text
from preflight_analysis.documents.yaml import CONSTRUCTION_ERRORS, compose
from preflight_analysis.environment.model import Package

SETTING = "distribution"
"""The key of the settings file."""
_OLDER = {1: ("groovy", "hydro", "jade", "lunar"), 2: ("crystal", "dashing", "eloquent")}
"""Of which no packages are known."""
_DEPTH = 3
_MOST_FILES = 100
_MOST_ENTRIES = 5000
"""How deep, and how much, is looked at."""
_LONGEST = 1 << 16
_HIDDEN = (".devcontainer", ".docker", ".github", ".circleci", "workflows")
_IMAGES = re.compile(
    r"(?i)(?:.*[._-])?(?:dockerfile|containerfile)(?:[._-].*)?\Z|(?:docker-?)?compose.*\.ya?ml\Z|devcontainer\.json\Z"
)
_CI = re.compile(r"(?i)\.?(?:gitlab-ci|travis|appveyor|azure-pipelines)\.ya?ml\Z|Jenkinsfile\Z")
_SCRIPTS = re.compile(r"(?i).*\.(?:sh|bash|zsh|repos)\Z|makefile\Z|justfile\Z|readme.*\Z|install.*\.md\Z")
_KINDS = (_IMAGES, _CI, _SCRIPTS)
"""In the order in which they count."""
_OWN = 2
"""So deep are the files of the workspace itself: `docker/Dockerfile`."""


class Stated(NamedTuple):
    """A distribution, and what says so: a file relative to the workspace, or words."""

    name: str
    by: str


class Statements(NamedTuple):
    """What a workspace says: the one distribution that it is for, and all that it may be for, sorted."""

    one: Stated | None = None
    all: tuple[str, ...] = ()


def known_distributions(generation: int) -> tuple[str, ...]:
    """The names of the distributions of a generation of ROS."""
    return (*_OLDER[generation], *DISTRIBUTIONS[generation])


def stated_distributions(
    workspace: str | None, settings: str, built: Collection[str], packages: Collection[Package], generation: int
) -> Statements:
    """What a workspace says of itself. `packages` are its own, `built` the
    names of folders that its build makes. Nothing is run, and no link is followed. Never raises."""
    if workspace is None:
        return Statements()
    names = known_distributions(generation)
    setting = _of_settings(os.path.join(workspace, settings))
    if setting in names:
        return Statements(Stated(setting, settings), (setting,))
    files = [(os.path.relpath(path, workspace), _text(path)) for path in _files(workspace, built)]
    said, named = _pattern(names, _COMMANDS), _pattern(names, _WORDS)
    own = [(path, text) for path, text in files if _depth(path) < _OWN]
    groups = [
        *({name: path for path, text in own if _kind(path) is kind for name in said(text)} for kind in _KINDS),
        {name: path for path, text in own for name in named(text)},
        # Below are copies of other projects, too: there all have to agree.
        {name: path for path, text in files for name in said(text)},
    ]
    one = next((Stated(*found) for group in groups if len(group) == 1 for found in group.items()), None)
    one = one or _branch(workspace, names) or _of_manifests(packages, names, generation)
    every = {name for group in groups[:-1] for name in group} or {*groups[-1]} or ({one.name} if one else set())
    return Statements(one, tuple(sorted(every)))


def _of_settings(path: str) -> str:
    try:
        document = compose(_text(path))
    except CONSTRUCTION_ERRORS:
        return ""
    entries = document.value if isinstance(document, yaml.MappingNode) else ()
    return next((str(value.value) for key, value in entries if key.value == SETTING), "")


def _text(path: str) -> str:
    found = read_text(path)
    return found.text[:_LONGEST] if isinstance(found, Text) else ""


def _kind(path: str) -> re.Pattern[str] | None:
    """Of which kind a file is that may say it."""
    if ".github" in path.split(os.sep):
        return _CI
    return next((each for each in _KINDS if each.match(os.path.basename(path))), None)


def _depth(path: str) -> int:
    """How deep below the workspace; folders of tools are no depth."""
    return sum(not folder.startswith(".") and folder != "workflows" for folder in os.path.dirname(path).split(os.sep))


def _files(workspace: str, built: Collection[str]) -> Iterator[str]:
    """The files that may say it, those of the upper folders first."""
    pending, seen, given = [(workspace, 0)], 0, 0
    while pending:
        folder, depth = pending.pop(0)
        try:
            with os.scandir(folder) as entries:
                found = sorted(entries, key=lambda entry: entry.name)
        except OSError:
            continue
        for entry in found:
            seen += 1
            if seen > _MOST_ENTRIES or given > _MOST_FILES:
                return
            if entry.is_symlink():
                continue
            if entry.is_dir():
                hidden = entry.name.startswith(".") and entry.name not in _HIDDEN
                if depth < _DEPTH and not hidden and entry.name not in built:
                    pending.append((entry.path, depth + 1))
            elif _kind(entry.path) is not None:
                given += 1
                yield entry.path


_COMMANDS = (
    r"[\w./-]*ros[\w./-]*:NAME",  # an image: osrf/ros:humble-desktop
    r"/opt/ros/NAME",
    r"(?i:ros2?[_-]?distr(?:o|ibution)s?)\W{1,6}NAME",  # a variable, or what a workflow's action is given
    r"\bros-NAME(?=-[a-z])",  # a package of Ubuntu
)
_WORDS = (r"(?i)\bros[ \t]?[12]?[ \t_]*[*`\"'(\[]{0,3}NAME",)
"""As people write it: `ROS Kinetic`, `ROS 2 (Humble)`."""


def _pattern(names: Collection[str], ways: Collection[str]) -> Callable[[str], set[str]]:
    """What gives the distributions that a text speaks of, in small letters."""
    any_name = f"({'|'.join(names)})"
    patterns = [re.compile(each.replace("NAME", any_name) + r"(?![a-z])") for each in ways]
    return lambda text: {found[1].lower() for each in patterns for found in each.finditer(text)}


def _branch(workspace: str, names: Collection[str]) -> Stated | None:
    head = _text(os.path.join(workspace, ".git", "HEAD")).partition("refs/heads/")[2].strip()
    found = [name for name in names if name in re.split(r"[^a-z]+", head.lower())]
    return Stated(found[0], f"the branch '{head}'") if len(found) == 1 else None


def _of_manifests(packages: Iterable[Package], names: Collection[str], generation: int) -> Stated | None:
    packages = [*packages]
    condition = re.compile(rf"\$ROS_DISTRO\s*==\s*['\"]?({'|'.join(names)})\b")
    asked = {found[1]: package.name for package in packages for found in condition.finditer(_text(package.manifest))}
    if len(asked) == 1:
        name, package = next(iter(asked.items()))
        return Stated(name, f"package.xml of {package}")
    needed = {each for package in packages for each in package.dependencies} - {package.name for package in packages}
    having = [found for each in sorted(needed) if (found := frozenset(distributions_with(each, generation)))]
    left = [
        frozenset[str](DISTRIBUTIONS[generation]).intersection(*having[:at], *having[at + 1 :])
        for at in range(len(having))
    ]
    # Whatever a single one of them says: some are written down wherever they are to be had.
    if left and len(left[0]) == 1 and len({*left}) == 1:
        return Stated(next(iter(left[0])), "the packages that it needs")
    return None
