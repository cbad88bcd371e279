"""What nodes of a running system do, as interfaces that can be written down: for nodes that cannot be run elsewhere.

A running system shows final names. They are turned back into what the node must have called them, so that the
annotation holds when the launch file gives the node another name, namespace or remap.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import yaml

from preflight_analysis.dataclass import dataclass
from preflight_analysis.evaluation import names
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.generation import ros
from preflight_analysis.graph.annotations import CLASSES, worth_writing
from preflight_analysis.graph.build import effective_remaps
from preflight_analysis.graph.model import Graph
from preflight_analysis.live.compare import matched
from preflight_analysis.live.model import LiveEndpoint, Observation, is_builtin
from preflight_analysis.tracing.interface import Endpoint, Interface, Outcome
from preflight_analysis.tracing.nodelets import nodelet_of
from preflight_analysis.tracing.request import split_args


@dataclass(frozen=True, slots=True)
class Captured:
    """A node of the launch and what it was seen to do; without an interface `reason` says why."""

    node: LaunchNode
    interface: Interface | None
    reason: str | None = None


def capture(graph: Graph, chosen: Iterable[LaunchNode], live: Observation) -> list[Captured]:
    """The interfaces of the chosen ones of a launch's nodes."""
    nodes = graph.tree.nodes
    running_as, _ = matched((node.name for node in nodes), live)
    endpoints: dict[str, list[LiveEndpoint]] = {}
    for endpoint in live.endpoints:
        if not is_builtin(live.generation, endpoint.role, endpoint.name):
            endpoints.setdefault(endpoint.node, []).append(endpoint)
    return [_captured(node, nodes, running_as.get(node.name), endpoints, live) for node in chosen]


def _captured(
    node: LaunchNode,
    nodes: Sequence[LaunchNode],
    name: str | None,
    endpoints: Mapping[str, Sequence[LiveEndpoint]],
    live: Observation,
) -> Captured:
    if name is None:
        unnamed = "" if node.named else "; the launch file does not name it, so its name may differ"
        return Captured(node, None, f"it is not running{unnamed}")
    if (dead := live.nodes[name].dead) is not None:
        return Captured(node, None, f"it is registered but does not answer: {dead}")
    if live.nodes[name].count > 1:
        return Captured(node, None, "several nodes have this name")
    if ros(live.generation).has_nodelets and (reason := _of_nodelets(node, nodes)) is not None:
        return Captured(node, None, reason)
    sources = {target: source for source, (_, target) in effective_remaps(node, live.generation).items()}
    found = (
        Endpoint(endpoint.role, _as_given(endpoint.name, name, node, sources), endpoint.type)
        for endpoint in sorted(endpoints.get(name, ()), key=lambda endpoint: (endpoint.role, endpoint.name))
    )
    return Captured(node, Interface("annotation", Outcome("not-run"), tuple(found)))


def _of_nodelets(node: LaunchNode, nodes: Sequence[LaunchNode]) -> str | None:
    """Why the ends of a nodelet, or of the manager of some, cannot be told apart."""
    of = nodelet_of(node.package, node.executable, split_args(node.args))
    if of is not None and of.manager is not None:
        return "the master lists the endpoints of a nodelet under its manager"
    for other in nodes:
        loaded = nodelet_of(other.package, other.executable, split_args(other.args))
        if loaded is not None and loaded.manager is not None and names.resolve(loaded.manager, other.name) == node.name:
            return f"the master lists the endpoints of {other.name} under this node"
    return None


def _as_given(final: str, live_name: str, node: LaunchNode, sources: Mapping[str, str]) -> str:
    """What the node calls it, if need be before a remap: a private or relative name where that is the same."""
    # An anonymous name is another one in each run. What a node without a name is called is its own business.
    below = node.named and final.startswith(f"{live_name}/")
    full = node.name + final[len(live_name) :] if below else final
    full = sources.get(full, full)
    if full.startswith(f"{node.name}/"):
        return f"~{full[len(node.name) + 1 :]}"
    namespace = names.parent(node.name)
    return full[len(namespace) :] if full.startswith(namespace) else full


def settings_text(captured: Sequence[Captured], nodes: Sequence[LaunchNode]) -> str:
    """The `nodes` of a settings file (`.ros-preflight.yaml`), by executable where one node of the launch is of it."""
    entries = []
    for each in captured:
        if each.interface is None:
            continue
        node = each.node
        alone = sum((n.package, n.executable) == (node.package, node.executable) for n in nodes) == 1
        entry: dict[str, Any] = (
            {"package": node.package, "executable": node.executable} if alone else {"name": node.name}
        )
        for what in worth_writing(each.interface):
            if isinstance(what, Endpoint):
                group, word = next((g, w) for g, of in CLASSES.items() for w, role in of.items() if role == what.role)
                item = {"name": what.name, "type": what.type or "*", "class": word}
                entry.setdefault(group, []).append(item)
        entries.append(entry)
    text: str = yaml.safe_dump({"nodes": entries}, sort_keys=False, allow_unicode=True, width=120)
    return text
