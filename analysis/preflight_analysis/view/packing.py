"""Rectangles side by side in two dimensions. The page does the same in `packing.js`, for the window that it has."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import sqrt

Size = tuple[float, float]
Corner = tuple[float, float]

_WIDTHS = (0.7, 0.8, 0.9, 1.0, 1.1, 1.2, 1.35, 1.5, 1.8)
"""Which widths are tried, of the one that they would have if no room was lost."""
_NO_MORE = 0.1
"""Pixels less than which nothing is gained."""


def pack(sizes: Sequence[Size], aspect: float, gap: float) -> tuple[tuple[Corner, ...], Size]:
    """The upper left corner of each rectangle, and the extent of all, such that it is shown as large as possible in a
    window that is `aspect` times as wide as high. High ones come first, equal ones as they are given; each stands as
    far up, and then as far to the left, as there is room ("skyline, bottom left")."""
    if not sizes:
        return (), (0.0, 0.0)
    order = sorted(range(len(sizes)), key=lambda i: -sizes[i][1])
    widest = max(width for width, _ in sizes)
    ideal = sqrt(sum((width + gap) * (height + gap) for width, height in sizes) * aspect)
    best: tuple[float, Mapping[int, Corner], Size] | None = None
    for limit in (widest, *(max(widest, ideal * share) for share in _WIDTHS)):
        corners = _within(sizes, order, limit, gap)
        width = max(x + sizes[i][0] for i, (x, _) in corners.items())
        height = max(y + sizes[i][1] for i, (_, y) in corners.items())
        needed = max(width / aspect, height)
        if best is None or needed < best[0] - _NO_MORE:
            best = needed, corners, (width, height)
    assert best is not None
    return tuple(best[1][i] for i in range(len(sizes))), best[2]


def _within(sizes: Sequence[Size], order: Sequence[int], limit: float, gap: float) -> Mapping[int, Corner]:
    # From where to where, and below what: what is taken so far.
    skyline = [(0.0, limit, 0.0)]
    corners: dict[int, Corner] = {}
    for i in order:
        width, height = sizes[i]
        best: tuple[float, float] | None = None
        for x, _, _ in skyline:
            if best is not None and x + width > limit:
                break
            y = max(top for start, end, top in skyline if start < x + width + gap and end > x)
            if best is None or y < best[0] - _NO_MORE:
                best = y, x
        assert best is not None
        y, x = best
        corners[i] = x, y
        end = min(limit, x + width + gap)
        kept = [
            piece
            for start, stop, top in skyline
            for piece in ((start, min(stop, x), top), (max(start, end), stop, top))
            if piece[0] < piece[1]
        ]
        skyline = sorted([*kept, (x, end, y + height + gap)])
    return corners
