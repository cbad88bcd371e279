"""`ros-preflight where`: all places that set a parameter, in the order in which they apply."""

from __future__ import annotations

import argparse
import os
from collections.abc import Iterator
from typing import Any

from preflight_analysis.environment.detect import workspace_of
from preflight_analysis.evaluation.json_values import json_value
from preflight_analysis.evaluation.tree import CommandValue, Param, ParamValue
from preflight_analysis.findings.printable import printable
from preflight_analysis.findings.report import place, relative
from preflight_analysis.queries.param_texts import type_text
from preflight_analysis.queries.parameters import NoSuchParameterError, Parameter, parameters, section
from preflight_analysis.tracing.interface import ParamUse
from preflight_analysis.workspace.tree_json import place_json
from preflight_analysis.workspace.workspace import Analysis

from preflight_server.cli import options
from preflight_server.cli.errors import CLEAN, CannotDoError
from preflight_server.cli.output import print_json, print_text
from preflight_server.cli.paths import with_paths
from preflight_server.cli.project import open_project, run_nodes

DESCRIPTION = """List all places that set a parameter: tags, parameter files with their sections, and the default in the
code of the node. The place that applies is the first. PARAM is a full name (/talker/rate, in ROS 2 /talker:rate) or its
last part. The command runs the nodes in a sandbox to see which parameters they read; calling it is your consent.
--no-run executes nothing. Exit codes: 0 found, 2 the command failed."""
SCHEMA = "ros-preflight/where/1"
_LENGTH = 200
_USERS = 8


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The verb's own options."""
    options.add_running(parser, ("text", "json"))
    parser.add_argument("file", metavar="FILE", help="a launch file")
    parser.add_argument(
        "launch_args",
        metavar="PARAM|name:=value",
        nargs="+",
        help="the name of a parameter; arguments of the launch file",
    )


def run(args: argparse.Namespace) -> int:
    """Print the answer."""
    words = [word for word in args.launch_args if not options.is_assignment(word)]
    args.launch_args = [word for word in args.launch_args if options.is_assignment(word)]
    if len(words) != 1:
        raise CannotDoError("name one parameter")
    analysis = run_nodes(open_project(args), args)
    try:
        found = parameters(analysis, words[0])
    except NoSuchParameterError as error:
        near = f"; did you mean {' or '.join(error.near)}?" if error.near else ""
        raise CannotDoError(f"nothing in this launch sets or reads a parameter '{error.name}'{near}") from None
    if args.format == "json":
        data = {"schema": SCHEMA, "parameters": [_json(each, analysis) for each in found]}
        print_json(with_paths(data, args, [workspace_of(analysis.root)]))
    else:
        blocks = ["".join(f"{printable(line)}\n" for line in _lines(each, analysis)) for each in found]
        print_text("\n".join(blocks))
    return CLEAN


def _lines(found: Parameter, analysis: Analysis) -> Iterator[str]:
    yield f"parameter '{found.own}' of {found.node}" if found.node else f"parameter '{found.name}'"
    state = "applies"
    for param in found.settings:
        key = section(analysis.tree, param)
        where = place(param.place, analysis.all_documents, os.getcwd())
        yield f"  {state:<10}  {_shown(param.value)} [{where}]{f' section {key!r}' if key else ''}"
        state = "overridden"
    for lost in found.unapplied:
        where = place(lost.place, analysis.all_documents, os.getcwd())
        key = lost.use.section.key
        yield f"  {'no effect':<10}  {_shown(lost.param.value)} [{where}] section {key!r}: {lost.use.reason}"
    for file in found.lost:
        where = place(file.getter.location, analysis.all_documents, os.getcwd())
        yield f"  {'no effect':<10}  {relative(file.used.path, os.getcwd())} [{where}]: {file.reason}"
    for refusal in found.refusals:
        where = place(refusal.place, analysis.all_documents, os.getcwd())
        yield f"  {'refused':<10}  {refusal.what} [{where}]; {found.node} does not start"
    for each in found.unknowns:
        where = place(each.location, analysis.all_documents, os.getcwd())
        yield f"  {'unknown':<10}  may also be set here: {each.what} ({each.reason}) [{where}]"
    declared = found.declared
    if declared is not None and declared.has_default:
        yield f"  {'default':<10}  {_shown(declared.default)}{_in_code(declared)}"
    elif declared is not None:
        yield f"  {'default':<10}  none{_in_code(declared)}"
    users = list(dict.fromkeys(node for node, use in found.uses if use.access != "set"))
    if users:
        more = f" and {len(users) - _USERS} more" if len(users) > _USERS else ""
        yield f"  {'read by':<10}  {', '.join(users[:_USERS])}{more}"
    else:
        yield "  no node is known to read it"


def _shown(value: ParamValue) -> str:
    if isinstance(value, CommandValue):
        return f"output of {' '.join(value.command.split())}"
    if value is None:
        return "unresolved"
    text = " ".join(str(json_value(value)).split()) or "''"
    kind = type_text(value)
    return (f"{text[:_LENGTH]}…" if len(text) > _LENGTH else text) + (f" ({kind})" if kind else "")


def _in_code(use: ParamUse) -> str:
    if use.source_file is None:
        return ""
    line = f":{use.source_line}" if use.source_line is not None else ""
    return f" [{relative(use.source_file, os.getcwd())}{line}]"


def _json(found: Parameter, analysis: Analysis) -> dict[str, Any]:
    return {
        "name": found.own,
        "node": found.node or None,
        "settings": [
            {"applies": not number, **_setting(param, analysis)} for number, param in enumerate(found.settings)
        ],
        "unapplied": [
            {
                "value": json_value(each.param.value),
                "type": type_text(each.param.value) or None,
                "section": each.use.section.key,
                "reason": each.use.reason,
                **place_json(each.place, analysis.all_documents),
            }
            for each in found.unapplied
        ],
        "lost_files": [
            {
                "path": each.used.path,
                "reason": each.reason,
                **place_json(each.getter.location, analysis.all_documents),
            }
            for each in found.lost
        ],
        "refused": [{"reason": each.what, **place_json(each.place, analysis.all_documents)} for each in found.refusals],
        "unknown": [
            {"what": each.what, "reason": each.reason, **place_json(each.location, analysis.all_documents)}
            for each in found.unknowns
        ],
        "declared": _declared(found.declared),
        "uses": [
            {"node": node, "access": use.access, "builtin": use.builtin, **_place_in_code(use)}
            for node, use in found.uses
        ],
    }


def _setting(param: Param, analysis: Analysis) -> dict[str, Any]:
    return {
        "value": json_value(param.value),
        "type": type_text(param.value) or None,
        "section": section(analysis.tree, param) or None,
        "origin": [place_json(step, analysis.all_documents) for step in param.origin],
        **place_json(param.place, analysis.all_documents),
    }


def _declared(use: ParamUse | None) -> dict[str, Any] | None:
    if use is None:
        return None
    value = {"default": json_value(use.default)} if use.has_default else {}
    return {**value, "type": use.type, **_place_in_code(use)}


def _place_in_code(use: ParamUse) -> dict[str, Any]:
    return {"file": use.source_file, "line": use.source_line} if use.source_file is not None else {}
