"""PRM005: a parameter of a node, or an argument of a node or process, names a file that is not there."""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import partial
from itertools import chain, compress

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import Location, Origin
from preflight_analysis.environment.git_ignored import is_ignored
from preflight_analysis.environment.installed_paths import located
from preflight_analysis.environment.model import Environment
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.ros2.unknown_text import is_unknown
from preflight_analysis.evaluation.tree import CommandValue, Include, LaunchNode, LaunchTree, Param, Use
from preflight_analysis.findings.claim import Subject
from preflight_analysis.findings.doubt import Doubt, Reason, doubts
from preflight_analysis.findings.finding import Finding, Fix, Related
from preflight_analysis.launch.model import action_at
from preflight_analysis.model.context import Context
from preflight_analysis.model.elsewhere import depends_on_working_folder
from preflight_analysis.model.files import address, meant_file, nearest_file, package_folder
from preflight_analysis.model.given_in_vain import others_in_vain
from preflight_analysis.model.installation import will_be_there
from preflight_analysis.model.installed import is_made_of_template, may_be_made
from preflight_analysis.model.meant import meant_values
from preflight_analysis.model.nearest import camel_words
from preflight_analysis.model.places import argument_location
from preflight_analysis.model.problems import include_chain, shown
from preflight_analysis.rules.further_reading import PARAMETERS, ROSLAUNCH_PARAM
from preflight_analysis.rules.missing_files import correct_path
from preflight_analysis.rules.rule import Rule
from preflight_analysis.tracing.request import split_args

_LONGEST = 4096
"""A path has fewer characters, a robot description has more."""
_EXTENSION = re.compile(r"\.[A-Za-z][A-Za-z0-9_]{0,9}\Z")
_PATTERN = re.compile(r"[*?!\[\]{}$%<>|&\"'()\s#]")
"""Characters of wildcards and of texts that are filled in later (`left_%04d.png`, `${NAME}.yaml`, `!!NOT_SET!!`)."""
_PACKAGE_URI = "package://"
_WRITTEN = frozenset(
    re.findall(
        r"\w+",
        "backup bag bags cache cached capture captured create database db debug dest destination dump dumped "
        "export exported generate generated history log logfile logger logging logs out outfile output "
        "outputs record recorded recorder recording report result results save saved saver snapshot stat "
        "statistics stats storage store stored target temp tmp trace warehouse write writer written ",
    )
)
"""Words in the name of a parameter, option, node or folder that say: this file is made when the node runs."""
_GENERATED = "gen"
"""Likewise in the name of an argument that hands the path on."""
_MADE_WHEN_RUN = (".bag", ".log", ".db", ".pid", ".sock", ".sqlite", ".tmp")
_FETCHED = frozenset(
    re.findall(
        r"\S+",
        ".7z .avi .caffemodel .engine .gz .h5 .hdf5 .jpg .las .laz .mp4 .npy .npz .onnx .otf .pb .pcd .pkl .ply .pt "
        ".pts .pth .tar .tflite .trt .ttf .wav .weights .zip",
    )
)
"""Models, recordings and the like, which are mostly fetched when the package is built or on first use."""
_FETCHED_FOLDERS = frozenset(("dataset", "datasets", "trained_data", "weights"))
_CALIBRATION = "camera_info_url"
"""What drivers call the file with a camera's calibration, which they go on without, and camera_info_manager writes
(http://wiki.ros.org/camera_info_manager)."""
_MOST_STEPS = 20
_VERBS = 3
"""Words of a command line that say what it does (`ros2 run nav2_map_server map_saver_cli`)."""


