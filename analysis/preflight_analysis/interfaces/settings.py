"""What the settings of a project say of nodes (`nodes` in .ros-preflight.yaml)."""

from __future__ import annotations

from preflight_analysis.dataclass import dataclass
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.tracing.interface import Endpoint, ParamUse


@dataclass(frozen=True, slots=True)
class NodeSettings:
    """What the settings say of nodes: those of an executable of a package, or the one of a full name."""

    package: str | None
    executable: str | None
    name: str | None
    endpoints: tuple[Endpoint, ...]
    params: tuple[ParamUse, ...]

    def speaks_of(self, node: LaunchNode) -> bool:
        """Whether the node is one of them."""
        given = ((self.name, node.name), (self.package, node.package), (self.executable, node.executable))
        return all(asked in (None, found) for asked, found in given)
