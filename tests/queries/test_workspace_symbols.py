"""Workspace symbols: by some letters of the name, the best first, and no more than anybody reads."""

from __future__ import annotations

from pathlib import Path

from preflight_analysis.queries.workspace_symbols import LIMIT, executables, workspace_symbols
from preflight_analysis.workspace.facts import FileFacts
from preflight_analysis.workspace.index import NodeEntry, Root, RootEntry, WorkspaceIndex
from support.locations import location
from support.workspace_harness import create_workspace


def index_of(*names: str, files: tuple[str, ...] = ("/w/p/launch/main.launch",)) -> WorkspaceIndex:
    nodes = tuple(NodeEntry(name, "p", "t.py", location(files[0], n, n + 1)) for n, name in enumerate(names))
    entries = {Root(path): RootEntry(Root(path), files, {}, (), nodes) for path in (files[0], "/w/other.launch")}
    return WorkspaceIndex({path: FileFacts(path, "", (), (), True) for path in files}, entries, (), True)


def found(index: WorkspaceIndex, query: str) -> list[str]:
    return [symbol.name for symbol in workspace_symbols(index, (), "/w", query)]


def test_letters_in_their_order() -> None:
    index = index_of("/lab/camera_driver", "/lab/driver", "/arm/drive", "/lab/diver")
    assert found(index, "driver") == ["/lab/driver", "/lab/camera_driver"]
    assert found(index, "LABdr") == ["/lab/diver", "/lab/driver", "/lab/camera_driver"]
    assert found(index, "drive") == ["/arm/drive", "/lab/driver", "/lab/camera_driver"]
    assert found(index, "dvr") == ["/lab/diver", "/lab/driver", "/lab/camera_driver"]
    assert found(index, "main") == ["main.launch"]
    assert found(index, "[^") == []


def test_nodes_say_what_runs_and_files_where_they_are() -> None:
    node, file = (workspace_symbols(index_of("/talker"), (), "/w", query) for query in ("talker", "main"))
    assert [(s.kind, s.container) for s in (*node, *file)] == [("node", "p/t.py"), ("launch", "p/launch")]


def test_executables_that_packages_make(tmp_path: Path) -> None:
    workspace = create_workspace(
        tmp_path,
        """
        <launch>$0</launch>
        //- p/CMakeLists.txt
        add_executable(lidar_driver src/a.cpp)
        """,
        build_type="ament_cmake",
    )
    context = workspace.context
    symbols = workspace_symbols(context.current, (), str(tmp_path), "driver", executables(context))
    assert [(each.name, each.kind, each.container) for each in symbols] == [("lidar_driver", "executable", "p")]
    assert workspace.shown(symbols[0].location) == "p/CMakeLists.txt:1 lidar_driver"
    assert workspace_symbols(context.current, (), str(tmp_path), "camera", executables(context)) == ()


def test_many_nodes_are_too_many_to_be_read() -> None:
    index = index_of(*(f"/robot_{n % 100}/sensor_{n}" for n in range(10_000)))
    symbols = workspace_symbols(index, (), "/w", "s")
    assert len(symbols) == LIMIT
    assert found(index, "r77s9977") == ["/robot_77/sensor_9977"]
    assert found(index, "a" * 50) == []
