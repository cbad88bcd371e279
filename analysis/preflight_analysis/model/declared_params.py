"""The parameters that a node declares, and those that it is given and does not (ROS 2)."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator
from typing import NamedTuple

from preflight_analysis.catalogue.packages import distribution_of
from preflight_analysis.evaluation.ros2.spawners import MANAGER
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.findings.doubt import doubts
from preflight_analysis.model.context import Context
from preflight_analysis.model.name_set import NameSet
from preflight_analysis.model.nearest import is_slip, nearest, without_numbers
from preflight_analysis.model.param_matching import reports_params
from preflight_analysis.model.parameters import OF_ALL_NODES
from preflight_analysis.model.params_in_sources import may_be_made
from preflight_analysis.tracing.interface import Interface, ParamUse

_PREFIXES = ("qos_overrides.",)
_MANY = 10
"""Parameters that are most of those of a node which takes others too."""
_OF_TRANSPORT = re.compile(
    r"\.(?:(?:en|dis)able_pub_plugins|(?:compressed|compressedDepth|theora|zstd|ffmpeg|draco|zlib|cloudini)\.\w+)\Z"
)
"""What image_transport and point_cloud_transport declare for each topic that they publish."""


class Undeclared(NamedTuple):
    """A parameter that its node does not declare, and the declared one that was probably meant."""

    meant: str | None


def declared_params(node: LaunchNode, interface: Interface) -> NameSet[ParamUse] | None:
    """Those of a node; None of one that takes any that it is given, and where nothing is known of them. One of the
    catalogue that takes others too has many of its own."""
    uses = interface.params
    if (not uses and not reports_params(interface)) or interface.source == "none":
        return None
    names = {use.name.removeprefix("~"): use for use in uses if use.access != "list"}
    takes_more = _takes_more(node, interface)
    if takes_more and not (len(names) >= _MANY and all(use.evidence.of_catalogue for use in uses)):
        return None
    is_whole = interface.tells_all("parameters") and not takes_more
    return NameSet(names, doubts(NOT_ANALYSED="" if is_whole else node.name))


def _takes_more(node: LaunchNode, interface: Interface) -> bool:
    return any(use.access == "list" for use in _of_node(node, interface.params))


def undeclared(
    context: Context, node: LaunchNode, interface: Interface, declared: NameSet[ParamUse], name: str, file: str
) -> Undeclared | None:
    """What is so of a parameter that `file` gives to a node, which has `declared` these; None where the node declares
    it, or may well do so."""
    if name in declared or name in OF_ALL_NODES or name.startswith(_PREFIXES):
        return None
    if _OF_TRANSPORT.search(name):
        return None
    package = context.environment.packages.get(node.package)
    if package in context.environment.own_packages and may_be_made(context.disk.db, package.share, name):
        return None
    if not declared.closed and without_numbers(name) in set(map(without_numbers, declared.names)):
        return None  # one of a row, `odom1` beside `odom0`, of which the node may take as many as it is given
    given = {param.name for param in node.params if param.place.file == file}
    free = [each for each in declared.names if each not in given]
    near = _near(name, free) or _in_other_group(name, free)
    if _takes_more(node, interface) and not (_is_of_catalogue(context) and near is not None and is_slip(name, near)):
        return None  # it may be one of the others, or one of another version
    if near is None and is_controller(node):
        return None  # a library's base declares all that is set; names may be made of those of joints
    if near is None and interface.source == "trace" and interface.outcome.status in ("crashed", "timed-out"):
        return None  # it may have come to it later
    return Undeclared(near)


def _is_of_catalogue(context: Context) -> bool:
    """Whether the distribution that is used is the one that the catalogue has."""
    distro = context.environment.distro
    return distro is not None and distro == distribution_of(context.tree.generation, distro)


def is_controller(node: LaunchNode) -> bool:
    """Whether a controller manager makes it, of ros2_control."""
    return node.within is not None and (node.package, node.executable) == MANAGER


def _of_node(node: LaunchNode, uses: Iterable[ParamUse]) -> Iterator[ParamUse]:
    """Without what the library's base of a controller does to all parameters."""
    return (use for use in uses if not (use.name == "/" and use.evidence.of_catalogue and is_controller(node)))


def _in_other_group(name: str, others: Iterable[str]) -> str | None:
    """The only parameter of the same name that is in a group, where `name` is in none, or the other way round."""
    found = [each for each in others if each.endswith(f".{name}") or name.endswith(f".{each}")]
    return found[0] if len(found) == 1 else None


def _near(name: str, others: Collection[str]) -> str | None:
    """The parameter that was probably meant; what all of a section share says nothing."""
    near = nearest(name, others)
    if near is None:
        return None
    (above, _, leaf), (other_above, _, other) = name.rpartition("."), near.rpartition(".")
    return near if above != other_above or nearest(leaf, (other,)) is not None else None
