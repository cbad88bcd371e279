"""LCH021: a path that exists on one machine."""

from __future__ import annotations

import re
from collections.abc import Iterator

from preflight_analysis.documents.span import Span
from preflight_analysis.findings.claim import Effect, Subject
from preflight_analysis.findings.finding import Finding
from preflight_analysis.incremental.derived import derived
from preflight_analysis.launch.model import Action, LaunchFile, Literal, Value
from preflight_analysis.model.context import Context
from preflight_analysis.model.files import in_named_package
from preflight_analysis.model.problems import replacement
from preflight_analysis.rules.further_reading import ANONYMOUS_NAMES, FILE_SYSTEM, LAUNCH_SUBSTITUTIONS
from preflight_analysis.rules.rule import Rule

_HOME = re.compile(r"(?:/home/[^/]+|/Users/[^/]+|/root)/|~")
_ROS = re.compile(r"/opt/ros/[a-z]+/")
_END = r"[^\s'\":;,<>|)]*"
_ABSOLUTE = re.compile(rf"(?:(?<=file://)|(?<![\w./$)}}-]))/(?!/){_END}")
_TILDE = re.compile(rf"(?<![^\s'\":;,=])~[a-z_][\w-]*/{_END}\.[A-Za-z]\w*")
_NOT_PATHS = frozenset(
    ("name", "ns", "to", "pkg", "type", "test-name", "doc", "deprecated", "if", "unless", "machine", "param")
)
_NOT_PATHS_ROS2 = frozenset(("namespace", "exec", "plugin", "target", "description", "message", "reason"))
_SYSTEM = ("/usr/", "/etc/", "/opt/", "/dev/", "/tmp/", "/proc/", "/sys/", "/var/", "/run/", "/bin/", "/lib/")  # noqa: S108


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    for path, launch_file in context.launch_files.items():
        for start, text in _absolute_paths(launch_file):
            what = _what(text, context)
            if what is None:
                continue
            location = context.location(path, Span(start, start + len(text)))
            in_package = _in_package(text, context)
            fixes = replacement(context, location, in_package, f"Replace with '{in_package}'") if in_package else ()
            instead = f"; use '{in_package}'" if in_package else ""
            yield rule.claim(
                f"hard-coded path '{text}': {what}{instead}",
                location,
                subject=Subject("file", text),
                effect=_effect(context, text, in_package),
                candidates=(in_package,),
                fixes=fixes,
            )


@derived
def _absolute_paths(launch_file: LaunchFile) -> tuple[tuple[int, str], ...]:
    """What is written like an absolute path where a path may stand, outside of substitutions, with its offset."""
    if launch_file.root is None:
        return ()
    text = launch_file.document.text
    return tuple(found for value in launch_file.root.gather(_with_slashes) for found in _paths_in(value, text))


def _with_slashes(action: Action) -> Iterator[Value]:
    # What a <machine> says are paths over there.
    if action.kind not in ("machine", "remap"):
        for name, _, value, _ in action.attributes:
            if "/" in value.text and name not in _NOT_PATHS and name not in _NOT_PATHS_ROS2:
                yield value


def _paths_in(value: Value, document: str) -> Iterator[tuple[int, str]]:
    for part in value.parts:
        if not isinstance(part, Literal):
            continue
        written = document[part.span.start : part.span.end]
        # What follows a substitution directly is the rest of its path.
        follows = part.span.start > value.span.start
        for pattern in (_TILDE, _ABSOLUTE):
            for match in pattern.finditer(written):
                if len(match[0]) > 1 and not (follows and match.start() == 0):
                    yield part.span.start + match.start(), match[0]


def _what(text: str, context: Context) -> str | None:
    """What makes the path one of this machine alone; None for all others, and for names that look like paths."""
    if _HOME.match(text) or text.startswith("~"):
        return "it is in the home folder of one user, and missing on other machines"
    if _ROS.match(text):
        return "it exists with one distribution of ROS only"
    workspace = context.environment.workspace
    if workspace and text.startswith(workspace.rstrip("/") + "/") and context.disk.exists(text):
        return "the workspace has this path on this machine only"
    if not text.startswith(_SYSTEM) and context.disk.is_file(text) and _in_package(text, context):
        return "the package has this path on this machine only"
    return None


def _effect(context: Context, text: str, in_package: str | None) -> Effect:
    """A path that leads nowhere, to a file that is here under another path, is more than a matter of style."""
    if in_package and not context.disk.exists(text):
        return "misbehaves"
    return "style" if _ROS.match(text) else "note"


def _in_package(text: str, context: Context) -> str | None:
    """The same file by `$(find ...)`, if the path has the folder of a known package in which that file exists."""
    packages = context.environment.packages
    find = context.tree.ros.find
    for package in packages.values():
        share = package.share.rstrip("/")
        if text.startswith(share + "/"):
            return f"$({find} {package.name}){text[len(share) :]}"
    named = in_named_package(context.disk, text, context.environment)
    return f"$({find} {named[0].name})/{named[1]}" if named is not None else None


RULE = Rule(
    id="LCH021",
    name="hard-coded-path",
    effect="note",
    kind="invalid",
    sometimes=("misbehaves", "style"),
    what="Checks for absolute paths in attributes: below `/home/...`, `/Users/...`, `/root`, `~user` and "
    "`/opt/ros/...`, or into the workspace. `<machine>` is not checked.",
    why="The launch file works only for its author. For other users, on the robot, or after an upgrade of ROS the "
    "path does not exist.",
    example='<param name="model" value="/home/bob/catkin_ws/src/vision/models/net.pt"/>',
    instead='<param name="model" value="$(find vision)/models/net.pt"/>',
    references=(
        ANONYMOUS_NAMES,
        LAUNCH_SUBSTITUTIONS,
        FILE_SYSTEM,
    ),
    check=_check,
)
