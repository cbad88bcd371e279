"""`initialize`, `initialized`, `shutdown`, and what the client must be asked to tell us."""

from __future__ import annotations

import asyncio
import logging
from typing import TYPE_CHECKING

from lsprotocol import types

from preflight_server.lsp.features.workspace import own_settings

if TYPE_CHECKING:
    from preflight_server.lsp.app import PreflightServer

_log = logging.getLogger(__name__)

_WATCHED = (
    "**/*.xml",
    "**/*.{launch,test,machine}",
    "**/*.{yaml,yml}",
    "**/*.{xacro,urdf,srdf,sdf}",
    "**/*.{py,msg,srv,action}",
    "**/{scripts,nodes,bin}/**",
)


async def _register(ls: PreflightServer) -> None:
    workspace = ls.client_capabilities.workspace
    registrations = []
    watched = workspace.did_change_watched_files if workspace else None
    if watched is not None and watched.dynamic_registration:
        watchers = [types.FileSystemWatcher(glob) for glob in _WATCHED]
        options = types.DidChangeWatchedFilesRegistrationOptions(watchers)
        registrations.append(types.Registration("watched", types.WORKSPACE_DID_CHANGE_WATCHED_FILES, options))
    configured = workspace.did_change_configuration if workspace else None
    if configured is not None and configured.dynamic_registration:
        section = types.DidChangeConfigurationRegistrationOptions(section="rosPreflight")
        registrations.append(types.Registration("settings", types.WORKSPACE_DID_CHANGE_CONFIGURATION, section))
    if registrations:
        try:
            await ls.client_register_capability_async(types.RegistrationParams(registrations))
        except (Exception, asyncio.CancelledError) as error:
            _log.info("the client does not report changes of files or settings: %s", error)


def register(server: PreflightServer) -> None:
    """Register the handlers."""

    @server.feature(types.INITIALIZE)
    def initialize(ls: PreflightServer, params: types.InitializeParams) -> None:
        ls.initialise(params)

    @server.feature(types.INITIALIZED)
    async def initialized(ls: PreflightServer, params: types.InitializedParams) -> None:
        ls.spawn(_register(ls))
        ls.status.send()
        if len(ls.sessions) > 1:
            ls.spawn(own_settings(ls))
        for session in ls.sessions:
            await session.workspace()  # detect the environment while the user still reads
            session.indexing.changed(None)

    @server.feature(types.SHUTDOWN)
    async def shutdown(ls: PreflightServer, params: None) -> None:
        if ls.folders is not None:
            await asyncio.get_running_loop().run_in_executor(None, ls.folders.close)
