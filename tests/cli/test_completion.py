"""Completion in real shells."""

from __future__ import annotations

import os
import shutil
import subprocess
from collections.abc import Callable
from typing import Any

import pytest
from support.editor_harness import Harness

pytestmark = pytest.mark.ros
Run = Callable[..., Any]

# What bash does at a press of the Tab key, for the line in $LINE.
BASH = """
eval "$(ros-preflight completion bash)"
COMP_LINE=$LINE COMP_POINT=${#LINE} COMP_TYPE=9 COMP_KEY=9
read -ra COMP_WORDS <<<"$LINE"
[ "${LINE: -1}" = " " ] && COMP_WORDS+=("")
COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
_python_argcomplete ros-preflight "${COMP_WORDS[COMP_CWORD]}"
printf '%s\\n' "${COMPREPLY[@]}"
"""
FISH = 'ros-preflight completion fish | source; complete --do-complete "$LINE"'
ZSH = """
autoload -Uz compinit && compinit -u -D
eval "$(ros-preflight completion zsh)"
print -- $_comps[ros-preflight]
"""


def in_shell(harness: Harness, program: list[str], line: str) -> list[str]:
    found = shutil.which(program[0])
    assert found is not None, f"{program[0]} is missing: make apt"
    path = os.pathsep.join([str(harness.server.parent), "/usr/bin", "/bin"])
    done = subprocess.run(
        [found, *program[1:]],
        cwd=harness.workspace,
        env={**harness.environment, "PATH": path, "LINE": line},
        capture_output=True,
        text=True,
        timeout=60,
        check=True,
    )
    return [each.split("\t")[0].rstrip() for each in done.stdout.splitlines() if each.strip()]


def bash(harness: Harness, line: str) -> list[str]:
    return in_shell(harness, ["bash", "--norc", "-c", BASH], line)


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ("ros-preflight ch", {"check"}),
        ("ros-preflight check --form", {"--format"}),
        ("ros-preflight check --paths ", {"absolute", "relative", "cwd"}),
        ("ros-preflight explain TOP00", {f"TOP00{number}" for number in range(1, 9)}),
        ("ros-preflight check launch/fi", {"launch/fixed.launch"}),
    ],
)
def test_bash(harness: Harness, line: str, expected: set[str]) -> None:
    assert set(bash(harness, line)) >= expected


def test_the_arguments_of_a_launch_file(harness: Harness) -> None:
    harness.launch_file.write_text("<launch><arg name='camera' default='x'/><arg name='arm'/></launch>")
    assert bash(harness, "ros-preflight tree launch/talker_listener.launch ca") == ["camera:="]
    assert harness.sandbox_starts() == 0


def test_fish(harness: Harness) -> None:
    assert in_shell(harness, ["fish", "--private", "-c", FISH], "ros-preflight ch") == ["check"]


def test_zsh_takes_the_function(harness: Harness) -> None:
    assert in_shell(harness, ["zsh", "-f", "-c", ZSH], "") == ["_python_argcomplete"]


def test_other_shells_are_refused(preflight: Run) -> None:
    assert preflight("completion", "csh").code == 2