@dataclass(frozen=True, slots=True)
class _Named:
    """A text that may name files: `what` it is for people, and where it is given, looked up only if need be."""

    text: str
    what: str
    location: Callable[[], Location]
    origin: Origin


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    values: Mapping[Location, list[Use]] | None = None
    for named in chain(_in_params(context), _in_arguments(context), _in_includes(context), _apart_from_folder(context)):
        for path in _missing(named.text, context):
            values = _argument_uses(context.tree) if values is None else values
            given = named.location()
            location, arguments = _where_written(context, given, path, values)
            if any(_made_when_run(name) or _GENERATED in name.split("_") for name in arguments):
                continue
            related = include_chain((*named.origin[:-1], location))
            if location != given:
                related = (Related(f"{named.what} is set here", given), *related)
            near = nearest_file(context.disk, path, context.environment)
            hint = meant_file(context, path, near)
            fixes: tuple[Fix, ...] = correct_path(context, location, path, near) if near is not None else ()
            against: tuple[Doubt, ...] = ()
            if near is None and _is_fetched(path):
                against, hint = doubts(MADE_ELSEWHERE=True), "; fetch it first"
            elif (near is None or not _is_beside(near, path)) and is_ignored(context.disk, path):
                against, fixes = doubts(MADE_ELSEWHERE=True), ()
                hint = "; git ignores it, so each machine may create it"
            elif near is None and depends_on_working_folder(context, location):
                against = doubts(WHERE_STARTED=True)
                hint = "; the path depends on the folder where the launch is started"
            elif near is None and _CALIBRATION in named.what:
                against, hint = doubts(MADE_ELSEWHERE=True), "; the calibration of the camera creates it"
            elif near is None and (others := others_in_vain(context, location, path)):
                against = doubts(MADE_ELSEWHERE=True)
                hint = f"; {others} other packages set missing files for it too, so a node may create it"
            elif near is None and may_be_made(context, path):
                against, hint = doubts(MADE_BY_BUILD=True), "; the build of the package may create it"
            message = f"file '{shown(path, context)}' in {named.what} does not exist{hint}"
            yield rule.claim(
                message,
                location,
                subject=Subject("file", path),
                kind="absent" if near is None else "near",
                doubts=against,
                candidates=(near,),
                related=related,
                fixes=fixes,
            )


def _is_beside(near: str, path: str) -> bool:
    """Whether a file of the same kind is in the same folder as another: one in another folder, or with another ending,
    tells less than that git ignores the path."""
    same_kind = os.path.splitext(near)[1] == os.path.splitext(path)[1]
    return same_kind and os.path.dirname(near) == os.path.dirname(path)


def _in_params(context: Context) -> Iterator[_Named]:
    params = context.tree.all_params
    texts_of_each = context.each(_texts_of_param, params)
    found = zip(compress(params, texts_of_each), filter(None, texts_of_each), strict=True)
    of_nodes = context.each(_texts_of_params, context.tree.nodes)
    for param, texts in chain(found, chain.from_iterable(of_nodes)):
        command = isinstance(param.value, CommandValue)
        what = "the command" if command else f"parameter '{param.name.rpartition('/')[2]}'"
        place = partial(_value_location, context, param, "command" if command else "value")
        yield from (_Named(text, what, place, param.origin) for text in texts)


def _texts_of_params(node: LaunchNode) -> tuple[tuple[Param, tuple[str, ...]], ...]:
    """Those of the parameters that a node of ROS 2 gets, each with its texts."""
    return tuple((param, texts) for param in node.params if (texts := _texts_of_param(param)))


def _texts_of_param(param: Param) -> tuple[str, ...]:
    """The texts in the value of a parameter that may name files, there or not: nearly none has any."""
    value = param.value
    if isinstance(value, CommandValue):
        return split_args(value.command)[1:]
    if isinstance(value, str):
        texts = [value] if "/" in value else ()
    elif isinstance(value, list):
        texts = [text for text in value if isinstance(text, str)]
    else:
        return ()
    if not any("." in text and "/" in text for text in texts):
        return ()
    if _made_when_run(names.leaf(param.name)) or _made_when_run(names.leaf(param.owner or "")):
        return ()
    return tuple(text for text in texts if len(text) < _LONGEST and "\n" not in text)


