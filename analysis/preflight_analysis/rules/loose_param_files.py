"""Parameter files that no node of a launch gets, which may be given to some node all the same: a program rewrites them,
an argument names them, the launch file could not be followed."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping

import yaml

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
from preflight_analysis.model.loose_param_files import (
    YAML_SUFFIXES,
    is_in_their_folder,
    loose_param_files,
    param_files_around,
    yaml_files_of,
)
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

_JOINTS = ("joint", "joints")
_LOOSE = doubts(NOT_GIVEN=True)
_MOST = 200
"""Mappings of a file that are looked into."""
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
    files = param_files_around(context, package.share)
    for path in loose_param_files(context):
        document = context.disk.text(path)
        if isinstance(document, Document):
            yield from _of_ros2(context, document, package.share, files | given)


def findings_of_param_file(context: Context) -> Iterator[Finding]:
    """What is wrong with the parameter file that `context` is of, whoever gets it."""
    path = context.root
    document = context.disk.text(path)
    package = package_around(context.environment, path)
    if not isinstance(document, Document):
        return
    share = package.share if package is not None else os.path.dirname(path)
    # Others may be of programs that read another YAML.
    is_likely = MARK in document.text or "param" in os.path.basename(path) or is_in_their_folder(path, share)
    if MARK in document.text or context.tree.ros.own_parameters:
        file = read_param_file(document)
        if MARK in document.text or (is_likely and (file.problem is not None or file.misspelt)):
            around = files_in(context.disk, os.path.dirname(path), deep=False)
            beside = (each for each in around if each.endswith(YAML_SUFFIXES))
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
    for path in yaml_files_of(context.disk.db, share):
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


@query
def _read_by_programs(db: Database, folder: str) -> frozenset[str]:
    """The YAML files that programs of a package name which read YAML themselves."""
    found = (named_in(db, path, "yaml-file") for path in sources_in(db, folder) or ())
    return frozenset(each.text for names in found for each in names)
