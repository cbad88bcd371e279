"""What is known of a name over all files: a parameter with its settings, a package, an argument with who passes it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from preflight_analysis.documents.document import Element, Node, Text
from preflight_analysis.documents.reading import Unreadable
from preflight_analysis.documents.span import Location
from preflight_analysis.documents.xml import parse_xml
from preflight_analysis.evaluation.tree import Param
from preflight_analysis.findings.markdown import code, escaped
from preflight_analysis.queries import shared_arguments
from preflight_analysis.queries.hover_text import Hover
from preflight_analysis.queries.param_texts import default_text, type_text, value_text
from preflight_analysis.queries.parameters import parameter
from preflight_analysis.queries.places import action_at, link, place
from preflight_analysis.queries.query_context import QueryContext
from preflight_analysis.queries.symbol_at import NamedSymbol, symbol_at
from preflight_analysis.tracing.interface import ParamUse
from preflight_analysis.workspace.facts import declaration
from preflight_analysis.workspace.workspace import Analysis, Workspace

_SHOWN = 8


def symbol_hover(context: QueryContext, offset: int) -> Hover | None:
    """The hover of the parameter or package whose name is at `offset`; None for everything else."""
    symbol = symbol_at(context, offset)
    if symbol is None or not symbol.names:
        return None
    if symbol.kind == "package":
        text = package_text(context.workspace, *symbol.names)
        return Hover(text, symbol.span) if text else None
    if symbol.kind == "param":
        blocks = list(_parameters(context, symbol))
        return Hover("\n\n---\n\n".join(blocks), symbol.span) if blocks else None
    return None


def package_text(workspace: Workspace, name: str) -> str:
    """A package with its version, path and description; an empty text where it is not known."""
    package = workspace.environment.packages.get(name)
    if package is None:
        return ""
    manifest = workspace.sources.text(package.manifest)
    root = parse_xml(package.manifest, manifest.text).root if not isinstance(manifest, Unreadable) else None
    texts = {each.tag: _content(each) for each in root.elements} if root is not None else {}
    version = f" {code(texts['version'])}" if texts.get("version") else ""
    lines = [f"package {code(name)}{version} — {link(package.manifest, None)}", "", code(package.share)]
    if description := texts.get("description"):
        lines += ["", escaped(description)]
    return "\n".join(lines)


def _content(element: Element) -> str:
    """The text of an element, that of the elements in it included, on one line."""
    pieces: list[str] = []
    stack: list[Node] = [element]
    while stack:
        node = stack.pop()
        if isinstance(node, Text):
            pieces.append(node.content.text)
        elif isinstance(node, Element):
            stack += node.children[::-1]
    return " ".join("".join(pieces).split())


def _parameters(context: QueryContext, symbol: NamedSymbol) -> Iterator[str]:
    """One block for each parameter that the name stands for; those of further robots in one line."""
    shown: list[str] = []
    more: list[str] = []
    for name in sorted(symbol.names):
        for analysis in context.analyses:
            if (text := _parameter(analysis, name)) is not None:
                if shown:
                    more.append(name)
                else:
                    shown.append(text)
                break
    yield from shown
    if more:
        rest = f" and {len(more) - _SHOWN} more" if len(more) > _SHOWN else ""
        yield f"Also sets {', '.join(map(code, more[:_SHOWN]))}{rest}"


def _parameter(analysis: Analysis, name: str) -> str | None:
    found = parameter(analysis, name)
    if found is None:
        return None
    title = f"parameter {code(found.own)} of {code(found.node)}" if found.node else f"parameter {code(name)}"
    kind = default_text(found.declared) if found.declared is not None else ""
    lines = [f"{title}{f': {kind}' if kind else ''}"]
    lines += ["", *_settings(analysis, found.settings)] if found.settings else ["", "Not set in this launch."]
    lines += [
        f"- may also be set at {place(analysis, each.location)}: {escaped(each.what)} ({escaped(each.reason)})"
        for each in found.unknowns[:_SHOWN]
    ]
    lines += ["", *_users(analysis, found.uses)]
    return "\n".join(lines)


def _settings(analysis: Analysis, settings: Sequence[Param]) -> Iterator[str]:
    """The places that set it, the one that applies first."""
    for number, param in enumerate(settings[:_SHOWN]):
        kind = type_text(param.value)
        text = f"{value_text(param.value)}{f' ({kind})' if kind else ''} set at {place(analysis, param.place)}"
        yield f"- **{text}**" if not number else f"- {text}, overridden"
    if len(settings) > _SHOWN:
        yield f"- … and {len(settings) - _SHOWN} more"


def _users(analysis: Analysis, uses: Sequence[tuple[str, ParamUse]]) -> Iterator[str]:
    seen: dict[tuple[str, str, str | None, int | None], str] = {}
    gets = "Declared by" if analysis.tree.ros.own_parameters else "Read by"
    for node, use in uses:
        verb = {"get": gets, "set": "Set by"}.get(use.access, "Used by")
        key = (verb, node, use.source_file, use.source_line)
        where = f" — {link(use.source_file, use.source_line)}" if use.source_file and not use.builtin else ""
        seen.setdefault(key, f"- {verb} {code(node)}{where}")
    yield from list(seen.values())[:_SHOWN]
    if not uses:
        yield "No node is known to use it." if analysis.graph is not None else "The nodes are not analysed yet."


def argument_notes(context: QueryContext, offset: int) -> str:
    """Of the argument at `offset`: its default, choices and description, and the places that pass it; an empty text
    where it is no argument."""
    symbol = symbol_at(context, offset)
    if symbol is None or symbol.kind != "arg" or len(symbol.names) != 1:
        return ""
    (name,) = symbol.names
    lines = list(_declared(context, symbol, name))
    passed = list(dict.fromkeys(shared_arguments.given_at(context, symbol.files, name)))
    if passed:
        lines += ["", "Passed at", *(f"- {_given(context, each)}" for each in passed[:_SHOWN])]
        if len(passed) > _SHOWN:
            lines.append(f"- … and {len(passed) - _SHOWN} more")
    return "\n".join(lines).strip()


def _declared(context: QueryContext, symbol: NamedSymbol, name: str) -> Iterator[str]:
    for at in dict.fromkeys(shared_arguments.declared_at(context, symbol.files, name)):
        launch_file = context.launch_file(at.file)
        action = action_at(launch_file, at.span.start) if launch_file is not None else None
        if action is None or action.attribute("name") is None:
            continue
        known = declaration(action)
        if known.value is not None:
            yield f"Fixed: {value_text(known.value)}"
        else:
            yield "Required" if known.default is None else f"Default: {value_text(known.default)}"
        if known.choices:
            yield f"\nOne of {', '.join(map(code, known.choices))}"
        if known.doc:
            yield f"\n{escaped(known.doc)}"
        return


def _given(context: QueryContext, at: Location) -> str:
    """A place that passes the argument, with the value as it is written there."""
    launch_file = context.launch_file(at.file)
    action = action_at(launch_file, at.span.start) if launch_file is not None else None
    value = (action.value("value") or action.value("default")) if action is not None else None
    document = context.document(at.file)
    line = document.lines.position(at.span.start)[0] + 1 if document is not None else None
    return link(at.file, line) + (f": {value_text(value.text)}" if value is not None else "")
