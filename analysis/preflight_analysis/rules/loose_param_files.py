"""Parameter files that no node of a launch gets, which may be given to some node all the same: a program rewrites them,
an argument names them, the launch file could not be followed."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator, Mapping
from pathlib import PurePath

import yaml

from preflight_analysis.documents.disk import Disk
from preflight_analysis.documents.document import Document
from preflight_analysis.documents.span import Span
from preflight_analysis.documents.yaml import CONSTRUCTION_ERRORS, compose_fast, span_of
from preflight_analysis.environment.installed_paths import package_around
from preflight_analysis.environment.package_files import files_in
from preflight_analysis.evaluation.ros2.param_files import MARK, read_param_file
from preflight_analysis.evaluation.yaml_params import YamlError, load_yaml
from preflight_analysis.findings.claim import Subject, say
from preflight_analysis.findings.doubt import doubts
from preflight_analysis.findings.finding import Finding, Related
from preflight_analysis.incremental.database import Database
from preflight_analysis.incremental.derived import derived
from preflight_analysis.incremental.query import query
from preflight_analysis.model.context import Context
from preflight_analysis.model.name_index import named_in, sources_in
from preflight_analysis.model.names_elsewhere import joint_around
from preflight_analysis.model.params_in_sources import meant_in_one_file
from preflight_analysis.model.refused_files import not_marked
from preflight_analysis.model.sections import first_getters
from preflight_analysis.robot.of_launch import robots_of
from preflight_analysis.rules import ctl001_unknown_joint as ctl001
from preflight_analysis.rules import prm004_bad_yaml as prm004
from preflight_analysis.rules import prm006_parameter_set_twice as prm006
from preflight_analysis.rules import prm012_missing_ros_parameters as prm012
from preflight_analysis.rules import prm016_parameter_file_refused as prm016
from preflight_analysis.rules import prm018_listed_not_configured as prm018
from preflight_analysis.rules import prm022_parameter_of_plugin as prm022
from preflight_analysis.rules import prm023_parameter_not_in_sources as prm023

_SUFFIXES = (".yaml", ".yml")
_FOLDERS = frozenset({"config", "configs", "param", "params", "parameters", "cfg", "launch"})
"""Where packages have their parameter files, below other folders or not."""
_NOT_OURS = frozenset({"test", "tests", "build", "install", "log"})
_ABOVE = 3
"""Folders above a package that may be those of its repository."""
_MOST = 200
"""Files of one package that are read."""
_LONGEST = 200_000
"""Characters of one."""
_MAY_BE_MARK = re.compile(r"^[ \t]+ro?s?_*pa?ra?m\w*:", re.MULTILINE)
_JOINTS = ("joint", "joints")
_LOOSE = doubts(NOT_GIVEN=True)
_TOGETHER = 4
"""Parameters that stand together, of which most are those of one source."""


def findings_of_loose_files(context: Context) -> Iterator[Finding]:
    """What is wrong with those of the package that the launch file is in. To read them takes time: it is no part of
    what is found at a keystroke."""
    package = package_around(context.environment, context.root)
    if package is None or context.environment.is_installed(package):
        return
    if not context.tree.ros.own_parameters:
        around = (package_around(context.environment, path) for path in context.launch_files)
        own = {package.share}
        own |= {each.share for each in around if each is not None and not context.environment.is_installed(each)}
        for share in sorted(own):
            yield from _of_ros1(context, share)
        return
    given = first_getters(context).keys()
    files = _files_around(context, package.share)
    for path in loose_param_files(context):
        document = context.disk.text(path)
        if isinstance(document, Document):
            yield from _of_ros2(context, document, package.share, files | given)


def loose_param_files(context: Context) -> list[str]:
    """The parameter files of the package of ROS 2 that the launch file is in which no node of the launch gets."""
    package = package_around(context.environment, context.root)
    if package is None or context.environment.is_installed(package) or not context.tree.ros.own_parameters:
        return []
    return sorted(_files_around(context, package.share) - first_getters(context).keys())


def _files_around(context: Context, share: str) -> frozenset[str]:
    folders = _folders(context, share)
    return frozenset(path for folder, base in folders for path in _param_files(context.disk.db, folder, base))


def findings_of_param_file(context: Context) -> Iterator[Finding]:
    """What is wrong with the parameter file that `context` is of, whoever gets it."""
    path = context.root
    document = context.disk.text(path)
    package = package_around(context.environment, path)
    if not isinstance(document, Document):
        return
    share = package.share if package is not None else os.path.dirname(path)
    # Others may be of programs that read another YAML.
    is_likely = MARK in document.text or "param" in os.path.basename(path) or _is_in_their_folder(path, share)
    if MARK in document.text or context.tree.ros.own_parameters:
        file = read_param_file(document)
        if MARK in document.text or (is_likely and (file.problem is not None or file.misspelt)):
            around = files_in(context.disk, os.path.dirname(path), deep=False)
            beside = (each for each in around if each.endswith(_SUFFIXES))
            yield from _of_ros2(context, document, share, beside)
        return
    try:
        loaded = load_yaml(document.text)
    except YamlError as error:
        at = error.offset or 0
        yield from [_no_yaml(document, error.message, Span(at, at))] if is_likely else ()
        return
    for key, first, second in loaded.twice:
        place = document.location(second)
        yield prm006.RULE.claim(
            prm006.KEY_TWICE.format(key),
            document.location(first),
            subject=Subject("parameter", key),
            doubts=_LOOSE,
            related=(Related("the value that applies", place),),
        )
    if package is not None:
        yield from _unknown_names(context, share, document)
        yield from _unknown_joints(context, document)


def _no_yaml(document: Document, message: str, span: Span) -> Finding:
    text = say("invalid parameters: {quoted}", quoted=message)
    about = Subject("file", document.path)
    return prm004.RULE.claim(text, document.location(span), subject=about, doubts=_LOOSE)


def _of_ros2(context: Context, document: Document, share: str, beside: Iterable[str | None]) -> Iterator[Finding]:
    """Of one file of a package; `beside` are those that nodes may get with it."""
    file, name = read_param_file(document), os.path.basename(document.path)
    if (file.unmarked or file.refused) and name in _read_by_programs(context.disk.db, share):
        return  # they look for its keys, and rcl does not get it
    if file.problem is not None:
        yield _no_yaml(document, *file.problem)
        return
    # Only what has a section of a node, or was meant to have one, is one for certain.
    for name, span in file.unmarked[:1] if file.sections or file.misspelt else ():
        message = prm012.MESSAGE.format(not_marked(name))
        place, fixes = document.location(span), prm012.marked(document, span)
        yield prm012.RULE.claim(message, place, subject=Subject("parameter", name), doubts=_LOOSE, fixes=fixes)
    # What a substitution comes to may be fine.
    for what, span in [each for each in file.refused if "$(" not in document.text[slice(*each[1])]][:1]:
        message = f"{what}; rcl refuses the whole file, and no node that gets it starts"
        of_file = Subject("file", document.path)
        yield prm016.RULE.claim(message, document.location(span), subject=of_file, doubts=_LOOSE)
    yield from prm006.repeated_in(document, *_LOOSE)
    others = tuple(beside)
    for missing in prm018.missing_in(document):
        if _is_in_base(context, others, missing):
            continue
        yield prm018.RULE.claim(
            missing.message,
            document.location(missing.span),
            subject=missing.subject,
            effect=missing.effect,
            doubts=_LOOSE,
            candidates=missing.meant,
        )
    yield from _unknown_names(context, share, document)
    for wrong in prm022.wrong_in(document, context.plugins):
        yield prm022.RULE.claim(
            wrong.message,
            document.location(wrong.span),
            subject=Subject("parameter", wrong.name),
            doubts=(*wrong.doubts, *_LOOSE),
            candidates=(wrong.meant,),
        )


def _of_ros1(context: Context, share: str) -> Iterator[Finding]:
    loaded = {param.place.file for param in context.tree.all_params}
    for path in _yaml_files(context.disk.db, share):
        document = context.disk.text(path)
        if isinstance(document, Document):
            yield from () if path in loaded else _unknown_names(context, share, document)
            yield from _unknown_joints(context, document)


def _unknown_joints(context: Context, document: Document) -> Iterator[Finding]:
    """Of what programs of all kinds call joints, by names alone."""
    if robots_of(context.tree):
        return
    for nodes in _joint_lists(document):
        beside = frozenset(node.value for node in nodes)
        for node in nodes:
            meant = joint_around(context, node.value, beside)
            if meant is not None:
                yield ctl001.RULE.claim(
                    ctl001.IN_NO_OTHER_FILE.format(node.value, *meant),
                    document.location(span_of(node)),
                    subject=Subject("joint", node.value),
                    doubts=doubts(UNSEEN=True),
                    candidates=(meant[0],),
                )


@derived
def _joint_lists(document: Document) -> tuple[tuple[yaml.ScalarNode, ...], ...]:
    found = []
    for key, value in _pairs(document):
        items = value.value if isinstance(value, yaml.SequenceNode) else [value]
        if key.value in _JOINTS:
            found.append(tuple(item for item in items if isinstance(item, yaml.ScalarNode)))
    return tuple(found)


def _pairs(document: Document) -> Iterator[tuple[yaml.ScalarNode, yaml.Node]]:
    for pairs in _mappings(document):
        yield from pairs


def _mappings(document: Document) -> Iterator[list[tuple[yaml.ScalarNode, yaml.Node]]]:
    """The keys and values of each mapping of a YAML file."""
    try:
        root = compose_fast(document.text)
    except CONSTRUCTION_ERRORS:
        return
    left, most = [root] if root is not None else [], _MOST
    while left and most:
        node, most = left.pop(), most - 1
        if isinstance(node, yaml.MappingNode):
            pairs = [(key, value) for key, value in node.value if isinstance(key, yaml.ScalarNode)]
            yield pairs
            left += [value for _, value in pairs]


def _unknown_names(context: Context, share: str, document: Document) -> Iterator[Finding]:
    """Of names that stand together those that no source has, where one source asks for most of the others."""
    for group in _groups(document):
        names = tuple(sorted(group)) if len(group) >= _TOGETHER else ()
        found = meant_in_one_file(context.disk.db, context.environment, (share,), names) if names else {}
        for name, asked in found.items():
            yield prm023.RULE.claim(
                prm023.MESSAGE.format(name, asked.name, os.path.basename(asked.path)),
                document.location(group[name]),
                subject=Subject("parameter", name),
                doubts=_LOOSE,
                candidates=(asked.name,),
            )


@derived
def _groups(document: Document) -> tuple[Mapping[str, Span], ...]:
    """The keys of each mapping of a YAML file that have plain values, and where they stand."""
    return tuple(
        {key.value: span_of(key) for key, value in pairs if isinstance(value, yaml.ScalarNode)}
        for pairs in _mappings(document)
    )


def _is_in_base(context: Context, files: Iterable[str | None], missing: prm018.Missing) -> bool:
    """Whether another file has the parameter, and more of the same section: it is given first, and the one that lacks
    the parameter changes some of it."""
    documents = (context.disk.text(path) for path in files if path is not None)
    return any(
        section.pattern == missing.pattern
        and len(section.params) > missing.size
        and any(param.name == missing.parameter for param in section.params)
        for document in documents
        if isinstance(document, Document)
        for section in read_param_file(document).sections
    )


def _folders(context: Context, share: str) -> Iterator[tuple[str, str]]:
    """That of the package, and those of parameter files beside the packages of its repository; what they are below."""
    yield share, share
    workspace = (context.environment.workspace or "").rstrip("/")
    above = os.path.dirname(share)
    for _ in range(_ABOVE):
        if not workspace or not f"{above}/".startswith(f"{workspace}/"):
            return
        found = [os.path.join(above, name) for name in context.disk.names(above) if name in _FOLDERS]
        yield from ((path, above) for path in found if not context.disk.is_link(path))
        above = os.path.dirname(above)


@query
def _read_by_programs(db: Database, folder: str) -> frozenset[str]:
    """The YAML files that programs of a package name which read YAML themselves."""
    found = (named_in(db, path, "yaml-file") for path in sources_in(db, folder) or ())
    return frozenset(each.text for names in found for each in names)


@query
def _param_files(db: Database, folder: str, base: str) -> tuple[str, ...]:
    """Those below a folder that may be parameter files, by how they are called from `base`."""
    return tuple(path for path in sorted(files_in(Disk(db), folder, deep=True)) if _is_one(db, path, base))[:_MOST]


@query
def _yaml_files(db: Database, folder: str) -> tuple[str, ...]:
    """Those below a package of ROS 1 that may have parameters."""
    disk = Disk(db)
    paths = (path for path in sorted(files_in(disk, folder, deep=True)) if _is_in_their_folder(path, folder))
    texts = ((path, disk.text(path)) for path in paths)
    return tuple(path for path, text in texts if isinstance(text, Document) and len(text.text) <= _LONGEST)[:_MOST]


def _is_in_their_folder(path: str, base: str) -> bool:
    folders = frozenset(PurePath(os.path.relpath(path, base)).parts[:-1])
    return path.endswith(_SUFFIXES) and not folders.isdisjoint(_FOLDERS) and folders.isdisjoint(_NOT_OURS)


@query
def _is_one(db: Database, path: str, base: str) -> bool:
    if not _is_in_their_folder(path, base):
        return False
    document = Disk(db).text(path)
    text = document.text if isinstance(document, Document) else ""
    return len(text) <= _LONGEST and "$(" not in text and (MARK in text or _MAY_BE_MARK.search(text) is not None)
