"""`textDocument/codeAction`: quick fixes of findings, and what is known of a node as an annotation."""

from __future__ import annotations

from typing import TYPE_CHECKING

from lsprotocol import types
from preflight_analysis.queries.actions import annotating, fixes

from preflight_server.lsp.session import View

if TYPE_CHECKING:
    from preflight_server.lsp.app import PreflightServer

_KINDS = (types.CodeActionKind.QuickFix, types.CodeActionKind.RefactorRewrite)


def _wanted(kind: types.CodeActionKind, only: list[str]) -> bool:
    """Whether the client asked for that kind, or for one above it."""
    return not only or any(kind.value == asked or kind.value.startswith(f"{asked}.") for asked in only)


def _actions(view: View, params: types.CodeActionParams) -> list[types.CodeAction]:
    only = [k.value if isinstance(k, types.CodeActionKind) else str(k) for k in params.context.only or ()]
    span = view.converter.span(view.path, params.range)
    actions: list[types.CodeAction] = []
    if _wanted(types.CodeActionKind.QuickFix, only):
        for each in fixes(view.findings, view.path, span):
            actions.append(
                types.CodeAction(
                    each.fix.title,
                    kind=types.CodeActionKind.QuickFix,
                    diagnostics=[view.converter.diagnostic(each.finding)],
                    is_preferred=each.fix.preferred or None,
                    edit=view.converter.workspace_edit(each.fix.edits),
                )
            )
    if _wanted(types.CodeActionKind.RefactorRewrite, only):
        offered = {action.title for action in actions}
        for rewrite in annotating(view.analysis, view.path, span.start):
            if rewrite.title in offered:
                continue  # as the quick fix of a finding
            edit = view.converter.workspace_edit(rewrite.edits)
            actions.append(types.CodeAction(rewrite.title, kind=types.CodeActionKind.RefactorRewrite, edit=edit))
    return actions


def register(server: PreflightServer) -> None:
    """Register the handler."""

    @server.feature(types.TEXT_DOCUMENT_CODE_ACTION, types.CodeActionOptions(code_action_kinds=list(_KINDS)))
    async def code_action(ls: PreflightServer, params: types.CodeActionParams) -> list[types.CodeAction] | None:
        view = await ls.view_of(params.text_document.uri, python=True)
        if view is None:
            return None
        return await view.session.in_pool(lambda: _actions(view, params))
