"""`textDocument/codeAction`: fixes of findings, ways to suppress and explain them, and annotations of nodes.

- `quickfix`: the fixes of the findings in the range; for each rule among them, all of its fixes in the file, its page,
  and to suppress it on the line, in the file or in the workspace. The last two edit `.ros-preflight.yaml`;
- `source.fixAll.rosPreflight`: the preferred fixes of all findings of the file that are certain;
- `refactor.rewrite`: what is known of a node as an annotation.

Commands of the server, which any editor can execute: `rosPreflight.explainRule`, `[rule]`, opens the page of a rule.
`rosPreflight.showInstallCommand`, `[command]`, shows a command and does not run it. VS Code's `workbench.trust.manage`
is offered where the client names it among its `clientCommands`.
"""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING

from lsprotocol import types
from preflight_analysis.documents.reading import Text, read_text
from preflight_analysis.edits.edit import Edit
from preflight_analysis.edits.gate import passes
from preflight_analysis.environment.detect import SETTINGS_FILE
from preflight_analysis.findings.finding import Finding
from preflight_analysis.queries.actions import FixOf, annotating, fix_all, fixes, touching
from preflight_analysis.queries.suppressing import suppress_on_line
from preflight_analysis.workspace.settings_edit import turn_off

from preflight_server.lsp.convert import Converter
from preflight_server.lsp.edits import edits_of
from preflight_server.lsp.session import View

if TYPE_CHECKING:
    from preflight_server.lsp.app import PreflightServer

EXPLAIN = "rosPreflight.explainRule"
SHOW_INSTALL_COMMAND = "rosPreflight.showInstallCommand"
MANAGE_TRUST = "workbench.trust.manage"
FIX_ALL = "source.fixAll.rosPreflight"
_KINDS = (types.CodeActionKind.QuickFix, FIX_ALL, types.CodeActionKind.RefactorRewrite)


def register(server: PreflightServer) -> None:
    """Register the handlers."""

    @server.feature(types.TEXT_DOCUMENT_CODE_ACTION, types.CodeActionOptions(code_action_kinds=list(_KINDS)))
    async def code_action(ls: PreflightServer, params: types.CodeActionParams) -> list[types.CodeAction] | None:
        async def answer(view: View) -> tuple[list[types.CodeAction], Converter]:
            return await view.session.in_pool(lambda: list(_Actions(ls, view, params).all())), view.converter

        return await edits_of(ls, params.text_document.uri, answer)

    @server.command(EXPLAIN)
    async def explain(rule: str) -> str | None:
        uri = server.rule_pages.uri(rule)
        window = server.client_capabilities.window
        if uri is not None and window is not None and window.show_document is not None:
            await server.window_show_document_async(types.ShowDocumentParams(uri, take_focus=True))
        return uri

    @server.command(SHOW_INSTALL_COMMAND)
    async def show_install_command(command: str) -> None:
        server.window_show_message(types.ShowMessageParams(types.MessageType.Info, f"To install, run: {command}"))


