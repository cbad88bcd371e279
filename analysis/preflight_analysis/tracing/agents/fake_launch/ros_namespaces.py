"""`launch_ros.utilities.namespace_utils`."""

from __future__ import annotations

from typing import Optional


def prefix_namespace(base_ns: Optional[str], ns: Optional[str]) -> Optional[str]:
    combined = base_ns
    if ns is not None:
        combined = ns if not base_ns or ns.startswith("/") else (("" if base_ns == "/" else base_ns) + "/" + ns)
    return combined.rstrip("/") if combined is not None and combined != "/" else combined


def make_namespace_absolute(ns: Optional[str]) -> Optional[str]:
    return ns if ns is None or ns.startswith("/") else "/" + ns


def is_root_namespace(ns: str) -> bool:
    return ns == "/"


def is_namespace_absolute(ns: str) -> bool:
    return ns.startswith("/")
