"""What is said of one proposal that the user looks at: too much to say it of all at once."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence

from preflight_analysis.catalogue.packages import distribution_of
from preflight_analysis.environment.model import Environment
from preflight_analysis.findings.markdown import block, code, escaped
from preflight_analysis.graph.annotations import worth_writing
from preflight_analysis.interfaces.catalogued import catalogued
from preflight_analysis.queries.hover_symbols import package_text
from preflight_analysis.queries.param_texts import default_text
from preflight_analysis.queries.places import link
from preflight_analysis.source.analyse import SourceAnalysis, SourceKey
from preflight_analysis.source.known_params import LaunchParams
from preflight_analysis.tracing.agents.stand_ins.definitions import Definitions
from preflight_analysis.tracing.interface import DOES, Endpoint, Interface, Outcome, ParamUse
from preflight_analysis.workspace.workspace import Workspace

_SHOWN = 30
_NODE = "/node"


def documentation(workspace: Workspace, file: str, about: Sequence[str]) -> str:
    """The Markdown for the `about` of a proposal in a file; an empty text where nothing is known, or that is none.

    A package with its description; an executable or a component with its place and what its source or the catalogue
    says that it does; a message, service or action with its definition.
    """
    match about:
        case ["package", name]:
            return package_text(workspace, name)
        case ["executable", package, name]:
            return "\n".join(_program(workspace, workspace.environment_of(file), package, name, None)).strip()
        case ["component", package, name]:
            return "\n".join(_program(workspace, workspace.environment_of(file), package, name, name)).strip()
        case ["msg" | "srv" | "action" as kind, package, name]:
            return _definition(workspace.environment_of(file), kind, package, name)
    return ""


def _definition(environment: Environment, kind: str, package: str, name: str) -> str:
    shares = {each.name: each.share for each in environment.packages.values()}
    text = Definitions(environment.generation, shares).text(package, kind, name)
    if text is None:
        return ""
    lines = text.rstrip().split("\n")
    more = [f"# … and {len(lines) - _SHOWN} more lines"] if len(lines) > _SHOWN else []
    return block([*lines[:_SHOWN], *more])


def _program(
    workspace: Workspace, environment: Environment, package: str, name: str, plugin: str | None
) -> Iterator[str]:
    sources = SourceAnalysis(environment, workspace.sources)
    executables = workspace.executables
    found = executables.component(package, plugin) if plugin is not None else executables.find(package, name)
    made = executables.made_of(package, name) if plugin is None else None
    place = sources.component(package, plugin) if plugin is not None else None
    path = made.source if made is not None else found.path
    at = (place.file, place.line) if place is not None else (path, None) if path is not None else None
    yield f"{code(f'{package}/{name}')}{f' — {link(*at)}' if at is not None else ''}"
    if path is not None and plugin is None and (said := _docstring(sources, path)):
        yield f"\n{escaped(said)}"
    key = SourceKey(path, found.entry_point, package, name, plugin, _NODE, "", ())
    does = sources.read_each([key], LaunchParams({}))[0]
    if does is not None and (does.endpoints or does.params):
        yield from _does(does.endpoints, does.params)
        return
    distro = distribution_of(environment.generation, environment.distro)
    kind = "components" if plugin is not None else "executables"
    known = catalogued(package, kind, name, distro, is_used=environment.distro == distro)
    if known is not None:
        yield from _does(known.endpoints, known.params)
        yield f"\nFrom {escaped(known.said_by)}"


def _docstring(sources: SourceAnalysis, path: str) -> str:
    """The first paragraph of what a module says of itself."""
    tree = sources.tree(path) if path.endswith(".py") else None
    return ((ast.get_docstring(tree) if tree is not None else None) or "").partition("\n\n")[0]


def _line(what: Endpoint | ParamUse) -> str:
    if isinstance(what, Endpoint):
        return f"- {DOES[what.role]} {code(what.name)}{f' {code(what.type)}' if what.type else ''}"
    kind = default_text(what)
    return f"- parameter {code(what.name.removeprefix('~'))}{f': {kind}' if kind else ''}"


def _does(endpoints: Sequence[Endpoint], params: Sequence[ParamUse]) -> Iterator[str]:
    does = Interface("source", Outcome("not-run"), tuple(endpoints), tuple(params))
    lines = list(dict.fromkeys(map(_line, worth_writing(does))))
    if lines:
        yield ""
        yield from lines[:_SHOWN]
    if len(lines) > _SHOWN:
        yield f"- … and {len(lines) - _SHOWN} more"
