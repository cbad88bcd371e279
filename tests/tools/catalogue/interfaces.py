"""What executables, components, nodelets, controllers and plugins do, as this project's analysis reads their source."""

from __future__ import annotations

import json
import re
import tempfile
import threading
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from lxml import etree
from preflight_analysis.catalogue.packages import INTERFACES
from preflight_analysis.documents.disk import Disk
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.environment.executables import ExecutableIndex
from preflight_analysis.environment.model import Environment, Package, Packages
from preflight_analysis.interfaces.nodl_groups import GROUPS
from preflight_analysis.source.analyse import SourceAnalysis, SourceInterface, SourceKey
from preflight_analysis.source.known_params import LaunchParams
from preflight_analysis.tracing.interface import Endpoint, Interface, ParamUse
from preflight_analysis.tracing.request import TraceRequest
from preflight_analysis.tracing.trace import Tracer

from tools.catalogue.plugins import plugins_of
from tools.catalogue.repositories import Snapshot
from tools.catalogue.sources import (
    ADDED_PARAMETERS,
    CONTROLLERS,
    DECLARED,
    GENERATIONS,
    MANIFESTS,
    NAMED,
    OF_TESTS,
    OTHER_VERSIONS,
    RUN,
    SOURCES,
    STAMPED,
)

_LIBRARIES = frozenset({"roscpp", "rospy", "rclpy", "rclcpp", "nodelet"})
_ARGUMENTS = ("preflight_first", "preflight_second")
_NAME = "preflight_node"
_GIVEN = {"string": _ARGUMENTS[0], "string array": [_ARGUMENTS[0]]}
_NOTHING_SET = LaunchParams({})
_OF_ALL = ("/rosout", "/clock", "~get_loggers", "~set_logger_level")
_SPACE = "/preflight_space/"
_IN_TESTS = re.compile(r"/(?:tests?|examples?/tests?)/")
_BEGINS = re.compile(r"\A[A-Za-z]+")
"""Of a relative name, what another one may be: `image` of `image/marked` and `image_marked`."""
_NO_NODES = re.compile(r"\.(?:h|hh|hpp|c|cc|cpp|cxx|txt|md|rst|xml|yaml|sh|bash|rviz|launch)\Z|\Atest_|_test\Z")


@dataclass(frozen=True, slots=True)
class Laid:
    """Snapshots of one distribution's repositories, laid out as a workspace. `sources` has repository, commit and date
    by the folder of each."""

    distro: str
    folder: Path
    environment: Environment
    sources: Mapping[str, tuple[str, str, str]]

    def has(self, repository: str) -> bool:
        """Whether the snapshot of a repository is among them."""
        return any(repository == name for name, _, _ in self.sources.values())

    def source_of(self, package: Package) -> tuple[str, str, str]:
        """Repository, commit and date."""
        return self.sources[self.folder_of(package)]

    def folder_of(self, package: Package) -> str:
        """The folder of its repository."""
        return Path(package.share).relative_to(self.folder / "src").parts[0]


def write_interfaces(sources: Path, only: Collection[str]) -> None:
    """Write the data of all packages anew whose repositories are there."""
    for distro in GENERATIONS:
        with tempfile.TemporaryDirectory() as folder, ProcessPoolExecutor(2) as pool:
            laid = lay_out(sources, distro, Path(folder), only)
            for path in (INTERFACES / distro).glob("*.json"):
                if laid.has(json.loads(path.read_text())["source"][0]):
                    path.unlink()
            repositories = sorted(laid.sources)
            done = pool.map(_of_repository, [laid] * len(repositories), repositories)
            elsewhere = _elsewhere(sources, laid, pool)
            count = sum(
                _write(laid, package, _with_elsewhere(found, package.name, elsewhere))
                for found_all in done
                for package, found in found_all
            )
            print(f"{distro}: {count} nodes", flush=True)


Elsewhere = dict[tuple[str, str], set[str]]
"""The parameters of a plugin of a package."""


def _elsewhere(sources: Path, laid: Laid, pool: ProcessPoolExecutor) -> Elsewhere:
    """What plugins declare in other versions than the one that is looked at."""
    others = OTHER_VERSIONS.get(laid.distro, {})
    rows = [(repository, ref) for repository, refs in others.items() if laid.has(repository) for ref in refs]
    found: Elsewhere = {}
    for each in pool.map(_of_version, [sources] * len(rows), rows):
        for of, params in each.items():
            found.setdefault(of, set()).update(params)
    return found


