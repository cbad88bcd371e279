"""The nested scopes of a launch file: namespace, remaps, private parameters, environment, arguments, anonymous names.

The rules of what a child scope shares with its parent and what it copies are roslaunch's, odd ones included; each is
held by a test against the real one.
"""

from __future__ import annotations

from dataclasses import field, replace

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.span import LineIndex, Location, Origin, Span
from preflight_analysis.evaluation.before import Before
from preflight_analysis.evaluation.names import as_namespace, join
from preflight_analysis.evaluation.ros1.scope_arguments import Arguments
from preflight_analysis.evaluation.tree import Param, Remap


@dataclass(slots=True)
class Scope:
    """Where a tag is evaluated. `chain` are the include tags that led here, outermost first."""

    file: str
    lines: LineIndex
    """Those of the file."""
    chain: Origin
    ns: str
    parent: Scope | None = None
    own_remaps: list[Remap] = field(default_factory=list)
    private_params: list[Param] = field(default_factory=list)
    env: list[tuple[str, str]] = field(default_factory=list)
    arguments: Arguments = field(default_factory=Arguments)
    anonymous: dict[str, str] = field(default_factory=dict)
    pass_all_args: bool = False
    depth: int = 0
    """How many scopes are around this one."""

    def location(self, span: Span) -> Location:
        """A place in this scope's file."""
        return self.lines.location(self.file, span)

    def origin(self, span: Span) -> Origin:
        """The origin of a place in this scope's file."""
        return (*self.chain, self.location(span))

    def child(self, ns: str | None = None) -> Scope:
        """A scope below this one. Arguments and anonymous names are copied; what is set inside stays inside.

        An absolute `ns` replaces the namespace. Private parameters are shared as long as there are any: an include
        thereby passes them on, and back.
        """
        return Scope(
            self.file,
            self.lines,
            self.chain,
            as_namespace(join(self.ns, ns) if ns else self.ns),
            self,
            [],
            self.private_params or [],
            list(self.env),
            self.arguments.child(),
            dict(self.anonymous),
            depth=self.depth + 1,
        )

    def part(self, before: Before) -> Scope:
        """This scope as a tag in it sees it, which asks for its arguments."""
        return replace(self, arguments=Arguments(before.ask))

    def add_remap(self, remap: Remap) -> None:
        """A later remap of the same name replaces the earlier one."""
        for old in [r for r in self.own_remaps if r.source == remap.source]:
            self.own_remaps.remove(old)
            remap = remap._replace(replaces=(*old.replaces, old._replace(replaces=())))
        self.own_remaps.append(remap)

    def remaps(self) -> list[Remap]:
        """All that apply here: the outer ones first, less those that an inner one replaces."""
        found: list[Remap] = []
        for scope in self._outermost_first():
            if not scope.own_remaps:
                continue
            own = {r.source for r in scope.own_remaps}
            hidden = {r.source: r for r in found if r.source in own}
            found = [r for r in found if r.source not in own]
            found += (
                r._replace(replaces=(*old.replaces, old._replace(replaces=()), *r.replaces))
                if (old := hidden.get(r.source))
                else r
                for r in scope.own_remaps
            )
        return found

    def _outermost_first(self) -> list[Scope]:
        scopes, scope = [self], self.parent
        while scope is not None:
            scopes.append(scope)
            scope = scope.parent
        return scopes[::-1]

    def add_private(self, param: Param) -> None:
        """A `~param` for the nodes that come later in this scope."""
        for old in [p for p in self.private_params if p.name == param.name]:
            self.private_params.remove(old)
            param = param._replace(overrides=(*old.overrides, old._replace(overrides=())))
        self.private_params.append(param)
