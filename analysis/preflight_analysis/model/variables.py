"""Where a launch sets an environment variable of a process."""

from __future__ import annotations

from collections.abc import Iterator

from preflight_analysis.documents.span import Location
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.launch.model import NODE_KINDS, Action, Value
from preflight_analysis.model.context import Context

_SETS = ("set_env", "append_env")


def setting_of(context: Context, process: LaunchNode | None, variable: str) -> Location | None:
    """The value of the variable in the node's own tag, else in the tag around or before it that sets it; None where it
    is not known which one does."""
    if process is None or (wanted := dict(process.env).get(variable)) is None:
        return None
    own = next((value for child in process.action.children for value in _given(child, ("env",), variable)), None)
    if own is not None:
        return context.location(process.location.file, own.span)
    found = []
    for path in dict.fromkeys(place.file for place in reversed(process.origin)):
        launch_file = context.launch_files.get(path)
        if launch_file is not None and launch_file.root is not None:
            found += [(path, value) for value in _settings(launch_file.root, variable)]
    alike = [each for each in found if each[1].text == wanted] if len(found) > 1 else found
    return context.location(alike[0][0], alike[0][1].span) if len(alike) == 1 else None


def _settings(around: Action, variable: str) -> Iterator[Value]:
    kinds = _SETS if around.kind in NODE_KINDS or around.kind == "executable" else (*_SETS, "env")
    for child in around.children:
        yield from _given(child, kinds, variable)
        yield from _settings(child, variable)


def _given(action: Action, kinds: tuple[str, ...], variable: str) -> Iterator[Value]:
    name, value = action.value("name"), action.value("value")
    if action.kind in kinds and name is not None and name.text == variable and value is not None:
        yield value
