"""`textDocument/signatureHelp`: the arguments of an include, the parameters of a call of launch in Python."""

from __future__ import annotations

from typing import TYPE_CHECKING

from lsprotocol import types
from preflight_analysis.queries.signature import signature as query
from preflight_analysis.queries.signature_items import Parameter, Signature

from preflight_server.lsp.markup import markup
from preflight_server.lsp.positions import Positions

if TYPE_CHECKING:
    from preflight_server.lsp.app import PreflightServer


def _help(found: Signature, options: types.ClientSignatureInformationOptions) -> types.SignatureHelp:
    offsets = options.parameter_information
    by_offset = bool(offsets and offsets.label_offset_support)

    def parameter(each: Parameter) -> types.ParameterInformation:
        # Offsets in labels are always counted in UTF-16.
        start, end = (len(found.label[:at].encode("utf-16-le")) // 2 for at in (each.start, each.end))
        label = (start, end) if by_offset else found.label[each.start : each.end]
        return types.ParameterInformation(label, markup(each.doc, options.documentation_format) if each.doc else None)

    parameters = [parameter(each) for each in found.parameters]
    # Without support for "none", one past the end is none.
    active = found.active if found.active is not None else len(parameters)
    doc = markup(found.doc, options.documentation_format)
    return types.SignatureHelp([types.SignatureInformation(found.label, doc, parameters)], 0, active)


def register(server: PreflightServer) -> None:
    """Register the handler."""

    @server.feature(
        types.TEXT_DOCUMENT_SIGNATURE_HELP,
        types.SignatureHelpOptions(trigger_characters=["<", '"', "'", "(", ","], retrigger_characters=[" ", ">", ")"]),
    )
    async def signature_help(ls: PreflightServer, params: types.SignatureHelpParams) -> types.SignatureHelp | None:
        session = ls.session_of(params.text_document.uri)
        latest = await session.latest(params.text_document.uri, python=True) if session else None
        if session is None or latest is None:
            return None
        (launch_file, analysis), workspace = latest, await session.workspace()
        document = launch_file.document
        offset = Positions(document.text, document.lines, ls.texts.encoding).offset(params.position)
        found = await session.in_pool(lambda: query(analysis, launch_file, offset, workspace.sources))
        client = ls.client_capabilities.text_document
        asked = client.signature_help.signature_information if client and client.signature_help else None
        return _help(found, asked or types.ClientSignatureInformationOptions()) if found else None
