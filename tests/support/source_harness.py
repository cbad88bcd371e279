"""A package of ROS 1 that was never built or run: what the text of its node alone tells."""

from __future__ import annotations

import textwrap
from pathlib import Path

from preflight_analysis.environment.model import Environment, Package
from preflight_analysis.evaluation.tree import LaunchTree
from preflight_analysis.source.analyse import SourceAnalysis, SourceInterface
from preflight_analysis.source.known_params import LaunchParams
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace


class SourceHarness:
    """The package `p`, and a launch file with one node of it."""

    node = '<node pkg="p" type="t" name="n" args="{args}">{inner}</node>'

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.write("package.xml", "<package><name>p</name></package>")
        package = Package("p", str(folder), str(folder / "package.xml"))
        self.environment = Environment(1, "noetic", {}, (str(folder),), {"p": package}, {}, (), (), None)
        self.sources = Sources()
        self.analysis = SourceAnalysis(self.environment, self.sources)

    def write(self, name: str, text: str) -> Path:
        """A file of the package."""
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(textwrap.dedent(text))
        return path

    def launch(self, inner: str = "", args: str = "", node: str = "") -> LaunchTree:
        """The launch file with the node, which has these arguments and this in its tag."""
        node = (node or self.node).format(inner=inner, args=args)
        path = self.write("main.launch", f"<launch>{node}</launch>")
        return Workspace(self.environment, self.sources, str(self.folder)).static(str(path)).tree

    def again(self, inner: str = "", args: str = "", node: str = "") -> SourceInterface | None:
        """What the files tell of the first node, as they are now."""
        self.sources.look()
        tree = self.launch(inner, args, node)
        params = LaunchParams({p.name: p.value for p in tree.params.values()})
        return self.analysis.read(tree.nodes[0], params)
