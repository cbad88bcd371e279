"""Programs that come along with the analysis, for where those of ROS are not installed."""

from __future__ import annotations

import re
from collections.abc import Sequence

OWN_PROGRAMS = frozenset({"xacro"})
"""By the names that launch files call them."""
_INSTALLED = re.compile(r"/opt/ros/\w+/(?:bin|lib/(\w+))/(\w+)\Z")
_NOWHERE = "preflight-not-installed"
OLD_XACRO = "preflight-xacro.py"
"""Our own one in the place of `xacro.py` of ROS Melodic and before, which reads tags without `xacro:` too."""
_BELOW_PREFIX = re.compile(rf"\A\s*/{_NOWHERE}/(\w+)/(?:bin|lib/\1)/\1(?=[\s'\"]|\Z)")


def own_program(text: str, find: str, package: str) -> str | None:
    """A command line that begins with `$(find package)/program`, of a package that is not here, as it calls our own
    program, which has the name of its package, or that and `.py` (`OLD_XACRO`). None for anything else."""
    if package not in OWN_PROGRAMS:
        return None
    program = re.match(rf"\s*{re.escape(find)}/{package}(\.py)?(?=[\s'\"]|$)", text)
    return (OLD_XACRO if program[1] else package) + text[program.end() :] if program is not None else None


def own_prefix(package: str) -> str:
    """What stands for the prefix of a package that is not here, in a command line that may call our own program."""
    return f"/{_NOWHERE}/{package}"


def without_own_prefix(line: str) -> str | None:
    """A command line that begins with a program below `own_prefix`, as it calls our own program of that name; the line
    itself where there is no such prefix. None where the prefix stands for something else."""
    found = _BELOW_PREFIX.sub(r"\1", line, count=1)
    return found if _NOWHERE not in found else None


def own_arguments(words: Sequence[str]) -> Sequence[str] | None:
    """The arguments of our own program in a command line whose program is not here: `xacro a`, `ros2 run xacro xacro
    a`, `/opt/ros/jazzy/bin/xacro a`. None where it calls another one."""
    match words:
        case ["ros2", "run", package, name, *arguments] if package == name and name in OWN_PROGRAMS:
            return arguments
        case [program, *arguments] if program == OLD_XACRO:
            return arguments
        case [program, *arguments]:
            installed = _INSTALLED.match(program)
            name = installed[2] if installed is not None and installed[1] in (None, installed[2]) else program
            return arguments if name in OWN_PROGRAMS else None
    return None
