"""Nodes with windows: they are run again with an X server of the sandbox's own, where one is installed.

The user's own X server is out of a node's reach. Which nodes need one shows only when they end for the lack of it;
the toolkits (Qt, GTK, wx, Tk, Ogre, GLFW) each say so in words of their own.
"""

from __future__ import annotations

import re
import shutil
from dataclasses import replace

from preflight_analysis.tracing.interface import Interface
from preflight_analysis.tracing.run import RawRun

PROGRAM = "Xvfb"
_PATH = "/usr/local/bin:/usr/bin:/bin"
_LACKING = re.compile(rb"display|x ?server|x11", re.IGNORECASE)


def lacking(raw: RawRun) -> bool:
    """Whether the node seems to have ended because there is no X server."""
    ends = [own for record in raw.records if isinstance(own := record.get("own"), dict) and own.get("ev") == "end"]
    ended = bool(ends) and ends[-1].get("status") == "ended" and ends[-1].get("code") != 0
    return ended and _LACKING.search(raw.stderr) is not None


def explained(interface: Interface) -> Interface:
    """The interface of a node that would have been given an X server if there were one."""
    note = f"it seems to need an X server: with {PROGRAM} installed it is run with one"
    return replace(interface, notes=(*interface.notes, note))


def server() -> str | None:
    """The X server without a screen, where it is installed."""
    return shutil.which(PROGRAM, path=_PATH)
