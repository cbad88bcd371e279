"""What a run depended on, beside what it was started with."""

from __future__ import annotations

from preflight_analysis.dataclass import dataclass


@dataclass(frozen=True, slots=True)
class ParamDependency:
    """A look at the parameter server. `name` is as the node gave it if `given`, else the full name."""

    access: str
    name: str
    given: bool


@dataclass(frozen=True, slots=True)
class Dependencies:
    """What the run depended on. `asked` has `name`, `namespace`, `remaps` if the node looked at them itself."""

    files: tuple[str, ...] = ()
    params: tuple[ParamDependency, ...] = ()
    asked: frozenset[str] = frozenset()
    searched: tuple[str, ...] = ()
    """Folders in which a module could turn up that had a stand-in."""