def _in_arguments(context: Context) -> Iterator[_Named]:
    nodes = context.tree.nodes
    texts_of_each = context.each(_texts_of_arguments, nodes)
    for node, texts in compress(zip(nodes, texts_of_each, strict=True), texts_of_each):
        if not _elsewhere(context.tree, node):
            what = f"the arguments of '{node.executable}'"
            for text in texts:
                yield _Named(text, what, partial(argument_location, context, node, text), node.origin)


def _texts_of_arguments(node: LaunchNode) -> tuple[str, ...]:
    """The words in the arguments of a node that may name files, there or not."""
    if "/" not in node.args or node.unknowns:
        return ()
    if _made_when_run(node.executable) or _made_when_run(names.leaf(node.name)):
        return ()
    words = split_args(node.args)
    if node.kind == "process" and any(map(_made_when_run, words[:_VERBS])):
        return ()
    found: list[str] = []
    before = ""
    for word in words:
        option, _, value = word.rpartition("=")
        option = option or (before if before.startswith("-") else "")
        before = word
        if option not in ("-o", "-O") and not _made_when_run(option):
            found.append(value)
    return tuple(found)


def _in_includes(context: Context) -> Iterator[_Named]:
    """What is passed to files that cannot be read: nobody sees what they do with it."""
    for include in context.tree.includes:
        if include.path is not None and include.path in context.launch_files:
            continue
        for name, value in include.args.items():
            if value is not None and "/" in value and not any(map(_made_when_run, (name, os.path.basename(value)))):
                place = partial(_passed_at, context, include, name)
                yield _Named(value, f"argument '{name}' of an include", place, include.origin)


def _passed_at(context: Context, include: Include, name: str) -> Location:
    launch_file = context.launch_files.get(include.file_location.file)
    action = action_at(launch_file, include.origin[-1].span.start + 1) if launch_file is not None else None
    for child in action.children if action is not None else ():
        named, value = child.value("name"), child.value("value")
        if named is not None and value is not None and named.text == name:
            return context.location(include.file_location.file, value.span)
    return include.file_location


def _apart_from_folder(context: Context) -> Iterator[_Named]:
    """Files whose folder is another argument, by what is known of the node."""
    for node, values in meant_values(context):
        for each in values:
            is_file = each.meaning.kind == "file" and each.meaning.folder and each.param is None
            if is_file and isinstance(each.value, str) and not _elsewhere(context.tree, node):
                place = partial(argument_location, context, node, os.path.basename(each.value))
                yield _Named(each.value, f"the arguments of '{node.executable}'", place, node.origin)


def _elsewhere(tree: LaunchTree, node: LaunchNode) -> bool:
    """Whether the node runs on another machine, which has its own files."""
    machine = tree.machines.get(node.machine or "")
    return machine is not None and machine.address not in ("localhost", "127.0.0.1")


def _made_when_run(name: str) -> bool:
    return any(word in _WRITTEN for word in camel_words(name))


def _missing(text: str, context: Context) -> Iterator[str]:
    """The files that `text` names and that should be there: below a package or the workspace, with an extension."""
    if text.startswith("/") and context.disk.exists(text):
        return
    if is_unknown(text):
        return
    for path in _paths(text, context.environment):
        extension = _EXTENSION.search(path)
        if extension is None or extension[0].lower() in _MADE_WHEN_RUN or _PATTERN.search(path):
            continue
        normal = os.path.normpath(path)
        if normal in context.documents or normal in context.tree.written:
            continue
        if context.disk.exists(located(context.disk, context.environment, normal)):
            continue
        share = package_folder(normal, context.environment)
        workspace = context.environment.workspace
        inside = str(share) if share is not None else workspace
        if inside is None or not normal.startswith(inside.rstrip("/") + "/"):
            continue
        below = normal[len(inside) :]
        made = _made_when_run(below) or _is_built(below, inside, context) or is_made_of_template(context, normal)
        if not made and not will_be_there(context, normal):
            yield normal


