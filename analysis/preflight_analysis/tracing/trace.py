"""A node and its configuration to its Interface: from the cache, or by a run in the sandbox."""

from __future__ import annotations

import functools
import hashlib
import logging
import os
import re
import threading
from collections.abc import Iterable
from contextlib import AbstractContextManager, nullcontext
from dataclasses import replace

from preflight_analysis.environment import catkin_python
from preflight_analysis.environment.model import Environment
from preflight_analysis.evaluation import names
from preflight_analysis.tracing import (
    compiled,
    interior,
    limits,
    nodelets,
    random_names,
    run,
    sandbox,
    stand_ins,
    x_server,
)
from preflight_analysis.tracing import recipe as recipes
from preflight_analysis.tracing.backend import Visible
from preflight_analysis.tracing.file_lock import file_lock
from preflight_analysis.tracing.interface import Interface, Outcome
from preflight_analysis.tracing.kept_traces import NO_PRELOAD, KeptTraces, preloaded, still_named, under_own_names
from preflight_analysis.tracing.observation import Observation, observe
from preflight_analysis.tracing.repositories import hidden_paths
from preflight_analysis.tracing.request import TraceRequest
from preflight_analysis.tracing.store import identity

_log = logging.getLogger(__name__)

_MISSING_MODULE = re.compile(r"ModuleNotFoundError: No module named '((\w+)[\w.]*)'\Z")
_OUT_OF_REACH = (
    "it needs '{}', which lies outside of the workspace and of what your environment names, and is not shown in the "
    "sandbox: name its folder in ROS_PACKAGE_PATH, PATH or --package-path"
)
_MASTER_ALONE = "only what a ROS master sees of it is known"


class Tracer(KeptTraces):
    """Traces nodes of one environment. Usable from several threads at once. Without `cache` each trace is a run."""

    @functools.cached_property
    def _visible(self) -> list[str]:
        return recipes.visible_paths(self.environment)

    @functools.cached_property
    def _repositories(self) -> tuple[str, ...]:
        return hidden_paths(self.environment)

    def trace(self, request: TraceRequest, cancel: threading.Event, *, fresh: bool = False) -> Interface:
        """The cached trace, or a new run; with `fresh` a new run in any case. Never raises: what stands in the way of a
        run is the outcome's reason.

        A node that the launch file does not name is run once more when its name is known, where its parameter files
        have something for that, and so is a process of several nodes; whatever names they then have, there is no third
        time."""
        found = self._trace(request, cancel, fresh=fresh)
        again = under_own_names(request, found)
        if again is None or cancel.is_set():
            return found
        return still_named(self._trace(again, cancel, fresh=fresh), found)

    def _trace(self, request: TraceRequest, cancel: threading.Event, *, fresh: bool) -> Interface:
        found = None if fresh else self.kept(request)
        if found is not None:
            return found
        with self._lock(request, cancel):
            found = None if fresh else self.kept(request)
            if found is not None:
                return found
            try:
                return self.finished(self._run(nodelets.alone(request), cancel), request)
            except Exception as error:
                _log.exception("tracing %s failed", request.node)
                return _not_run(f"the run failed: {error}")

    def _lock(self, request: TraceRequest, cancel: threading.Event) -> AbstractContextManager[object]:
        """Another process that shares the cache may be running the same node."""
        if self.cache is None:
            return nullcontext()
        digest = hashlib.sha256(repr(request).encode(errors="surrogatepass")).hexdigest()
        seconds = run.WALL_SECONDS + run.STRETCH_SECONDS + run.OUTER_SECONDS
        return file_lock(self.cache.folder / "locks" / f"{digest[:32]}.lock", cancel, seconds)

    def _run(self, request: TraceRequest, cancel: threading.Event) -> Interface:
        status = sandbox.probe()
        if not status.works:
            return _not_run(f"no sandbox: {status.reason}")
        if cancel.is_set():
            return _not_run("the run was cancelled")
        undeclared = nodelets.why_undeclared(request, self.environment, self._disk)
        if undeclared is not None:
            return _not_run(undeclared)
        before = _identities(request)
        built = self.libraries[request.generation].build() if preloaded(request) else NO_PRELOAD
        if not request.ros.has_master and built.reason is not None:
            return _not_run(built.reason)
        recipe = stand_ins.admitted(self.recipe(request, built.path), self.environment, request.generation)
        visible = sorted({*self._visible, *recipes.request_paths(self.environment, request, recipe)})
        hidden = recipes.out_of_reach(recipe, request.executable, visible)
        if hidden is not None:
            return _not_run(_OUT_OF_REACH.format(hidden))
        interpreter = self.environment.interpreter(request.generation) or recipes.any_python(self.environment)
        shown = Visible(tuple(visible), self._repositories)
        inside = run.Inside(shown, interpreter, cancel, compiled.copies().of(interpreter, shown))
        raw = run.execute(recipe, request.params, inside)
        screen = x_server.server() if (blind := x_server.lacking(raw)) else None
        if screen is not None:
            raw = run.execute(recipe, request.params, inside, screen)
        observed = observe(raw, recipe, request)
        if random_names.may_make_up(observed) and not cancel.is_set():
            changed = random_names.otherwise(recipe, observed)
            again = observe(run.execute(changed, request.params, inside, screen), changed, request)
            named = random_names.without_made_up(observed.interface, again.interface)
            observed = replace(observed, interface=named, lasting=observed.lasting and again.lasting)
        if blind and screen is None:
            observed = replace(observed, lasting=False, interface=x_server.explained(observed.interface))
        observed = replace(observed, interface=limits.explained(observed, visible))
        unbuilt = _unbuilt(observed.interface, self.environment, request.generation)
        unbuilt = unbuilt or nodelets.why_not_there(observed.interface, request, self.environment)
        unbuilt = unbuilt or _unnamed(observed.interface, request)
        if unbuilt is not None:
            return _not_run(unbuilt)
        if built.reason is not None:
            noted = replace(observed.interface, notes=(*observed.interface.notes, f"{_MASTER_ALONE}: {built.reason}"))
            observed = replace(observed, interface=noted)
        if status.narrow and not request.ros.has_master and _is_refused(observed.interface):
            return _not_run(
                f"it ended before it was up; the middleware may need what the sandbox by {status.backend} refuses"
            )
        if status.narrow and observed.interface.outcome.status == "crashed":
            observed = replace(observed, lasting=False, interface=_mark_speculative(observed.interface, status))
        lasting = observed.lasting and not nodelets.may_turn_up(observed.interface)
        lasting = lasting and not any(map(self.environment.access.is_text_elsewhere, _files(observed, recipe, visible)))
        if self.cache is not None and lasting and _identities(request) == before:
            self.cache.store(
                recipe,
                request,
                observed.interface,
                replace(observed.dependencies, files=(request.program, *_files(observed, recipe, visible))),
                listings={*_searched(observed, recipe, request), *observed.dependencies.searched},
                started=raw.started,
            )
        return observed.interface


