"""Names that are known, and whether there may be others."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Generic, TypeVar

from preflight_analysis.dataclass import dataclass
from preflight_analysis.findings.doubt import Doubt

V = TypeVar("V")


@dataclass(frozen=True, slots=True)
class NameSet(Generic[V]):
    """Names, each with where it is from, and `open_because`: why there may be more. What is not in a closed one is not
    there."""

    names: Mapping[str, V]
    open_because: tuple[Doubt, ...] = ()

    @property
    def closed(self) -> bool:
        """Whether these are all."""
        return not self.open_because

    def __contains__(self, name: object) -> bool:
        return name in self.names
