"""Places for boxes that stand in one another: what is connected by the engine, and all that is not side by side."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import field

from preflight_analysis.dataclass import dataclass
from preflight_analysis.view.engine import PADDING, Engine, Point, Size
from preflight_analysis.view.packing import pack

ASPECT = 1.6
"""How many times as wide as high a picture is at best: that of a window."""
GAP = 24.0
"""Pixels between what is not connected."""
Line = tuple[int, int]


@dataclass(frozen=True, slots=True)
class Piece:
    """Some of a picture, with its own upper left corner at (0, 0): corners of boxes, corners and sizes of the boxes
    around them, and points of lines, each by position."""

    size: Size
    corners: Mapping[int, Point] = field(default_factory=dict)
    around: Mapping[int, tuple[Point, Size]] = field(default_factory=dict)
    routes: Mapping[int, tuple[Point, ...]] = field(default_factory=dict)

    def moved(self, by: Point) -> Piece:
        """The same elsewhere."""
        dx, dy = by

        def at(point: Point) -> Point:
            return round(point[0] + dx, 1), round(point[1] + dy, 1)

        return Piece(
            self.size,
            {box: at(corner) for box, corner in self.corners.items()},
            {group: (at(corner), size) for group, (corner, size) in self.around.items()},
            {line: tuple(map(at, points)) for line, points in self.routes.items()},
        )


@dataclass(frozen=True, slots=True)
class _Open:
    """A group out of which lines lead: it is laid out with what is around it. `block` is what has none."""

    group: int
    boxes: tuple[int, ...]
    inner: tuple[_Open, ...]
    block: Piece | None


def place(
    engine: Engine,
    sizes: Sequence[Size],
    lines: Sequence[Line],
    group_of: Sequence[int | None],
    parents: Sequence[int | None],
) -> list[Piece]:
    """The parts of the picture that nothing connects. `group_of` has the group of each box, `parents` that of each
    group; a group comes after the one that it is in. Raises `EngineError`."""
    return _Placer(engine, sizes, lines, group_of, parents).islands()


def joined(pieces: Sequence[Piece]) -> tuple[list[Piece], Size]:
    """Each at its place beside the others, and the extent of all."""
    corners, size = pack([piece.size for piece in pieces], ASPECT, GAP)
    return [piece.moved(corner) for piece, corner in zip(pieces, corners, strict=True)], size


class _Placer:
    def __init__(
        self,
        engine: Engine,
        sizes: Sequence[Size],
        lines: Sequence[Line],
        group_of: Sequence[int | None],
        parents: Sequence[int | None],
    ) -> None:
        self._engine = engine
        self._sizes = sizes
        self._lines = lines
        self._boxes: dict[int | None, list[int]] = {}
        for box, group in enumerate(group_of):
            self._boxes.setdefault(group, []).append(box)
        self._inner: dict[int | None, list[int]] = {}
        for group, parent in enumerate(parents):
            self._inner.setdefault(parent, []).append(group)
        # All groups that a box is in.
        self._in: list[frozenset[int | None]] = []
        for group in group_of:
            around: set[int | None] = {None}
            innermost = group
            while innermost is not None:
                around.add(innermost)
                innermost = parents[innermost]
            self._in.append(frozenset(around))

    def islands(self) -> list[Piece]:
        closed, _, _ = self._parts(None)
        return closed

    def _settled(self, group: int) -> Piece | _Open:
        closed, boxes, inner = self._parts(group)
        block = _block(closed) if closed else None
        if boxes or inner:
            return _Open(group, tuple(boxes), tuple(inner), block)
        assert block is not None
        width, height = block.size
        size = width + 2 * PADDING, height + 2 * PADDING
        within = block.moved((PADDING, PADDING))
        return Piece(size, within.corners, {**within.around, group: ((0.0, 0.0), size)}, within.routes)

    def _parts(self, group: int | None) -> tuple[list[Piece], list[int], list[_Open]]:
        """What of a group is connected to nothing outside of it, laid out, and the rest of it."""
        closed: list[Piece] = []
        inner: list[_Open] = []
        for each in self._inner.get(group, ()):
            settled = self._settled(each)
            if isinstance(settled, _Open):
                inner.append(settled)
            else:
                closed.append(settled)
        boxes: list[int] = []
        opened: list[_Open] = []
        for members, goes_out in self._components(group, inner):
            some = [each for each in members if isinstance(each, int)]
            others = [each for each in members if isinstance(each, _Open)]
            if goes_out:
                boxes += some
                opened += others
            else:
                closed.append(self._laid_out(some, others))
        return closed, boxes, opened

    def _components(self, group: int | None, inner: Iterable[_Open]) -> Iterable[tuple[list[int | _Open], bool]]:
        """What of a group hangs together, and whether a line leads from it out of the group."""
        members: list[int | _Open] = [*self._boxes.get(group, ()), *inner]
        of: dict[int, int] = {}
        for i, member in enumerate(members):
            of.update((box, i) for box in (_all_boxes(member) if isinstance(member, _Open) else (member,)))
        leader = list(range(len(members)))

        def lead(i: int) -> int:
            while leader[i] != i:
                leader[i] = i = leader[leader[i]]
            return i

        going_out = set[int]()
        for source, target in self._lines:
            if source in of and target in of:
                leader[lead(of[target])] = lead(of[source])
            for end, other in ((source, target), (target, source)):
                if end in of and group not in self._in[other]:
                    going_out.add(of[end])
        found: dict[int, list[int | _Open]] = {}
        for i, member in enumerate(members):
            found.setdefault(lead(i), []).append(member)
        out = {lead(i) for i in going_out}
        return [(each, which in out) for which, each in found.items()]

    def _laid_out(self, boxes: Sequence[int], inner: Sequence[_Open]) -> Piece:
        """What hangs together, by the engine."""
        if len(boxes) == 1 and not inner:
            return Piece(self._sizes[boxes[0]], {boxes[0]: (0.0, 0.0)})
        sizes: list[Size] = []
        parents: list[int | None] = []
        at: dict[int, int] = {}
        groups: dict[int, int] = {}
        blocks: list[tuple[int, Piece]] = []

        def add(size: Size, parent: int | None) -> int:
            sizes.append(size)
            parents.append(parent)
            return len(sizes) - 1

        def add_all(some: Iterable[int], others: Iterable[_Open], parent: int | None) -> None:
            for box in some:
                at[box] = add(self._sizes[box], parent)
            for each in others:
                around = groups[each.group] = add((1.0, 1.0), parent)
                if each.block is not None:
                    blocks.append((add(each.block.size, around), each.block))
                add_all(each.boxes, each.inner, around)

        add_all(boxes, inner, None)
        wanted = [i for i, (source, target) in enumerate(self._lines) if source in at and target in at]
        lines = [(at[source], at[target]) for source, target in (self._lines[i] for i in wanted)]
        places = self._engine.place(sizes, lines, parents)
        corners = {box: places.corners[i] for box, i in at.items()}
        around = {group: (places.corners[i], places.sizes[i]) for group, i in groups.items()}
        routes = dict(zip(wanted, places.routes, strict=True))
        for i, block in blocks:
            moved = block.moved(places.corners[i])
            corners.update(moved.corners)
            around.update(moved.around)
            routes.update(moved.routes)
        return Piece(places.size, corners, around, routes)


def _all_boxes(group: _Open) -> Iterable[int]:
    yield from group.boxes
    for each in group.inner:
        yield from _all_boxes(each)


def _block(pieces: Sequence[Piece]) -> Piece:
    """Pieces side by side as one."""
    together, size = joined(pieces)
    return Piece(
        size,
        {box: corner for piece in together for box, corner in piece.corners.items()},
        {group: place for piece in together for group, place in piece.around.items()},
        {line: points for piece in together for line, points in piece.routes.items()},
    )
