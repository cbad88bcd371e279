"""PKG009: a node in Python imports a module that is not there."""

from collections.abc import Iterator

from preflight_analysis.environment.installed_paths import package_around
from preflight_analysis.environment.model import Environment
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.findings.claim import Subject, say
from preflight_analysis.findings.doubt import Reason, doubts
from preflight_analysis.findings.finding import Finding, Related
from preflight_analysis.model.context import Context
from preflight_analysis.model.nearest import did_you_mean
from preflight_analysis.model.problems import include_chain
from preflight_analysis.model.python_imports import Absent, imports_of
from preflight_analysis.rules.further_reading import ROSDEP
from preflight_analysis.rules.rule import Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    said: set[str] = set()
    first_of: dict[str, LaunchNode] = {}
    nodes = context.tree.nodes
    for node, path in zip(nodes, context.each(_in_package, nodes, context.environment), strict=True):
        if path is not None:
            first_of.setdefault(path, node)
    for path, node in first_of.items():
        for found in imports_of(context.disk.db, context.environment, path):
            if found.name in said:
                continue
            said.add(found.name)
            absent = isinstance(found, Absent)
            what = "does not exist" if absent else "is not known"
            text = "module '{name}' {what}; {node} imports it{near}"
            yield rule.claim(
                say(text, name=found.name, what=what, node=node.name, near=did_you_mean(found.near)),
                node.location,
                subject=Subject("module", found.name),
                kind="absent" if found.near is None else "near",
                doubts=doubts(UNSEEN=not absent),
                candidates=(found.near,),
                related=(Related("imported here", found.location), *include_chain(node.origin)),
            )


def _in_package(node: LaunchNode, environment: Environment) -> str | None:
    """The path of its program, if that is in a package."""
    path = node.resolved.path
    return path if path is not None and package_around(environment, path) is not None else None


RULE = Rule(
    id="PKG009",
    name="python-module-not-found",
    effect="stops-node",
    kind="absent",
    sometimes=(Reason.UNSEEN,),
    what="Checks for a node in Python that imports a module which no package has. Imports in a `try`, in a function or "
    "under a condition are ignored, and so are modules that a build makes.",
    why="The node exits at once with `ModuleNotFoundError`.",
    example="from tank_station.calibraton import offset",
    instead="from tank_station.calibration import offset",
    references=(ROSDEP,),
    check=_check,
)
