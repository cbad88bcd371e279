"""News of the workspace: files on disk, settings, folders, trust."""

from __future__ import annotations

import asyncio
import logging
import os
from typing import TYPE_CHECKING, Any

from lsprotocol import types
from preflight_analysis.environment.detect import SETTINGS_FILE

from preflight_server.lsp.settings import Settings, as_mapping
from preflight_server.lsp.text_store import to_path, to_uri

if TYPE_CHECKING:
    from collections.abc import Sequence

    from preflight_server.lsp.app import PreflightServer
    from preflight_server.lsp.session import Session

_log = logging.getLogger(__name__)

WORKSPACE_TRUST = "rosPreflight/workspaceTrust"
"""Our own notification, `{"trusted": bool}`: the user's decision came or changed after `initialize`."""

_OF_THE_ENVIRONMENT = frozenset({"package.xml", "manifest.xml", "CATKIN_IGNORE", "AMENT_IGNORE", "COLCON_IGNORE"}) | {
    SETTINGS_FILE
}


def _can_be_asked(ls: PreflightServer) -> bool:
    workspace = ls.client_capabilities.workspace
    return workspace is not None and bool(workspace.configuration)


async def _asked(ls: PreflightServer, sessions: Sequence[Session]) -> list[Any]:
    """The section `rosPreflight` for the whole window and for the folder of each session."""
    scopes = [None, *(to_uri(session.folder) if session.folder else None for session in sessions)]
    items = [types.ConfigurationItem(scope_uri=scope, section="rosPreflight") for scope in scopes]
    answer = await ls.workspace_configuration_async(types.ConfigurationParams(items))
    return [*(answer or ()), *(None for _ in items)][: len(items)]


async def own_settings(ls: PreflightServer) -> None:
    """Ask for what each folder has in settings of its own: the initialisation options are the window's."""
    if not _can_be_asked(ls):
        return
    sessions = ls.sessions
    try:
        _, *answers = await _asked(ls, sessions)
    except (Exception, asyncio.CancelledError) as error:
        _log.info("the settings of the folders are unknown: %s", error)
        return
    for session, own in zip(sessions, answers, strict=True):
        if own is not None:
            session.configure(Settings.read(as_mapping(own)))


def register(server: PreflightServer) -> None:
    """Register the handlers."""

    @server.feature(types.WORKSPACE_DID_CHANGE_WATCHED_FILES)
    def did_change_watched_files(ls: PreflightServer, params: types.DidChangeWatchedFilesParams) -> None:
        if ls.folders is None:
            return
        paths = [path for change in params.changes if (path := to_path(change.uri)) is not None]
        if any(os.path.basename(path) in _OF_THE_ENVIRONMENT for path in paths):
            ls.folders.each(lambda session: session.environment_changed())
        elif paths:
            ls.folders.each(lambda session: session.files_changed(paths))

    @server.feature(types.WORKSPACE_DID_CHANGE_CONFIGURATION)
    async def did_change_configuration(ls: PreflightServer, params: types.DidChangeConfigurationParams) -> None:
        if ls.folders is None:
            return
        if not _can_be_asked(ls):
            ls.folders.configure(Settings.read(as_mapping(as_mapping(params.settings).get("rosPreflight"))))
            return
        sessions = ls.sessions
        try:
            of_window, *of_folders = await _asked(ls, sessions)
        except asyncio.CancelledError:  # the client leaves
            return
        except Exception as error:
            _log.warning("the settings could not be read: %s", error)
            return
        read = [Settings.read(as_mapping(answer)) for answer in (of_window, *of_folders)]
        ls.folders.configure(read[0], dict(zip(sessions, read[1:], strict=True)))

    @server.feature(types.WORKSPACE_DID_CHANGE_WORKSPACE_FOLDERS)
    async def did_change_folders(ls: PreflightServer, params: types.DidChangeWorkspaceFoldersParams) -> None:
        if ls.folders is None:
            return
        added = [path for folder in params.event.added if (path := to_path(folder.uri)) is not None]
        removed = [path for folder in params.event.removed if (path := to_path(folder.uri)) is not None]
        made = ls.folders.change(added, removed)
        ls.status.send()
        ls.spawn(own_settings(ls))
        for session in made:
            await session.workspace()
            session.indexing.changed(None)

    @server.feature(WORKSPACE_TRUST)
    def workspace_trust(ls: PreflightServer, params: Any) -> None:
        if ls.folders is not None:
            ls.folders.set_trusted(as_mapping(params).get("trusted") is True)

    @server.feature(types.WINDOW_WORK_DONE_PROGRESS_CANCEL)
    def cancel_progress(ls: PreflightServer, params: types.WorkDoneProgressCancelParams) -> None:
        for session in ls.sessions:
            session.runs.cancel(params.token)