class _Actions:
    """The actions for a range. Use it off the event loop: it reads the settings file."""

    def __init__(self, ls: PreflightServer, view: View, params: types.CodeActionParams) -> None:
        self._ls = ls
        self._view = view
        self._only = [k.value if isinstance(k, types.CodeActionKind) else str(k) for k in params.context.only or ()]
        self._span = view.converter.span(view.path, params.range)
        self._findings = touching(view.findings, view.path, self._span)
        self._first: dict[str, Finding] = {}
        """The first finding in the range of each rule."""
        for finding in self._findings:
            self._first.setdefault(finding.rule, finding)

    def all(self) -> Iterator[types.CodeAction]:
        """Those of the kinds that are asked for."""
        offered: set[str] = set()
        if self._wanted(types.CodeActionKind.QuickFix):
            for action in self._quick_fixes():
                offered.add(action.title)
                yield action
        if self._wanted(FIX_ALL) and self._only:  # an editor asks for it by name, as when it saves
            edits, _ = fix_all(self._view.findings)
            if edits and self._passes("Fix all that is certain", edits):
                yield types.CodeAction("Fix all that is certain", kind=FIX_ALL, edit=self._edit(edits))
        if self._wanted(types.CodeActionKind.RefactorRewrite):
            for rewrite in annotating(self._view.analysis, self._view.path, self._span.start):
                # The quick fix of a finding may be the same.
                if rewrite.title not in offered and self._passes(rewrite.title, rewrite.edits):
                    kind = types.CodeActionKind.RefactorRewrite
                    yield types.CodeAction(rewrite.title, kind=kind, edit=self._edit(rewrite.edits))

    def _wanted(self, kind: str) -> bool:
        """Whether the client asked for that kind, or for one above it."""
        kind = kind.value if isinstance(kind, types.CodeActionKind) else kind
        return not self._only or any(kind == asked or kind.startswith(f"{asked}.") for asked in self._only)

    def _passes(self, title: str, edits: Sequence[Edit]) -> bool:
        """Whether edits may be offered. It raises where a text is another one by now, whose offsets they would have."""
        self._edit(edits)
        return passes(title, edits, self._view.text)

    def _edit(self, edits: Iterable[Edit]) -> types.WorkspaceEdit:
        return self._view.converter.workspace_edit(edits)

    def _quick_fix(
        self,
        title: str,
        finding: Finding,
        *,
        edit: types.WorkspaceEdit | None = None,
        command: str | None = None,
        argument: str | None = None,
        preferred: bool = False,
    ) -> types.CodeAction:
        given = [argument] if argument is not None else []
        return types.CodeAction(
            title,
            kind=types.CodeActionKind.QuickFix,
            diagnostics=[self._view.converter.diagnostic(finding)],
            is_preferred=preferred or None,
            edit=edit,
            command=types.Command(title, command, arguments=given) if command is not None else None,
        )

    def _quick_fixes(self) -> Iterator[types.CodeAction]:
        found = [e for e in fixes(self._findings) if self._passes(f"{e.finding.rule} {e.fix.title}", e.fix.edits)]
        titles = Counter(each.fix.title for each in found)
        for each in found:
            title = each.fix.title if titles[each.fix.title] == 1 else f"{each.fix.title} ({self._place(each)})"
            yield self._quick_fix(title, each.finding, edit=self._edit(each.fix.edits), preferred=each.fix.preferred)
        for rule, finding in self._first.items():
            if any(fix.preferred for fix in finding.fixes):
                edits, count = fix_all(self._view.findings, rule)
                title = f"Fix all {count} {rule} in this file"
                if count > 1 and self._passes(title, edits):
                    yield self._quick_fix(title, finding, edit=self._edit(edits))
        yield from self._remedies()
        for rule, finding in self._first.items():
            yield from self._suppressions(rule, finding)
            yield self._quick_fix(f"Explain {rule} {finding.name}", finding, command=EXPLAIN, argument=rule)

    def _place(self, each: FixOf) -> str:
        location = each.fix.edits[0].location if each.fix.edits else each.finding.location
        start = self._view.converter.range(location).start
        return f"{os.path.basename(location.file)}:{start.line + 1}:{start.character + 1}"

    def _remedies(self) -> Iterator[types.CodeAction]:
        """What is to be done outside of the files."""
        shown: set[str] = set()
        for finding in self._findings:
            remedy = finding.lack.remedy if finding.lack is not None else None
            if remedy and remedy not in shown:
                shown.add(remedy)
                title = f"Show the command: {remedy}"
                yield self._quick_fix(title, finding, command=SHOW_INSTALL_COMMAND, argument=remedy)
        untrusted = self._first.get("TRC004")
        if untrusted is not None and not self._view.session.runs.trusted and MANAGE_TRUST in self._ls.client_commands:
            yield self._quick_fix("Manage workspace trust", untrusted, command=MANAGE_TRUST)

    def _suppressions(self, rule: str, finding: Finding) -> Iterator[types.CodeAction]:
        document = self._view.analysis.document(self._view.path)
        edit = suppress_on_line(document, finding) if document is not None else None
        title = f"Suppress {rule} on this line"
        if edit is not None and self._passes(title, [edit]):
            yield self._quick_fix(title, finding, edit=self._edit([edit]))
        for where, file in (("this file", self._view.path), ("the workspace", None)):
            changed = self._settings_edit(rule, file)
            if changed is not None:
                yield self._quick_fix(f"Suppress {rule} in {where} ({SETTINGS_FILE})", finding, edit=changed)

    def _settings_edit(self, rule: str, file: str | None) -> types.WorkspaceEdit | None:
        """The edit of the workspace's settings file, which is created where there is none."""
        folder = self._view.analysis.environment.workspace
        if folder is None:
            return None
        path = os.path.join(folder, SETTINGS_FILE)
        opened, read = self._ls.texts.by_path(path), read_text(path)
        exists = opened is not None or isinstance(read, Text)
        if not exists and (os.path.lexists(path) or not _can_create(self._ls.client_capabilities)):
            return None
        text = opened.text if opened is not None else read.text if isinstance(read, Text) else ""
        edit = turn_off(folder, path, text, rule, file)
        if edit is None or not passes(f"{SETTINGS_FILE}: {rule}", [edit], {path: text}.get):
            return None
        converter = self._view.converter
        if exists:
            return converter.workspace_edit([edit])
        created = types.CreateFile(converter.uri(path), options=types.CreateFileOptions(ignore_if_exists=True))
        changes = converter.workspace_edit([edit]).document_changes or ()
        return types.WorkspaceEdit(document_changes=[created, *changes])


def _can_create(capabilities: types.ClientCapabilities) -> bool:
    edit = capabilities.workspace.workspace_edit if capabilities.workspace else None
    operations = edit.resource_operations if edit is not None and edit.document_changes else None
    return types.ResourceOperationKind.Create in (operations or ())
