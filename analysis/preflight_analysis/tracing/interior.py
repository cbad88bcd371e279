"""What of the host is seen inside of the sandbox, and where what is ours lies there; it starts nothing."""

from __future__ import annotations

import functools
import os
from collections.abc import Iterable

from preflight_analysis.documents.secrets import within

PRIVATE = "/run/preflight"
"""What is ours inside: `lib` with the agents and aspectlib, `site` with `sitecustomize.py`, and the pipe `events`."""
LIBRARY = f"{PRIVATE}/lib"
"""Where the agents (as package `preflight_agents`) and aspectlib are, inside."""
SITE = f"{PRIVATE}/site"
"""The folder with `sitecustomize.py`, inside."""


def masked(path: str) -> bool:
    """Whether `path` lies in what is hidden inside, unless it is bound back."""
    return any(within(path, root) for root in mask_roots())


def shown(path: str, visible: Iterable[str]) -> bool:
    """Whether the host's file is the one that is seen inside, when `visible` is bound back."""
    return not masked(path) or any(within(path, root) for root in visible)


def needs_binding(paths: Iterable[str]) -> list[str]:
    """Of `paths`, the existing ones that are hidden inside, each as given and resolved, outermost only.

    A folder that holds all of a masked one (a package path of `~`, say) is left out: it would show everything in it.
    """
    masks = mask_roots()
    held = (*masks, home())
    wanted: set[str] = set()
    for path in dict.fromkeys(paths):
        if not path or not os.path.isabs(path):
            continue
        for form in {os.path.normpath(path), os.path.realpath(path)}:
            too_much = any(within(root, form) for root in held)
            if any(within(form, root) for root in masks) and not too_much and os.path.lexists(form):
                wanted.add(form)
    kept: list[str] = []
    for path in sorted(wanted):
        if not any(within(path, outer) for outer in kept):
            kept.append(path)
    return kept


def home() -> str:
    """The home folder inside: the user's own, but empty save for what was bound back."""
    found = os.path.realpath(os.path.expanduser("~"))
    return found if os.path.isdir(found) and found != "/" else "/tmp/home"  # noqa: S108


@functools.lru_cache(maxsize=8)
def _masks_for(home_folder: str) -> tuple[str, ...]:
    roots = {"/tmp", "/var/tmp", "/run", "/home", "/root", home_folder}  # noqa: S108
    existing = sorted({os.path.realpath(root) for root in roots if os.path.isdir(root)} - {"/"})
    return tuple(root for root in existing if not any(within(root, o) for o in existing if o != root))


def mask_roots() -> tuple[str, ...]:
    """The folders of the host that are empty inside, but for what is bound back."""
    return _masks_for(home())