def _of_version(sources: Path, version: tuple[str, str]) -> Elsewhere:
    with tempfile.TemporaryDirectory() as folder:
        Snapshot.of(sources, *version).unpack(Path(folder) / "src")
        environment = detect_environment(folder, {"ROS_VERSION": "2"}, root=str(Path(folder) / "nowhere"))
        analysis = SourceAnalysis(environment, Disk())
        return {
            (package.name, name): {*about.get("parameters", ())}
            for package in environment.packages.values()
            if not OF_TESTS.search(package.name)
            for name, about in _plugins(analysis, package)
        }


def _with_elsewhere(
    found: Mapping[str, Mapping[str, Any]], package: str, elsewhere: Elsewhere
) -> Mapping[str, Mapping[str, Any]]:
    plugins = dict(found["plugins"])
    for (having, name), params in elsewhere.items():
        if having == package:
            more = sorted(params - plugins.get(name, {}).get("parameters", {}).keys())
            plugins[name] = {**plugins.get(name, {}), **({"elsewhere": more} if more else {})}
    return {**found, "plugins": plugins}


def lay_out(sources: Path, distro: str, folder: Path, only: Collection[str] = ()) -> Laid:
    """The workspace, below a folder, of the repositories that are there; of `only` where any are named."""
    of: dict[str, tuple[str, str, str]] = {}
    branches = {repository: of_distro[distro] for repository, of_distro in SOURCES.items() if distro in of_distro}
    for snapshot in Snapshot.of_all(sources, branches, only):
        name = snapshot.repository.replace("/", "+")
        snapshot.unpack(folder / "src" / name)
        manifest = MANIFESTS.get(snapshot.repository, {}).get(distro)
        if manifest is not None:
            (folder / "src" / name / manifest).rename(folder / "src" / name / "package.xml")
        of[name] = (snapshot.repository, snapshot.commit, snapshot.date)
    variables = {"ROS_DISTRO": distro, "ROS_VERSION": str(GENERATIONS[distro])}
    environment = detect_environment(str(folder), variables, root=str(folder / "nowhere"))
    return Laid(distro, folder, environment, of)


def _write(laid: Laid, package: Package, found: Mapping[str, Mapping[str, Any]]) -> int:
    if not any(found.values()):
        return 0
    repository, commit, date = laid.source_of(package)
    lines = [f'"source": {json.dumps([repository, commit, date])}']
    for kind, nodes in found.items():
        rows = (f"{json.dumps(name)}: {json.dumps(node)}" for name, node in sorted(nodes.items()))
        lines += [f'"{kind}": {{\n' + ",\n".join(rows) + "\n}"] if nodes else []
    path = INTERFACES / laid.distro / f"{package.name}.json"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("{" + ",\n".join(lines) + "}\n")
    return sum(map(len, found.values()))


def _of_repository(laid: Laid, name: str) -> list[tuple[Package, dict[str, dict[str, Any]]]]:
    """What is known of the packages of a repository. The client libraries, and what others build on them, are known to
    the analysis by their calls: it does not follow them into their source."""
    everywhere = laid.environment.packages.items()
    own = {key: package for key, package in everywhere if laid.folder_of(package) == name and key not in _LIBRARIES}
    messages = {key: package for key, package in everywhere if key.endswith(("_msgs", "_interfaces"))}
    environment, disk = replace(laid.environment, packages=Packages({**messages, **own})), Disk()
    wanted = [package for key, package in sorted(own.items()) if not OF_TESTS.search(key)]
    return [(package, facts_of_package(environment, disk, package)) for package in wanted]


