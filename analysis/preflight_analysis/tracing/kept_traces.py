"""Traces of earlier runs, looked up without what it takes to run something."""

from __future__ import annotations

import logging
from dataclasses import replace

from preflight_analysis.documents.disk import Disk
from preflight_analysis.environment import ament_python, catkin_python
from preflight_analysis.environment.model import Environment
from preflight_analysis.evaluation import names
from preflight_analysis.tracing import node_recipe, nodelets, preload
from preflight_analysis.tracing.cache import TraceCache
from preflight_analysis.tracing.interface import Interface
from preflight_analysis.tracing.recipe import Recipe
from preflight_analysis.tracing.request import TraceRequest
from preflight_analysis.tracing.service_types import ServiceTypes

_log = logging.getLogger(__name__)

NO_PRELOAD = preload.Preload(None)


class KeptTraces:
    """Looks up the traces of nodes of one environment. Usable from several threads at once; runs nothing. `library` is
    what watches roscpp nodes, if not the one in the user's cache folder. `disk` has the sources of packages that are
    not built."""

    def __init__(
        self,
        environment: Environment,
        cache: TraceCache | None,
        library: preload.Library | None = None,
        disk: Disk | None = None,
    ) -> None:
        self.environment = environment
        self._disk = disk or Disk()
        self.cache = cache
        self.libraries = {1: library or preload.library(1), 2: preload.library(2)}
        self._services = ServiceTypes(environment)

    def recipe(self, request: TraceRequest, preload_path: str | None) -> Recipe:
        """What a run of the request would be."""
        folders = ament_python.module_folders if request.ros.ament else catkin_python.source_folders
        modules = folders(self._disk, self.environment)
        return node_recipe.make(self.environment, request, preload_path, modules)

    def lookup(self, request: TraceRequest) -> Interface | None:
        """A cached trace that is still valid; nothing is run."""
        found = self.kept(request)
        again = under_own_names(request, found) if found is not None else None
        if found is None or again is None:
            return found
        then = self.kept(again)
        return still_named(then, found) if then is not None else None

    def kept(self, request: TraceRequest) -> Interface | None:
        """Likewise, for exactly this request."""
        if self.cache is None:
            return None
        alone = nodelets.alone(request)
        try:
            planned = self.libraries[request.generation].planned() if preloaded(alone) else NO_PRELOAD
            found = self.cache.load(self.recipe(alone, planned.path), alone)
            return self.finished(found, request) if found is not None else None
        except Exception:
            _log.exception("looking up a trace of %s failed", request.node)
            return None

    def finished(self, found: Interface, request: TraceRequest) -> Interface:
        """What the run of the node alone does not tell, and depends on more than it did."""
        return nodelets.with_manager(self._services.name_clients(found), request)


def under_own_names(request: TraceRequest, found: Interface) -> TraceRequest | None:
    """The run with the parameters for the names that a first run told; None where it had them all."""
    if not request.sections:
        return None
    if request.component is not None:
        return request.beside(_given_by_container(request, found))
    if found.names:
        return request.under_each(found.names)
    if request.named:
        return None
    name = found.own_name(names.parent(request.node))
    return request.under(name) if name is not None else None


def _given_by_container(request: TraceRequest, found: Interface) -> list[str]:
    """The full names of the nodes that the arguments of the container's process count for."""
    own = request.node if request.named else found.own_name(names.parent(request.node))
    given = [node.full or own for node in found.nodes if not node.hidden and not node.own_arguments_only]
    return [name for name in dict.fromkeys(given) if name is not None]


def still_named(then: Interface, first: Interface) -> Interface:
    """A second run with the names of the first, where it ended before it made any."""
    return then if then.nodes or not then.known else replace(then, nodes=first.nodes)


def preloaded(request: TraceRequest) -> bool:
    """Whether it is a node in C++, as far as can be told before it runs."""
    return request.entry_point is None and preload.applies(request.program)
