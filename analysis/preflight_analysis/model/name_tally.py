"""Names that many set or ask for, with the namespaces around them, brought up to date name by name."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from preflight_analysis.dataclass import dataclass


@dataclass(frozen=True, slots=True, eq=False)
class NameTally:
    """Full names, each as often as it is there."""

    counts: Mapping[str, int]
    around: Mapping[str, int]
    """The namespaces that the names are in, up to but without the root, with how many names and namespaces are right in
    each: `/a` and `/a/b` of `/a/b/c`."""

    def __contains__(self, name: str) -> bool:
        return name in self.counts or name in self.around

    def changed(self, gone: Iterable[str], come: Iterable[str]) -> tuple[NameTally, set[str]]:
        """The tally without the names that are `gone`, with those that have `come`; and what may be in one of the two
        alone, names and namespaces."""
        more: dict[str, int] = {}
        for name in come:
            more[name] = more.get(name, 0) + 1
        for name in gone:
            more[name] = more.get(name, 0) - 1
        if not any(more.values()):
            return self, set()
        counts, around = dict(self.counts), dict(self.around)
        different: set[str] = set()
        for name, by in more.items():
            if by and _differs(counts, name, by):
                different.add(name)
                step = 1 if name in counts else -1
                space = name.rpartition("/")[0]
                while space and _differs(around, space, step):
                    different.add(space)
                    space = space.rpartition("/")[0]
        return NameTally(counts, around), different


def _differs(counts: dict[str, int], name: str, by: int) -> bool:
    """Count so many more of a name; whether it is there only now, or not any more."""
    before = counts.get(name, 0)
    if before + by:
        counts[name] = before + by
        return not before
    del counts[name]
    return True


NO_NAMES = NameTally({}, {})
