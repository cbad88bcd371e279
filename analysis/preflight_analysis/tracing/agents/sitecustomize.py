"""Loaded by every Python process of the node before its own code: hooks the import of rospy and notes opened files."""

from __future__ import annotations

import os
import sys


def _install() -> None:
    if "PREFLIGHT_EVENTS" not in os.environ:
        return
    here = os.path.dirname(os.path.abspath(__file__))
    library = os.path.join(os.path.dirname(here), "lib")
    sys.path.insert(0, library)
    try:
        from preflight_agents import hooks  # type: ignore[import-not-found]  # noqa: PLC0415

        hooks.install(library)
    finally:
        sys.path.remove(library)


def _chain() -> None:
    """Run the `sitecustomize` that this one hides, as the interpreter would have."""
    import importlib.machinery  # noqa: PLC0415
    import importlib.util  # noqa: PLC0415

    here = os.path.dirname(os.path.abspath(__file__))
    sys.path[:] = [entry for entry in sys.path if os.path.abspath(entry) != here]
    spec = importlib.machinery.PathFinder.find_spec("sitecustomize", sys.path)
    if spec is None or spec.loader is None:
        return
    module = importlib.util.module_from_spec(spec)
    sys.modules["sitecustomize"] = module
    spec.loader.exec_module(module)


try:
    _install()
except Exception:  # a node that cannot be watched still runs: the master sees the rest
    pass
_chain()
