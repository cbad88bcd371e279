"""The reasons why nodes were not run."""

from __future__ import annotations

from pathlib import Path

import pytest
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.tracing import preload
from preflight_analysis.workspace.run_results import NOT_ASKED_FOR
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace
from support.unbuilt_packages import manifest

INSTALLED = "q::Talker;lib/libtalker.so\nq::Gone;lib/libgone.so\n"
REGISTERED = 'project(p)\nadd_library(driver SHARED src/d.cpp)\nrclcpp_components_register_nodes(driver "p::Driver")\n'


class Components:
    """A workspace with the package `p`, which is not built, `q`, which is installed, and `plain` without components."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        for name, cmake in {"p": REGISTERED, "plain": "project(plain)\n"}.items():
            self.write(f"src/{name}/package.xml", manifest(name, "ament_cmake"))
            self.write(f"src/{name}/CMakeLists.txt", cmake)
        self.write("install/share/ament_index/resource_index/packages/q", "")
        self.write("install/share/ament_index/resource_index/rclcpp_components/q", INSTALLED)
        self.write("install/lib/libtalker.so", "")
        self.write("install/share/q/package.xml", manifest("q", "ament_cmake"))

    def write(self, name: str, text: str) -> Path:
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        return path

    def reasons(self, tags: str) -> dict[str, str | None]:
        """The reason of each node of a launch, by its name."""
        path = self.write("src/p/main.launch.xml", f"<launch>{tags}</launch>")
        environment = detect_environment(str(self.folder), {}, root=str(self.folder / "nothing"))
        workspace = Workspace(environment, Sources(), str(self.folder))
        analysis = workspace.analysed(workspace.static(str(path)).root)
        assert analysis.graph is not None
        pairs = zip(analysis.tree.nodes, analysis.graph.processes, strict=True)
        return {node.name: interface.outcome.reason for node, interface in pairs}


@pytest.fixture
def components(tmp_path: Path) -> Components:
    return Components(tmp_path)


@pytest.mark.parametrize(
    ("package", "plugin", "reason"),
    [
        ("absent", "composition::Talker", "package 'absent' is not installed here"),
        ("p", "p::Driver", "it is not built yet"),
        ("p", "p::Drivr", "component 'p::Drivr' is not registered by package 'p'; did you mean 'p::Driver'?"),
        ("p", "p::Lidar", "component 'p::Lidar' is not registered by package 'p'"),
        ("q", "Talker", "component 'Talker' is not registered by package 'q'; did you mean 'q::Talker'?"),
        ("q", "q::Gone", "it is not built yet"),
        ("plain", "plain::Node", "no component of package 'plain' is known here"),
        ("$(env NO_SUCH)", "p::Driver", "pkg is not known (it is not known)"),
    ],
)
def test_why_a_component_cannot_be_run(components: Components, package: str, plugin: str, reason: str) -> None:
    component = f'<composable_node pkg="{package}" plugin="{plugin}" name="n"/>'
    container = f'<node_container pkg="p" exec="box" name="c" namespace="">{component}</node_container>'
    assert components.reasons(container)["/n"] == reason
    assert components.reasons(f'<load_composable_node target="c">{component}</load_composable_node>')["/n"] == reason


@pytest.mark.parametrize(
    ("package", "reason"),
    [
        ("absent", "package 'absent' is not installed here"),
        ("p", "there is no executable 'box' in package 'p'"),
    ],
)
@pytest.mark.parametrize("tag", ["node", "node_container"])
def test_why_a_program_cannot_be_run(components: Components, tag: str, package: str, reason: str) -> None:
    assert components.reasons(f'<{tag} pkg="{package}" exec="box" name="c" namespace=""/>') == {"/c": reason}


def test_a_component_needs_a_container(components: Components) -> None:
    """Which another launch may start, or which is not built: that of rclcpp_components does as well."""
    component = '<composable_node pkg="q" plugin="q::Talker" name="n"/>'
    loaded = f'<load_composable_node target="c">{component}</load_composable_node>'
    assert components.reasons(loaded) == {"/n": "its container is not here, nor is package 'rclcpp_components'"}
    components.write("install/share/ament_index/resource_index/packages/rclcpp_components", "")
    components.write("install/share/rclcpp_components/package.xml", manifest("rclcpp_components", "ament_cmake"))
    reason = "its container is not here, nor is 'component_container' of package 'rclcpp_components'"
    assert components.reasons(loaded) == {"/n": reason}
    components.write("install/lib/rclcpp_components/component_container", "").chmod(0o755)
    assert components.reasons(loaded) == {"/n": NOT_ASKED_FOR}


def test_an_analysis_does_not_open_a_container(components: Components, monkeypatch: pytest.MonkeyPatch) -> None:
    """It would depend on what no input tells it."""
    components.write("install/lib/q/box", "").chmod(0o755)
    component = '<composable_node pkg="q" plugin="q::Talker" name="n"/>'
    container = f'<node_container pkg="q" exec="box" name="c" namespace="">{component}</node_container>'
    monkeypatch.setattr(preload, "applies", lambda path: pytest.fail(f"{path} is opened"))
    assert components.reasons(container) == {"/c": NOT_ASKED_FOR, "/n": NOT_ASKED_FOR}


@pytest.mark.parametrize("listed", ["q::Talker", ";", "q::Talker;\0\n", "q::Talker;" + "../" * 9000, "q::Talker;lib"])
def test_an_odd_list_of_components_raises_nothing(components: Components, listed: str) -> None:
    components.write("install/share/ament_index/resource_index/rclcpp_components/q", listed)
    component = '<composable_node pkg="q" plugin="q::Talker" name="n"/>'
    reasons = components.reasons(f'<load_composable_node target="c">{component}</load_composable_node>')
    assert reasons["/n"] in ("it is not built yet", "no component of package 'q' is known here")