def facts_of_package(environment: Environment, disk: Disk, package: Package) -> dict[str, dict[str, Any]]:
    """The facts of its executables, components, nodelets, controllers and plugins: kind -> name -> groups of NoDL."""
    analysis, index = SourceAnalysis(environment, disk), ExecutableIndex(environment, disk)
    executables, components, nodelets, controllers = {}, {}, {}, {}
    for name in index.names(package.name):
        found = index.find(package.name, name)
        path = found.path or next(iter(found.not_executable), None)
        if _NO_NODES.search(name) or (path is not None and _IN_TESTS.search(path.removeprefix(package.share))):
            continue
        # What nodes resolve within the namespace themselves was given as a relative name.
        key = SourceKey(path, found.entry_point, package.name, name, None, f"{_SPACE}{_NAME}", "", ())
        said = _read(analysis, [key, *(key._replace(args=" ".join(_ARGUMENTS[:count])) for count in (1, 2))])
        arguments = RUN.get(environment.distro or "", {}).get(package.name, {}).get(name)
        if said is None and arguments is not None:
            said = _run(environment, key._replace(args=arguments))
        called = NAMED.get(environment.distro or "", {}).get(package.name, {}).get(name)
        declared = DECLARED.get(environment.distro or "", {}).get(package.name, {}).get(name, {})
        if said is None and declared:
            said = {}
        if said is not None:
            _add_remapped(analysis, key, said)
            _add_named_by_parameters(analysis, key, said, typed=package.is_ament)
            _add_declared(said, declared)
            executables[name] = {**said, "nodes": [[called, "", True]]} if called is not None else said
    for cls in index.components(package.name):
        key = SourceKey(None, None, package.name, "", cls, f"{_SPACE}{_NAME}", "", ())
        said = _read(analysis, [key])
        if said is not None:
            _add_named_by_parameters(analysis, key, said, typed=True)
            _add_declared(said, DECLARED.get(environment.distro or "", {}).get(package.name, {}).get(cls, {}))
            components[cls] = said
    for plugin in _nodelets(package) if not package.is_ament else ():
        key = SourceKey(None, None, "nodelet", "nodelet", None, f"{_SPACE}{_NAME}", f"standalone {plugin}", ())
        said = _read(analysis, [key])
        if said is not None:
            _add_remapped(analysis, key, said)
            _add_named_by_parameters(analysis, key, said, typed=False)
            _add_declared(said, DECLARED.get(environment.distro or "", {}).get(package.name, {}).get(plugin, {}))
            if {end.get("name") for group in GROUPS.values() for end in said.get(group, ())} - {"/tf", "/tf_static"}:
                nodelets[plugin] = said
    if not package.is_ament and package.name in CONTROLLERS:
        exported = analysis.exported(package.name)
        controllers |= {name: said for name, said in CONTROLLERS[package.name].items() if name in exported}
    for controller in analysis.controllers(package.name) if package.is_ament else ():
        said = _controller(analysis, SourceKey(None, None, package.name, "", controller, f"/{_NAME}", "", ()))
        if said is not None:
            controllers[controller] = said
    found = {
        "executables": executables,
        "components": components,
        "nodelets": nodelets,
        "controllers": controllers,
        "plugins": dict(_plugins(analysis, package)) if package.is_ament else {},
    }
    if package.is_ament:
        _add_stamped(found, package.name)
    return found


def _plugins(analysis: SourceAnalysis, package: Package) -> Iterator[tuple[str, dict[str, Any]]]:
    """What the plugins do that nodes load, by their names."""
    for name, ends, found in plugins_of(analysis, package):
        uses = (replace(use, name=param) for param, use in found.items())
        yield name, {**ends, **({"parameters": _params(uses)} if found else {})}


def _controller(analysis: SourceAnalysis, key: SourceKey) -> dict[str, Any] | None:
    """The facts of a controller. Many give up where a parameter that has to name something is empty: it is read with
    these set as well, and what they name is nobody's fact."""
    said = _read(analysis, [key])
    if said is None:
        return None
    given = {
        f"{key.name}/{name.removeprefix('~')}": _GIVEN[about["type"]]
        for name, about in said.get("parameters", {}).items()
        if about.get("type") in _GIVEN and not about.get("default_value")
    }
    more = _read(analysis, [key], LaunchParams(given)) or said
    return max(said, more, key=lambda each: sum(len(each.get(group, ())) for group in GROUPS.values()))


def _add_remapped(analysis: SourceAnalysis, key: SourceKey, said: dict[str, Any]) -> None:
    """Note which ends have names that begin with what a remap makes of another name: `resolveName("image") + "/marked"`
    is `image/marked` without one."""
    rows = [row for group in GROUPS.values() for row in said.get(group, ()) if "name" in row]
    parts = sorted({begin for row in rows for begin in _BEGINS.findall(row["name"])})
    targets = {part: f"/preflight_remapped_{number}_" for number, part in enumerate(parts)}
    more = _read(analysis, [key._replace(remaps=tuple(targets.items()))]) if targets else None
    there = {row["name"] for group in GROUPS.values() for row in (more or {}).get(group, ()) if "name" in row}
    for row in rows if more is not None else ():
        for part, target in targets.items():
            if row["name"] != part and row["name"].startswith(part) and target + row["name"][len(part) :] in there:
                row["remapped"] = part


