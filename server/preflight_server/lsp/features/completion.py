"""`textDocument/completion`, and `completionItem/resolve` for the documentation of what the user looks at.

The `data` of a proposal with more to say has the document's URI, then what `queries.completion_docs` takes as `about`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, TypeGuard

from lsprotocol import types
from preflight_analysis.queries.completion import TRIGGERS
from preflight_analysis.queries.completion import complete as query
from preflight_analysis.queries.completion_docs import documentation
from preflight_analysis.queries.completion_items import Item, ItemKind
from preflight_analysis.queries.completion_values import Lookup
from preflight_analysis.workspace.workspace import Analysis

from preflight_server.lsp.markup import markup
from preflight_server.lsp.positions import Positions
from preflight_server.lsp.text_store import to_path

if TYPE_CHECKING:
    from preflight_server.lsp.app import PreflightServer

_KINDS: Mapping[ItemKind, types.CompletionItemKind] = {
    "element": types.CompletionItemKind.Class,
    "snippet": types.CompletionItemKind.Snippet,
    "end-tag": types.CompletionItemKind.Class,
    "attribute": types.CompletionItemKind.Property,
    "value": types.CompletionItemKind.EnumMember,
    "package": types.CompletionItemKind.Module,
    "executable": types.CompletionItemKind.File,
    "folder": types.CompletionItemKind.Folder,
    "file": types.CompletionItemKind.File,
    "argument": types.CompletionItemKind.Variable,
    "command": types.CompletionItemKind.Keyword,
    "function": types.CompletionItemKind.Function,
    "constant": types.CompletionItemKind.Constant,
    "variable": types.CompletionItemKind.Variable,
    "machine": types.CompletionItemKind.Reference,
    "namespace": types.CompletionItemKind.Module,
    "parameter": types.CompletionItemKind.Field,
    "endpoint": types.CompletionItemKind.Event,
    "type": types.CompletionItemKind.Struct,
}


SUGGEST = "editor.action.triggerSuggest"
"""VS Code's own command that asks again; given to clients that name it among their `clientCommands`."""


def _item(
    item: Item, order: int, range_: types.Range, options: types.ClientCompletionItemOptions, uri: str, *, suggests: bool
) -> types.CompletionItem:
    snippet = item.snippet if options.snippet_support else None
    return types.CompletionItem(
        item.label,
        kind=_KINDS[item.kind],
        detail=item.detail or None,
        documentation=markup(item.doc, options.documentation_format) if item.doc else None,
        sort_text=f"{order:05}",
        filter_text=item.filter,
        insert_text_format=types.InsertTextFormat.Snippet if snippet is not None else None,
        text_edit=types.TextEdit(range_, snippet if snippet is not None else item.text),
        # What is in the folder comes next.
        command=types.Command("", SUGGEST) if suggests and item.kind == "folder" else None,
        data=[uri, *item.about] if item.about else None,
    )


def register(server: PreflightServer) -> None:
    """Register the handler."""

    def options() -> types.ClientCompletionItemOptions:
        client = server.client_capabilities.text_document
        asked = client.completion.completion_item if client and client.completion else None
        return asked or types.ClientCompletionItemOptions()

    @server.feature(
        types.TEXT_DOCUMENT_COMPLETION,
        types.CompletionOptions(trigger_characters=list(TRIGGERS), resolve_provider=True),
    )
    async def completion(ls: PreflightServer, params: types.CompletionParams) -> types.CompletionList | None:
        session = ls.session_of(params.text_document.uri)
        latest = await session.latest(params.text_document.uri, python=True) if session else None
        if session is None or latest is None:
            return None
        (launch_file, analysis), workspace = latest, await session.workspace()
        positions = Positions(launch_file.document.text, launch_file.document.lines, ls.texts.encoding)
        offset = positions.offset(params.position)
        trigger = params.context.trigger_character if params.context else None

        def ahead_of_runs(known: Analysis) -> Analysis:
            return workspace.ahead_of_runs(workspace.taking(known, launch_file.path, offset)[0])

        found = await session.in_pool(
            lambda: query(
                analysis, launch_file, offset, Lookup(workspace.sources, workspace.executables, ahead_of_runs), trigger
            )
        )
        if found is None:
            return None
        uri, shown, range_ = params.text_document.uri, options(), positions.range(found.span)
        suggests = SUGGEST in ls.client_commands
        # Without tab stops a snippet is but its tag, which is offered already.
        offered = [each for each in found.items if shown.snippet_support or each.kind != "snippet"]
        items = [_item(item, n, range_, shown, uri, suggests=suggests) for n, item in enumerate(offered)]
        return types.CompletionList(False, items)

    @server.feature(types.COMPLETION_ITEM_RESOLVE)
    async def resolve(ls: PreflightServer, item: types.CompletionItem) -> types.CompletionItem:
        uri, *about = item.data if _is_ours(item.data) else ("",)
        session, path = ls.session_of(uri), to_path(uri)
        if session is None or path is None:
            return item
        workspace = await session.workspace()
        text = await session.in_pool(lambda: documentation(workspace, path, about))
        item.documentation = markup(text, options().documentation_format) if text else None
        return item


def _is_ours(data: object) -> TypeGuard[Sequence[str]]:
    """Whether a client hands back what it was given."""
    return isinstance(data, (list, tuple)) and len(data) > 1 and all(isinstance(each, str) for each in data)
