"""Where a document of NoDL (version 2) has the ends of each kind."""

from __future__ import annotations

from collections.abc import Mapping

from preflight_analysis.tracing.interface import Role

GROUPS: Mapping[Role, str] = {
    "publisher": "publishers",
    "subscriber": "subscriptions",
    "service": "service_servers",
    "client": "service_clients",
    "action_server": "action_servers",
    "action_client": "action_clients",
}
