"""Where things stand in the picture."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations
from pathlib import Path

import pytest
from preflight_analysis.tracing.interface import Role
from preflight_analysis.view import engine
from preflight_analysis.view.labels import columns, label
from preflight_analysis.view.layout import Box, Layout, lay_out
from preflight_analysis.view.model import GraphView, ViewChannel, ViewEdge, ViewNode
from preflight_analysis.view.packing import pack
from support import sample_graphs

EMPTY = GraphView("/empty.launch", 1, (), (), (), (), ())


def overlapping(layout: Layout) -> list[tuple[Box, Box]]:
    def apart(a: Box, b: Box) -> bool:
        return a.x + a.width <= b.x or b.x + b.width <= a.x or a.y + a.height <= b.y or b.y + b.height <= a.y

    return [(a, b) for a, b in combinations(layout.boxes, 2) if not apart(a, b)]


def is_inside(layout: Layout) -> bool:
    corners = [(b.x, b.y) for b in layout.boxes] + [(b.x + b.width, b.y + b.height) for b in layout.boxes]
    points = [*corners, *(point for route in layout.routes for point in route.points)]
    return all(0 <= x <= layout.width and 0 <= y <= layout.height for x, y in points)


@pytest.mark.parametrize(
    "view",
    [sample_graphs.robot(), sample_graphs.hostile(), sample_graphs.large(40, 160)],
    ids=["robot", "hostile", "large"],
)
def test_nothing_overlaps_and_all_is_inside(view: GraphView) -> None:
    layout = lay_out(view)
    assert overlapping(layout) == []
    assert is_inside(layout)


def test_lines_begin_and_end_at_their_boxes_and_go_with_the_messages() -> None:
    view = sample_graphs.robot()
    layout = lay_out(view)

    def touches(box: Box, point: tuple[float, float]) -> bool:
        x, y = point
        return box.x - 1 <= x <= box.x + box.width + 1 and box.y - 1 <= y <= box.y + box.height + 1

    for route in layout.routes:
        assert touches(layout.boxes[route.source], route.points[0])
        assert touches(layout.boxes[route.target], route.points[-1])
        for edge in (view.edges[i] for i in route.edges):
            out = edge.role in ("publisher", "client", "action_client")
            assert (layout.boxes[route.source].node == edge.node) is out


def test_a_namespace_has_its_nodes_and_what_they_alone_use_in_it() -> None:
    view = sample_graphs.robot().without_builtin()
    layout = lay_out(view)
    (frame,) = layout.frames
    assert (frame.name, {view.nodes[i].name for i in frame.nodes}) == (
        "/camera",
        {"/camera/driver", "/camera/detector"},
    )
    for box in layout.boxes:
        is_in = frame.x <= box.x and box.x + box.width <= frame.x + frame.width
        is_in = is_in and frame.y <= box.y and box.y + box.height <= frame.y + frame.height
        assert is_in is (box.namespace is not None)
    (driver,) = (box for box in layout.boxes if box.node is not None and view.nodes[box.node].name == "/camera/driver")
    assert driver.namespace == 0


def fleet(robots: int, *, shared: bool) -> GraphView:
    """Robots of two namespaces each, in which all publish to the inner one, and to one topic of all of them."""
    nodes, channels, edges = list[ViewNode](), list[ViewChannel](), list[ViewEdge]()

    def node(name: str) -> int:
        nodes.append(ViewNode(name, "p", "x", "node", "/f.launch", (), "trace", "complete", None, ()))
        return len(nodes) - 1

    def topic(name: str, *ends: tuple[int, Role]) -> None:
        channels.append(ViewChannel("topic", name, (), False, False, ()))
        for end, role in ends:
            edges.append(ViewEdge(end, len(channels) - 1, role, None, {}, None, (), False, False, ()))

    base = node("/base")
    told: list[tuple[int, Role]] = [(base, "subscriber")]
    for robot in range(robots):
        name = f"/robot{robot}"
        left, right, plan = node(f"{name}/arms/left"), node(f"{name}/arms/right"), node(f"{name}/plan")
        topic(f"{name}/arms/state", (left, "publisher"), (right, "subscriber"))
        topic(f"{name}/goal", (plan, "publisher"), (left, "subscriber"))
        node(f"{name}/alone")
        told.append((plan, "publisher"))
    if shared:
        topic("/status", *told)
    return GraphView("/f.launch", 1, tuple(nodes), tuple(channels), tuple(edges), (), ("/f.launch",))


@pytest.mark.parametrize("shared", [False, True])
def test_namespaces_in_namespaces_hold_their_own_and_nothing_else(shared: bool) -> None:
    view = fleet(3, shared=shared)
    layout = lay_out(view)
    assert [frame.name for frame in layout.frames] == [
        name for robot in range(3) for name in (f"/robot{robot}", f"/robot{robot}/arms")
    ]
    assert overlapping(layout) == []
    assert is_inside(layout)
    for at, frame in enumerate(layout.frames):
        for box in layout.boxes:
            around = box.namespace
            while around is not None and around != at:
                around = layout.frames[around].parent
            apart_x = box.x + box.width <= frame.x or frame.x + frame.width <= box.x
            apart_y = box.y + box.height <= frame.y or frame.y + frame.height <= box.y
            assert (apart_x or apart_y) is (around is None), (frame.name, box)
        if frame.parent is not None:
            outer = layout.frames[frame.parent]
            assert outer.y + 14 < frame.y, "there is room for its name"


def test_what_nothing_connects_stands_side_by_side() -> None:
    layout = lay_out(fleet(9, shared=False))
    assert layout.islands == 10
    assert 0.8 < layout.width / layout.height < 3
    assert lay_out(fleet(9, shared=True)).islands == 1


def test_one_namespace_of_all_nodes_is_no_box() -> None:
    view = fleet(1, shared=True)
    nodes = tuple(replace(node, name=f"/all{node.name}") for node in view.nodes)
    assert [frame.name for frame in lay_out(replace(view, nodes=nodes)).frames] == ["/all/robot0", "/all/robot0/arms"]


@pytest.mark.parametrize("aspect", [0.5, 1.6, 3.0])
def test_rectangles_are_packed_without_overlap_and_without_much_waste(aspect: float) -> None:
    sizes = [(40.0 + 37 * i % 160, 20.0 + 53 * i % 90) for i in range(60)]
    corners, (width, height) = pack(sizes, aspect, 10)
    placed = [Box(x, y, *size, 0, None, None) for (x, y), size in zip(corners, sizes, strict=True)]
    assert overlapping(Layout(width, height, tuple(placed), (), (), 1)) == []
    assert aspect / 1.5 < width / height < aspect * 1.5
    assert sum((w + 10) * (h + 10) for w, h in sizes) > 0.7 * (width + 10) * (height + 10)


def test_channels_with_the_same_ends_share_a_box_unless_something_is_wrong_with_one() -> None:
    view = sample_graphs.robot().without_builtin()
    stacks = [{view.channels[i].name for i in box.channels} for box in lay_out(view).boxes if box.channels]
    assert {"/camera/image_raw/compressed", "/camera/image_raw/theora", "/camera/parameter_updates"} in stacks
    assert {"/battery"} in stacks, "said to be without a subscriber"
    assert {"/joint_states"} in stacks


def test_the_same_graph_has_the_same_layout() -> None:
    assert lay_out(sample_graphs.large(30, 90)) == lay_out(sample_graphs.large(30, 90))


def test_a_graph_of_nothing() -> None:
    assert lay_out(EMPTY).boxes == ()


def test_without_the_engine_everything_has_a_place_all_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(engine, "_PROGRAM", "raise SystemExit(1)")
    layout = lay_out(sample_graphs.robot())
    assert overlapping(layout) == []
    assert is_inside(layout)
    assert all(len(route.points) == 2 for route in layout.routes)


def test_nothing_of_the_folder_that_we_are_in_is_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("graphlay", "json"):
        (tmp_path / f"{name}.py").write_text("raise SystemExit(1)")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    assert any(len(route.points) > 2 for route in lay_out(sample_graphs.robot()).routes)


def test_an_engine_that_is_not_installed_is_done_without(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(engine, "find_spec", lambda name: None)
    assert overlapping(lay_out(sample_graphs.robot())) == []


def test_an_engine_that_does_not_end_is_given_up(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(engine, "_PROGRAM", "import time\nwhile True: time.sleep(1)")
    monkeypatch.setattr(engine, "PATIENCE", 0.2)
    assert overlapping(lay_out(sample_graphs.robot())) == []


@pytest.mark.parametrize("text", [*sample_graphs.HOSTILE, "/ordinary/name"])
def test_a_label_is_one_short_line(text: str) -> None:
    shown = label(text)
    assert columns(shown) <= 38
    assert "\n" not in shown
    assert all(character.isprintable() for character in shown)


def test_a_long_name_keeps_both_ends() -> None:
    shown = label("/a_robot/with/a/very/long/name/of/its/front_camera_driver")
    assert shown.startswith("/a_robot")
    assert shown.endswith("front_camera_driver")