def _add_declared(said: dict[str, Any], declared: Mapping[str, Sequence[Mapping[str, Any]]]) -> None:
    """Add ends that the source does not tell in a way that the analysis reads; they take the place of those of the same
    name."""
    for group, rows in declared.items():
        names = {row["name"] for row in rows if "name" in row}
        before = {row["name"]: row for row in said.get(group, ()) if row.get("name") in names}
        added = ({**_kept(before.get(row.get("name", ""), {})), **row} for row in rows)
        said[group] = [*(row for row in said.get(group, ()) if row.get("name") not in names), *added]


def _kept(row: Mapping[str, Any]) -> dict[str, Any]:
    return {key: value for key, value in row.items() if key == "qos"}


def _add_stamped(of_package: Mapping[str, dict[str, dict[str, Any]]], package: str) -> None:
    """Note which velocities have their types by a parameter; and the parameters that a snapshot is too old for."""
    param, types = STAMPED
    for kind in ("executables", "components", "plugins"):
        for said in of_package[kind].values():
            if kind != "plugins" and package in ADDED_PARAMETERS:
                said["parameters"] = {**said.get("parameters", {}), **ADDED_PARAMETERS[package]}
            by = f"../{param}" if kind == "plugins" else f"~{param}"
            known = package == "nav2_behaviors" if kind == "plugins" else by in said.get("parameters", {})
            for row in (row for group in GROUPS.values() for row in said.get(group, ()) if known):
                if row.get("type") == types["false"]:
                    row["typed_by"] = {by: types}


def _add_named_by_parameters(analysis: SourceAnalysis, key: SourceKey, said: dict[str, Any], *, typed: bool) -> None:
    """Note which ends have their names by a parameter: as its default, or once it is set. `typed`: the source says
    which parameters are texts; else each without a default may be one (ROS 1)."""
    texts = {
        name: about.get("default_value") or ""
        for name, about in said.get("parameters", {}).items()
        if about.get("type") == "string"
        or isinstance(about.get("default_value"), str)
        or not (typed or about.get("has_default") or "default_value" in about)
    }
    ends = {row["name"] for group in GROUPS.values() for row in said.get(group, ())}
    marks = {f"preflight_{name.strip('~/')}": name for name, default in texts.items() if default in ("", *ends)}
    given = {f"{key.name}/{name.removeprefix('~')}": mark for mark, name in marks.items() if name.startswith("~")}
    more = (_read(analysis, [key], LaunchParams(given)) or {}) if given else {}
    for group in GROUPS.values():
        rows = said.get(group, [])
        for row in more.get(group, ()):
            param = marks.get(row["name"])
            if param is None:
                continue
            default = next((each for each in rows if texts[param] and each["name"] == texts[param]), None)
            if default is not None:
                default["named_by"] = param
            elif not texts[param]:
                of_row = {field: value for field, value in row.items() if field not in ("name", "conditional")}
                said.setdefault(group, []).append({"named_by": param, **of_row})


def _nodelets(package: Package) -> Iterator[str]:
    """The names of those that the package exports."""
    try:
        manifest = etree.parse(package.manifest)
    except (OSError, etree.XMLSyntaxError):
        return
    for export in manifest.iterfind("./export/nodelet"):
        path = (export.get("plugin") or "").replace("${prefix}", package.share)
        try:
            text = Path(path).read_bytes()
            root = etree.fromstring(b"<all>" + re.sub(rb"<\?xml[^>]*\?>", b"", text) + b"</all>")
        except (OSError, etree.XMLSyntaxError):
            continue
        for each in root.iter("class"):
            if each.get("base_class_type") == "nodelet::Nodelet":
                yield str(each.get("name") or (each.get("type") or "").replace("::", "/"))


def _read(
    analysis: SourceAnalysis, keys: Sequence[SourceKey], params: LaunchParams = _NOTHING_SET
) -> dict[str, Any] | None:
    """The facts of the first that has any: a program may need arguments. What is named by them is nobody's fact."""
    for said in analysis.read_each(keys, params):
        if said is not None:
            facts = _facts(said)
            if not facts.keys() <= {"nodes"}:
                return facts
    return None