def _is_fetched(path: str) -> bool:
    folders = os.path.dirname(path).split("/")
    return os.path.splitext(path)[1].lower() in _FETCHED or not _FETCHED_FOLDERS.isdisjoint(folders)


def _is_built(below: str, share: str, context: Context) -> bool:
    """Whether the package's CMakeLists.txt speaks of the file: then building the package makes it."""
    executables = context.executables
    package = next((p.name for p in context.environment.packages.values() if p.share.rstrip("/") == share), None)
    return executables is not None and package is not None and executables.is_in_build_file(package, below.strip("/"))


def _paths(text: str, environment: Environment) -> Iterable[str]:
    named = address(environment, text)
    if text.startswith(_PACKAGE_URI):
        return (named.path,) if named is not None and named.path is not None else ()
    plain = text.removeprefix("file://")
    pieces = plain.replace(";", ",").replace(":", ",").split(",") if "/" in plain else ()
    return [piece for piece in pieces if piece.startswith("/")]


def _value_location(context: Context, param: Param, attribute: str) -> Location:
    """The value in the launch file; the key, for one that a YAML text gives."""
    tag = param.origin[-1]
    launch_file = context.launch_files.get(tag.file)
    action = action_at(launch_file, tag.span.start + 1) if launch_file is not None else None
    if action is not None and action.kind.lower() == "param" and (value := action.value(attribute)) is not None:
        return context.location(tag.file, value.span)
    return param.name_location or tag


def _argument_uses(tree: LaunchTree) -> Mapping[Location, list[Use]]:
    """The uses of arguments by the place of the whole value they stand in, and with it what that came to."""
    found: dict[Location, list[Use]] = {}
    pending: list[Use] = []
    for use in tree.uses:
        if use.kind == "arg":
            pending.append(use)
        elif use.kind == "value":
            # The parts of a value are noted right before the value itself.
            found.setdefault(use.location, []).extend(pending)
            pending = []
    return found


def _where_written(
    context: Context, at: Location, path: str, uses: Mapping[Location, list[Use]]
) -> tuple[Location, tuple[str, ...]]:
    """The place that has the file's name, or makes it: from `at` back over the arguments that gave the value, with
    their names."""
    name = os.path.basename(path)
    place, seen = at, set[Location]()
    arguments: tuple[str, ...] = ()
    while place not in seen and len(seen) < _MOST_STEPS:
        seen.add(place)
        document = context.documents.get(place.file)
        if document is None or name in document.text[place.span.start : place.span.end]:
            return place, arguments
        use = next((u for u in uses.get(place, ()) if u.origin and u.value is not None and name in u.value), None)
        launch_file = context.launch_files.get(use.origin[-1].file) if use is not None else None
        if use is None or launch_file is None:
            return place, arguments
        action = action_at(launch_file, use.origin[-1].span.start)
        value = (action.value("value") or action.value("default")) if action is not None else None
        if value is None:
            return place, arguments
        place, arguments = launch_file.document.location(value.span), (*arguments, use.name)
    return at, arguments


RULE = Rule(
    id="PRM005",
    name="file-in-parameter-not-found",
    effect="misbehaves",
    kind="absent",
    always=(Reason.UNSEEN,),
    sometimes=(Reason.MADE_ELSEWHERE, Reason.MADE_BY_BUILD, Reason.WHERE_STARTED),
    what="Checks for a file that does not exist in the value of a parameter, the arguments of a node or a command. "
    "Names of files that are written (`output`, `log`, `record`, ...) and patterns are ignored.",
    why="The launcher does not check the value. The node exits when it opens the file, or continues without it: a "
    "planner without its limits.",
    example='<param name="limits_file" value="$(find arm)/config/limits.yaml"/>',
    instead='<param name="limits_file" value="$(find arm)/config/planner/limits.yaml"/>',
    references=(
        ROSLAUNCH_PARAM,
        PARAMETERS,
    ),
    check=_check,
    in_branches=True,
)
