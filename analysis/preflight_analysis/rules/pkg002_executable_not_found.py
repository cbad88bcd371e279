"""PKG002: an executable that its package does not have."""

from collections.abc import Iterator
from pathlib import PurePath

from preflight_analysis.environment.executables import ExecutableIndex
from preflight_analysis.findings.finding import Finding
from preflight_analysis.rules.nearest import did_you_mean, nearest
from preflight_analysis.rules.places import attribute_location
from preflight_analysis.rules.problems import include_chain, rename
from preflight_analysis.rules.rule import Context, Rule


def _check(rule: Rule, context: Context) -> Iterator[Finding]:
    executables = context.executables or ExecutableIndex(context.environment)
    for node in context.tree.nodes:
        found = node.resolved
        if found.path is not None or found.package_path is None or node.unknowns:
            continue
        location = attribute_location(node, "type")
        chain = include_chain(node.origin)
        if found.not_executable:
            path = found.not_executable[0]
            yield rule.finding(f"'{path}' is not executable; chmod +x {path}", location, related=chain)
            continue
        if executables.is_build_target(node.package, node.executable):
            message = f"'{node.executable}' is not built yet: CMakeLists.txt of package '{node.package}' names it"
            yield rule.finding(message, location, severity="info", confidence="likely", related=chain)
            continue
        names = executables.names(node.package)
        near = nearest(node.executable, names) or nearest(node.executable, names, key=_stem)
        yield rule.finding(
            f"package '{node.package}' has no executable '{node.executable}'; looked at its {len(names)} executables "
            f"in {found.package_path} and the devel and install spaces{did_you_mean(near)}",
            location,
            related=chain,
            fixes=rename(context, location, node.executable, near) if near else (),
        )


def _stem(name: str) -> str:
    return PurePath(name).stem


RULE = Rule(
    id="PKG002",
    name="executable-not-found",
    severity="error",
    what="Reports a node whose `type` is no executable file of its package, and names the nearest one that is; or that "
    "is there without the permission to be executed. One that the package's `CMakeLists.txt` names is not built yet: "
    "that is for information only.",
    why="`roslaunch` prints an error among the output of the other nodes and goes on without this one.",
    example='<node pkg="rospy_tutorials" type="talkr" name="talker"/>',
    instead='<node pkg="rospy_tutorials" type="talker" name="talker"/>',
    check=_check,
)
