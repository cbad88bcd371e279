"""What the calls of one node were found to make, each once, in order."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import Any

from preflight_analysis.evaluation import names
from preflight_analysis.source.branches import Branches
from preflight_analysis.tracing.interface import (
    IN_SOURCE,
    Endpoint,
    Evidence,
    Frame,
    FrameUse,
    MadeNode,
    ParamUse,
    Role,
)

_MAX_FOUND = 500
_MAX_NODES = 32
_MAX_FRAMES = 100
_LONGEST_FRAME = 200
_UNDER_CONDITION = IN_SOURCE.but("condition")
_NO_FRAME = re.compile(r"\s")


class Collector:
    """Collects endpoints and uses of parameters; those whose name is not known are left out."""

    def __init__(self) -> None:
        self._awaited: list[Endpoint] = []
        self._endpoints: dict[tuple[str, str, str | None], Endpoint] = {}
        self._uses: dict[tuple[str, str, bool], ParamUse] = {}
        self._nodes: dict[MadeNode, None] = {}
        self._frames: dict[tuple[str, str, bool], Frame] = {}
        self._frame_uses: dict[tuple[str, str], FrameUse] = {}
        self._broadcasts: set[tuple[str, int]] = set()
        self._alternatives = False
        self._unknown_nodes = False
        self._missed = False
        self._unnamed: dict[tuple[Role, str | None], None] = {}
        self._transitions: set[str] = set()
        self.branches = Branches()
        """Those of the program that is gone through."""

    @property
    def endpoints(self) -> tuple[Endpoint, ...]:
        """The ends found, in order; a service that is only waited for is one that is called."""
        called = {e.name for e in self._endpoints.values() if e.role == "client"}
        return (*self._endpoints.values(), *(e for e in self._awaited if e.name not in called))

    @property
    def unnamed(self) -> tuple[tuple[Role, str | None], ...]:
        """Role and type of the ends that were left out, each once."""
        return tuple(self._unnamed)

    @property
    def params(self) -> tuple[ParamUse, ...]:
        """The uses of parameters found, in order."""
        return tuple(self._uses.values())

    @property
    def nodes(self) -> tuple[MadeNode, ...]:
        """ROS 2: the nodes that the program makes; empty where that is not known, as they have several names in the
        branches of a condition for example."""
        ambiguous = self._unknown_nodes or (self._alternatives and len(self._nodes) > 1)
        return () if ambiguous else tuple(self._nodes)

    @property
    def frames(self) -> tuple[Frame, ...]:
        """The transforms that are broadcast, in order."""
        return tuple(self._frames.values())

    @property
    def frame_uses(self) -> tuple[FrameUse, ...]:
        """The frames that are asked for or put into messages, in order."""
        return tuple(self._frame_uses.values())

    @property
    def transitions(self) -> tuple[str, ...]:
        """Those that lifecycle nodes of the program make by themselves, sorted."""
        return tuple(sorted(self._transitions))

    @property
    def whole(self) -> bool:
        """Whether nothing is known of that was left out: every name is computed, and nobody else was given the node."""
        return not self._missed

    @property
    def _evidence(self) -> Evidence:
        """Of what is found at the place that is looked at."""
        return _UNDER_CONDITION if self.branches.speculative else IN_SOURCE

    @property
    def _evidence_of_frames(self) -> Evidence:
        """Likewise, of frames: callbacks count like the rest, as most transforms are broadcast in one."""
        return _UNDER_CONDITION if self.branches.inside else IN_SOURCE

    def miss(self) -> None:
        """There may be more than was found."""
        self._missed = True

    def node(self, name: Any, space: Any = "", *, renamed: bool = True) -> None:
        """One node that is made; `renamed` is whether it takes the name that the launch gives to the process."""
        if not is_name(name) or "/" in name or not isinstance(space, str) or len(self._nodes) >= _MAX_NODES:
            self._unknown_nodes = True
            return
        self._nodes[MadeNode(name, name, space.strip("/"), renamed, IN_SOURCE)] = None
        self._alternatives = self._alternatives or self.branches.speculative

    def transition(self, *names: str) -> None:
        """Transitions of a lifecycle node that the program makes."""
        self._transitions.update(names)

    def unknown_node(self) -> None:
        """There may be a node whose name is not known."""
        self._unknown_nodes = True

    def add_endpoint(self, endpoint: Endpoint) -> None:
        """One end that is made."""
        key = (endpoint.role, endpoint.name, endpoint.type)
        if is_name(endpoint.name) and len(self._endpoints) < _MAX_FOUND:
            before = self._endpoints.get(key)
            if before is None:
                self._endpoints[key] = replace(endpoint, evidence=self._evidence)
            elif before.evidence.doubts and not self.branches.speculative:
                self._endpoints[key] = replace(before, evidence=self._evidence)
        else:
            self._unnamed[endpoint.role, endpoint.type] = None
            self.miss()

    def await_service(self, endpoint: Endpoint) -> None:
        """A service that is waited for."""
        if is_name(endpoint.name):
            self._awaited.append(endpoint)
        else:
            self.miss()

    def use(self, use: ParamUse) -> None:
        """One use of a parameter."""
        if len(self._uses) < _MAX_FOUND:
            key = (use.name, use.access, use.has_default)
            before = self._uses.get(key)
            if before is None:
                self._uses[key] = replace(use, evidence=self._evidence)
            elif before.evidence.doubts and not self.branches.speculative:
                self._uses[key] = replace(before, evidence=self._evidence)
        else:
            self.miss()

    def broadcast(self, parent: Any, child: Any, static: bool, file: str, line: int) -> None:
        """A transform that is broadcast; a frame that is not known is noted as such."""
        if len(self._frames) >= _MAX_FRAMES:
            return
        self._broadcasts.add((file, line))
        named = Frame(_frame(parent), _frame(child), static, self._evidence_of_frames, file, line)
        key = (named.parent, named.child, static)
        before = self._frames.get(key)
        if before is None or (before.evidence.conditional and not named.evidence.conditional):
            self._frames[key] = named

    def expect_broadcast(self, file: str, first: int, last: int) -> None:
        """Lines that broadcast a transform: where none of them was come to, a flag or a parameter keeps it from that,
        and more frames than are known may follow."""
        if not any(path == file and first <= line <= last for path, line in self._broadcasts):
            self._frames.setdefault(("", "", False), Frame("", "", False, _UNDER_CONDITION, file, first))

    def use_frame(self, frame: Any, call: str, looked_up: bool, file: str, line: int) -> None:
        """A frame that is asked for, or stands in a message that is published."""
        named = _frame(frame)
        if not named or len(self._frame_uses) >= _MAX_FRAMES:
            return
        use = FrameUse(named, call, looked_up, self._evidence_of_frames, file, line)
        before = self._frame_uses.get((named, call))
        if before is None or (before.evidence.conditional and not use.evidence.conditional):
            self._frame_uses[named, call] = use


def _frame(value: Any) -> str:
    """The name of a frame, empty where it is not known or can be none."""
    return value if isinstance(value, str) and len(value) < _LONGEST_FRAME and not _NO_FRAME.search(value) else ""


def is_name(value: Any) -> bool:
    """Whether it is a name that is known and could be one in ROS."""
    return isinstance(value, str) and bool(value) and len(value) < 500 and names.is_legal(value)