def _unbuilt(found: Interface, environment: Environment, generation: int) -> str | None:
    """Why it is as if a node had not been run that ended for a module of the workspace that is there once that is
    built, of its messages say; None for any other."""
    missing = _MISSING_MODULE.search(found.outcome.reason or "") if found.outcome.status == "crashed" else None
    package = environment.packages.get(missing[2]) if missing is not None else None
    if missing is None or package is None or package.generation != generation:
        return None
    if package.is_ament:
        return f"it imports {package.name}, a package of the workspace whose Python modules are not built"
    if not catkin_python.generates_modules(package):
        return None
    return f"it imports {missing[1]}, which is not built yet: package '{package.name}' of the workspace makes it"


def _unnamed(found: Interface, request: TraceRequest) -> str | None:
    """Why it is as if a node had not been run that ended under a name with a value that is not known (`$(arg name)`),
    which ROS refuses; None for any other."""
    if found.outcome.status != "crashed" or names.is_legal(request.node):
        return None
    return f"its name is not known: '{request.node}'"


def _identities(request: TraceRequest) -> tuple[str, str]:
    return identity(request.executable), identity(request.program)


def _is_refused(found: Interface) -> bool:
    """Whether a node of ROS 2 may have failed for its middleware alone, which needs sockets and shared memory."""
    return found.outcome.status == "crashed" and all(each.builtin for each in found.endpoints)


def _mark_speculative(found: Interface, status: sandbox.SandboxStatus) -> Interface:
    said = f"it may have ended for what the sandbox by {status.backend} refuses; bubblewrap would refuse less"
    return replace(found, notes=(*found.notes, said))


def _files(observed: Observation, recipe: recipes.Recipe, visible: Iterable[str]) -> tuple[str, ...]:
    """What the trace depends on; our own library is known by its source."""
    return tuple(path for path in on_host(observed.dependencies.files, visible) if path != recipe.preload)


def on_host(files: Iterable[str], visible: Iterable[str]) -> tuple[str, ...]:
    """The sources of what was opened, without the files that were the sandbox's own: the host's of the same name are
    others. Fast DDS keeps its ports in `/dev/shm`, under the names that those of the host have."""
    sources = dict.fromkeys(_source(opened) for opened in files if not opened.startswith(("/dev/", "/proc/")))
    return tuple(path for path in sources if interior.shown(path, visible))


def _source(path: str) -> str:
    """The module that a compiled file was made from (PEP 3147), any other file itself."""
    folder, name = os.path.split(path)
    if os.path.basename(folder) == "__pycache__" and name.endswith(".pyc"):
        return os.path.join(os.path.dirname(folder), name.partition(".")[0] + ".py")
    return path


def _searched(observed: Observation, recipe: recipes.Recipe, request: TraceRequest) -> list[str]:
    """For a Python node that crashed: where a module that was missing could turn up."""
    if observed.interface.outcome.status != "crashed" or not recipe.python:
        return []
    opened = {os.path.dirname(_source(path)) for path in observed.dependencies.files if "-packages/" in path}
    roots = {path[: path.index("-packages/") + len("-packages")] for path in (p + "/" for p in opened)}
    entries = recipe.stable.get("PYTHONPATH", "").split(os.pathsep)
    folder = os.path.dirname(os.path.realpath(request.executable))
    return sorted({folder, *roots, *(e for e in entries if os.path.isabs(e))})


def _not_run(reason: str) -> Interface:
    return Interface("none", Outcome("not-run", reason=reason))