def _run(environment: Environment, key: SourceKey) -> dict[str, Any] | None:
    """The facts of a run in the sandbox, with stand-ins for what is not installed."""
    request = TraceRequest(
        key.name,
        key.package,
        key.path or "",
        tuple(key.args.split()),
        generation=GENERATIONS[environment.distro or ""],
        entry_point=key.entry_point,
        named=False,
    )
    ran = Tracer(environment, None).trace(request, threading.Event())
    # What is resolved within the namespace was given as a relative name.
    ends = tuple(replace(end, name=end.name.removeprefix(_SPACE)) for end in ran.endpoints)
    return _facts(replace(ran, endpoints=ends)) or None


def _facts(said: SourceInterface | Interface) -> dict[str, Any]:
    """The facts of an interface, in the groups of NoDL."""
    facts: dict[str, Any] = {}
    for role, group in GROUPS.items():
        ends = _with_one_type(e for e in said.endpoints if e.role == role and not _is_common(e))
        rows = [
            {
                "name": _below_its_own(e.name),
                **({"type": e.type} if e.type else {}),
                **({"qos": dict(e.qos)} if e.qos else {}),
                **({"conditional": True} if "condition" in e.evidence.doubts else {}),
            }
            for e in ends
        ]
        if rows:
            facts[group] = rows
    params = _params(use for use in said.params if not use.builtin)
    if params:
        facts["parameters"] = params
    made_nodes = [made for made in said.nodes if not _of_arguments(made.given)]
    if made_nodes:
        facts["nodes"] = [[made.given, made.space, made.renamed] for made in made_nodes]
    return facts


def _params(uses: Iterable[ParamUse]) -> dict[str, Any]:
    params: dict[str, Any] = {}
    for use in uses:
        if isinstance(use.default, str):
            use = replace(use, default=use.default.replace(_SPACE, "/"))
        about = {
            **({"access": use.access} if use.access != "get" else {}),
            **({"type": use.type} if use.type else {}),
            **({"default_value": use.default} if use.has_default and _is_fact(use.default) else {}),
            **({"has_default": True} if use.has_default and not _is_fact(use.default) else {}),
            **{flag: True for flag in ("mandatory", "dynamic", "read_only") if getattr(use, flag)},
            **({"conditional": True} if "condition" in use.evidence.doubts else {}),
            **({"range": [use.range.low, use.range.high, use.range.step]} if use.range is not None else {}),
        }
        name = _below_its_own(use.name).replace("~/", "~", 1)
        if _NAME not in name:
            params.setdefault(name, about)
    return params


def _below_its_own(name: str) -> str:
    """`name` as a private one, where the source made it of the node's own name, and as a relative one where it is of
    its namespace."""
    return re.sub(rf"^(?:{_SPACE}|/)?{_NAME}/", "~/", name).removeprefix(_SPACE).replace(_SPACE, "/")


def _with_one_type(ends: Iterable[Endpoint]) -> list[Endpoint]:
    """Of those that a condition gives one type or another, one whose type is not known."""
    of_name: dict[str, list[Endpoint]] = {}
    for end in ends:
        of_name.setdefault(end.name, []).append(end)
    found: list[Endpoint] = []
    for alike in of_name.values():
        one_of = len({end.type for end in alike}) > 1 and all("condition" in end.evidence.doubts for end in alike)
        found += [replace(alike[0], type=None)] if one_of else alike
    return found


def _is_common(end: Endpoint) -> bool:
    """Whether each node has it, or it is named by an argument, or by the node elsewhere than at the start."""
    return end.builtin or end.name in _OF_ALL or _of_arguments(end.name) or _NAME in _below_its_own(end.name)


def _of_arguments(name: str) -> bool:
    return any(argument in name for argument in _ARGUMENTS)


def _is_fact(value: Any) -> bool:
    """Whether a default is a plain value, and short: a text of others is none, nor is one made of the node's name."""
    if isinstance(value, list):
        return len(value) <= 64 and all(map(_is_fact, value))
    if isinstance(value, str):
        return len(value) <= 100 and "\n" not in value and _NAME not in value
    return isinstance(value, (bool, int, float))
