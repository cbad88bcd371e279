"""News of the workspace: files on disk, settings, folders, trust."""

from __future__ import annotations

import asyncio
import logging
import os
from typing import TYPE_CHECKING, Any

from lsprotocol import types
from preflight_analysis.environment.detect import SETTINGS_FILE

from preflight_server.lsp.settings import Settings, as_mapping
from preflight_server.lsp.text_store import to_path

if TYPE_CHECKING:
    from preflight_server.lsp.app import PreflightServer

_log = logging.getLogger(__name__)

WORKSPACE_TRUST = "rosPreflight/workspaceTrust"
"""Our own notification, `{"trusted": bool}`: the user's decision came or changed after `initialize`."""

_OF_THE_ENVIRONMENT = frozenset({"package.xml", "manifest.xml", "CATKIN_IGNORE", "AMENT_IGNORE", "COLCON_IGNORE"}) | {
    SETTINGS_FILE
}


async def _settings(ls: PreflightServer, pushed: Any) -> Settings:
    """The section `rosPreflight`: asked for where the client can be asked, else what it sent along."""
    workspace = ls.client_capabilities.workspace
    if workspace is not None and workspace.configuration:
        item = types.ConfigurationItem(section="rosPreflight")
        answer = await ls.workspace_configuration_async(types.ConfigurationParams([item]))
        return Settings.read(as_mapping(answer[0] if answer else None))
    return Settings.read(as_mapping(as_mapping(pushed).get("rosPreflight")))


def register(server: PreflightServer) -> None:
    """Register the handlers."""

    @server.feature(types.WORKSPACE_DID_CHANGE_WATCHED_FILES)
    def did_change_watched_files(ls: PreflightServer, params: types.DidChangeWatchedFilesParams) -> None:
        if ls.session is None:
            return
        changes = [(path, change.type) for change in params.changes if (path := to_path(change.uri)) is not None]
        came_or_went = (types.FileChangeType.Created, types.FileChangeType.Deleted)
        if any(os.path.basename(path) in _OF_THE_ENVIRONMENT for path, _ in changes):
            ls.session.environment_changed()
        elif changes:
            # An executable that was missing may be there now.
            new = any(kind in came_or_went for _, kind in changes)
            ls.session.files_changed([path for path, _ in changes], came_or_went=new)

    @server.feature(types.WORKSPACE_DID_CHANGE_CONFIGURATION)
    async def did_change_configuration(ls: PreflightServer, params: types.DidChangeConfigurationParams) -> None:
        try:
            settings = await _settings(ls, params.settings)
        except asyncio.CancelledError:  # the client leaves
            return
        except Exception as error:
            _log.warning("the settings could not be read: %s", error)
            return
        if ls.session is not None:
            ls.session.configure(settings)

    @server.feature(WORKSPACE_TRUST)
    def workspace_trust(ls: PreflightServer, params: Any) -> None:
        if ls.session is not None:
            ls.session.set_trusted(as_mapping(params).get("trusted") is True)

    @server.feature(types.WINDOW_WORK_DONE_PROGRESS_CANCEL)
    def cancel_progress(ls: PreflightServer, params: types.WorkDoneProgressCancelParams) -> None:
        if ls.session is not None:
            ls.session.runs.cancel(params.token)
