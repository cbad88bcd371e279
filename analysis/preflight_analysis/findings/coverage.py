"""How much was looked at: which launch files were evaluated, and how it is known what nodes do."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field

from preflight_analysis.dataclass import dataclass

WAYS: Mapping[str, str] = {
    "trace": "run",
    "similar": "by another run",
    "annotation": "annotated",
    "settings": "by settings",
    "nodl": "by NoDL",
    "source": "by source",
    "catalogue": "by catalogue",
    "none": "unknown",
}
"""The sources of interfaces, in words, from the surest to none."""


@dataclass(frozen=True, slots=True)
class Coverage:
    """`files` launch files were looked at, of which `evaluated` were evaluated as a whole. `nodes` counts nodes by the
    source of their interface (`WAYS`), `untried` the tags left out by conditions that were not looked into.
    `not_evaluated` has the paths of the files that were not evaluated as a whole, `unknown_nodes` the names of the
    nodes of which nothing is known. `other_files` and `packages` were checked for themselves."""

    files: int = 0
    evaluated: int = 0
    nodes: Mapping[str, int] = field(default_factory=dict)
    untried: int = 0
    not_evaluated: tuple[str, ...] = ()
    unknown_nodes: tuple[str, ...] = ()
    other_files: int = 0
    packages: int = 0

    @property
    def total_nodes(self) -> int:
        """All nodes."""
        return sum(self.nodes.values())

    def __str__(self) -> str:
        """`40 of 41 launch files evaluated, 31 nodes: 12 run, 15 by source, 2 by catalogue, 2 unknown`."""
        others = self._others()
        if not self.files and others:
            return f"no launch files; {others}"
        ordered = sorted(self.nodes, key=lambda source: (source == "none", [*WAYS, source].index(source)))
        known = ", ".join(
            f"{self.nodes[source]} {WAYS.get(source, source)}" for source in ordered if self.nodes[source]
        )
        files = f"{self.evaluated} of {_counted(self.files, 'launch file')} evaluated"
        nodes = _counted(self.total_nodes, "node")
        untried = f"; {_counted(self.untried, 'tag')} that conditions leave out not looked into" if self.untried else ""
        return f"{files}, {nodes}" + (f": {known}" if known else "") + untried + (f"; {others}" if others else "")

    def _others(self) -> str:
        counted = [_counted(self.other_files, "other file")] if self.other_files else []
        # With launch files the packages are those that none of them reaches: of no interest.
        counted += [_counted(self.packages, "package")] if self.packages and not self.files else []
        return f"{' and '.join(counted)} checked" if counted else ""


def _counted(number: int, what: str) -> str:
    return f"{number} {what}{'' if number == 1 else 's'}"
