"""Where a YAML file has the value of a parameter that a Python launch file loaded itself and handed on as a dictionary.

`MoveItConfigsBuilder` and the `load_yaml` of many launch files do so: launch knows the value and not the file.
"""

from __future__ import annotations

import os
from collections.abc import Iterator

import yaml

from preflight_analysis.documents.disk import Disk
from preflight_analysis.documents.document import Document
from preflight_analysis.documents.reading import Unreadable
from preflight_analysis.documents.span import Location, Span
from preflight_analysis.documents.yaml import CONSTRUCTION_ERRORS, compose_fast, constructed
from preflight_analysis.evaluation.tree import Param
from preflight_analysis.evaluation.value_places import value_place
from preflight_analysis.model.context import Context

_FOLDER = "config"
_YAML = (".yaml", ".yml")
_MOST_FILES = 200


def place_in_yaml(context: Context, param: Param, value: str = "") -> Location:
    """Where `value` is written, or else the name of the parameter: in its own file, else in the one file in the folder
    `config` of a package of the workspace that has the parameter with its value, of the package of the launch file
    first; else what sets it."""
    own = value_place(param.place, value, context.documents.get(param.place.file)) if value else None
    if own is not None or param.place.file.endswith(_YAML):
        return own or param.place
    packages = [each for each in context.environment.packages.values() if each.is_within(context.environment.workspace)]
    near = [each for each in packages if param.place.file.startswith(f"{each.share}/")]
    for group in (near, [each for each in packages if each not in near]):
        found = [at for each in group for at in _in_folder(context.disk, each.share, param, value)]
        if found:
            return found[0] if len(found) == 1 else param.place
    return param.place


def _in_folder(disk: Disk, share: str, param: Param, value: str) -> Iterator[Location]:
    folder = os.path.join(share, _FOLDER)
    top = [os.path.join(folder, name) for name in disk.names(folder)]
    below = [os.path.join(each, name) for each in top if not each.endswith(_YAML) for name in disk.names(each)]
    for path in [each for each in (*top, *below) if each.endswith(_YAML)][:_MOST_FILES]:
        found = disk.text(path)
        if isinstance(found, Unreadable):
            continue
        at = _place(found, param)
        if at is not None:
            yield value_place(at, value, found) or at


def _place(document: Document, param: Param) -> Location | None:
    """The key of the parameter, whose name has what is above the file's keys before."""
    if param.name.rpartition(".")[2] not in document.text:
        return None
    try:
        root = compose_fast(document.text)
        return _below(document, root, param)
    except CONSTRUCTION_ERRORS:
        return None


def _below(document: Document, root: yaml.Node | None, param: Param) -> Location | None:
    words = param.name.split(".")
    for start in range(len(words)):
        node, key = root, None
        for word in words[start:]:
            pairs = node.value if isinstance(node, yaml.MappingNode) else ()
            key, node = next(((k, v) for k, v in pairs if k.value == word), (None, None))
            if node is None:
                break
        if key is not None and node is not None:
            if constructed(node) != param.value:
                return None
            return document.location(Span(key.start_mark.index, key.end_mark.index))
    return None
