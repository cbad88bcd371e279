"""The launch files of packages: their actions, as this project's analysis reads them, or a run of them tells.

What has no meaning for a launch is left out: comments, descriptions, what is logged. Paths of the snapshots become
those in the share folders of packages.
"""

from __future__ import annotations

import json
import re
import tempfile
from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import yaml
from preflight_analysis.catalogue.launches import LAUNCHES, SUFFIX, CataloguedFile, path_of
from preflight_analysis.documents.python_text import LAUNCH_FUNCTION, PYTHON_SUFFIX
from preflight_analysis.documents.reading import Unreadable
from preflight_analysis.documents.span import LineIndex, Span
from preflight_analysis.environment.installed_paths import installed_at
from preflight_analysis.environment.model import Package, Packages
from preflight_analysis.evaluation.ros2.python_runs import parse_request
from preflight_analysis.launch.model import Action, Literal, Substitution, Value
from preflight_analysis.launch.python_actions import actions_of
from preflight_analysis.launch.python_source import PythonSource
from preflight_analysis.launch.recognize import LAUNCH_FOLDER, LAUNCH_SUFFIXES
from preflight_analysis.tracing.commands import CommandCache, CommandRunner
from preflight_analysis.workspace.commands import CommandResults
from preflight_analysis.workspace.index import Root
from preflight_analysis.workspace.resolve_commands import Resolving, resolve_together
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace

from tools.catalogue.interfaces import Laid, lay_out
from tools.catalogue.sources import GENERATIONS, OF_TESTS

_LONGEST = 200
"""Characters of a text that is still a fact: a robot description is none."""
_TOGETHER = 8
_SAYS_NOTHING = frozenset({"log", "log_info", "unknown"})
_OF_PEOPLE = frozenset({"description", "doc", "deprecated"})
_TEST_FOLDERS = frozenset({"sample", "test", "tests", "testing"})
_MARKED = re.compile(r"the (share folder of|variable) ([\w-]+)\Z")
_MEANT = {"share folder of": "find-pkg-share", "variable": "env"}
_OF_NAV2 = frozenset({"RewrittenYaml", "ReplaceString", "HasNodeParams", "LaunchConfigAsBool"})
"""Substitutions of `nav2_common`: they ask for no configuration that the file does not name."""
BY_HAND = frozenset({"ros_gz_sim/launch/gz_sim.launch.py", "ros_ign_gazebo/launch/ign_gazebo.launch.py"})
"""Files that this does not write: a template that CMake fills in, whose function starts a process, and what includes
it."""
_WHERE = re.compile(r"\$\(dirname\)")


def write_launches(sources: Path, only: Collection[str]) -> None:
    """Write the data of all packages anew whose repositories are there."""
    for distro, generation in GENERATIONS.items():
        with tempfile.TemporaryDirectory() as folder:
            laid = lay_out(sources, distro, Path(folder), only)
            for package in (LAUNCHES / distro).glob("*"):
                if laid.has(_repository_of(package)):
                    _remove(package)
            count, left_out = 0, Counter[str]()
            for name in sorted(laid.sources):
                maker = _Maker(laid, name, generation, Path(folder) / "cache")
                count += sum(_write(laid, file, rows) for file, rows in maker.all())
                left_out += maker.left_out
            print(f"{distro}: {count} launch files; left out: {dict(left_out)}", flush=True)


def _remove(package: Path) -> None:
    for path in package.rglob(f"*{SUFFIX}"):
        if path.relative_to(package.parent).as_posix().removesuffix(SUFFIX) not in BY_HAND:
            path.unlink()


def _repository_of(package: Path) -> str:
    """That the data of a package is made of."""
    return str(json.loads(next(package.rglob("*.json")).read_text())[0][0])


def _write(laid: Laid, file: tuple[Package, str], rows: list[Any]) -> int:
    package, below = file
    path = Path(path_of(CataloguedFile(laid.distro, package.name, below)))
    path.parent.mkdir(parents=True, exist_ok=True)
    head = [*laid.source_of(package), GENERATIONS[laid.distro]]
    path.write_text("[\n" + ",\n".join(json.dumps(row) for row in (head, *rows)) + "\n]\n")
    return 1


class _Maker:
    """Of one repository: what its files name of other packages is not there, as where they are included."""

    def __init__(self, laid: Laid, repository: str, generation: int, cache: Path) -> None:
        self._laid, self._generation = laid, generation
        everywhere = laid.environment.packages.items()
        self._packages = {name: package for name, package in everywhere if laid.folder_of(package) == repository}
        environment = replace(laid.environment, packages=Packages(self._packages))
        self._sources = Sources()
        results = CommandResults(lambda: None)
        self._results, folder = results, str(laid.folder)
        self._workspace = Workspace(environment, self._sources, folder, results)
        self._runner = CommandRunner(environment, folder, CommandCache(cache))
        shares = sorted(((p.share.rstrip("/"), p.name) for p in self._packages.values()), reverse=True)
        self._shares = dict(shares)
        self._in_share = re.compile("(" + "|".join(re.escape(share) for share, _ in shares) + r")(?![\w-])")
        self.left_out: Counter[str] = Counter()

    def all(self) -> Iterator[tuple[tuple[Package, str], list[Any]]]:
        """Each launch file, by its package and its place in the share folder, with its rows."""
        for name, package in sorted(self._packages.items()):
            if OF_TESTS.search(name):
                continue
            paths = list(self._launch_files(package))
            self._run([path for path in paths if path.endswith(PYTHON_SUFFIX)])
            for path in paths:
                actions = self._actions(path)
                where = installed_at(self._sources, package, path) or (str(Path(path).relative_to(package.share)),)
                if actions is None:
                    continue
                for below in where:
                    yield (package, below), list(self._rows(actions, 0, package.name, str(Path(below).parent)))

    def _launch_files(self, package: Package) -> Iterator[str]:
        share = Path(package.share)
        for path in sorted(share.rglob("*")):
            below = path.relative_to(share)
            if not path.is_file() or not _TEST_FOLDERS.isdisjoint(below.parts) or path.name.endswith(".test"):
                continue
            if any((each / "package.xml").exists() for each in path.parents if share in each.parents):
                continue
            if path.suffix == PYTHON_SUFFIX:
                if self._generation == 2 and LAUNCH_FUNCTION.search(path.read_text(encoding="utf-8", errors="replace")):
                    yield str(path)
            elif path.name.endswith(LAUNCH_SUFFIXES) or (path.suffix == ".xml" and path.parent.name == LAUNCH_FOLDER):
                yield str(path)

    def _run(self, paths: list[str]) -> None:
        for start in range(0, len(paths), _TOGETHER):
            roots = [Root.of(path, {}) for path in paths[start : start + _TOGETHER]]
            resolve_together(self._workspace, roots, Resolving(self._results, self._runner))

    def _actions(self, path: str) -> tuple[Action, ...] | None:
        if path.endswith(PYTHON_SUFFIX):
            return self._told(path)
        found = self._sources.launch_file(path, self._generation)
        if isinstance(found, Unreadable) or found.root is None or found.generation != self._generation:
            self.left_out["no launch file of this generation"] += 1
            return None
        if found.document.problems or found.document.entities:
            self.left_out["malformed"] += 1
            return None
        return found.root.children

    def _told(self, path: str) -> tuple[Action, ...] | None:
        """What the run of a Python launch file told, where it came to its end."""
        for command in self._workspace.static(path, {}).tree.commands:
            asked = parse_request(command.line) if command.launch_file else None
            if asked is None or asked["file"] != path or asked["calls"] or command.result is None:
                continue
            told = json.loads(command.result.output) if command.result.status == "done" else {"error": "not run"}
            if told.get("error") is None:
                return actions_of(told["actions"], PythonSource("", LineIndex("")), Span(0, 0))
            why = told["error"].get("message", "") if isinstance(told["error"], dict) else command.result.reason
            print(f"  {path.removeprefix(str(self._laid.folder))}: {why}", flush=True)
        self.left_out["not run to its end"] += 1
        return None

    def _rows(self, actions: Iterable[Action], depth: int, package: str, folder: str) -> Iterator[list[Any]]:
        for action in actions:
            if action.kind in _SAYS_NOTHING:
                continue
            row: list[Any] = [depth, action.kind, self._attributes(action, package, folder)]
            body = self._body(action)
            yield [*row, body] if body else row
            yield from self._rows(action.children, depth + 1, package, folder)

    def _attributes(self, action: Action, package: str, folder: str) -> Mapping[str, Any]:
        return {
            attribute.name: self._value(attribute.value, package, folder)
            for attribute in action.attributes
            if attribute.name not in _OF_PEOPLE
        }

    def _body(self, action: Action) -> str:
        """Of a `<rosparam>` the parameters, without comments."""
        text = action.body.text.strip()
        if not text:
            return ""
        try:
            plain = json.dumps(yaml.safe_load(text))
        except (yaml.YAMLError, TypeError):
            return ""
        return plain if len(plain) <= 10 * _LONGEST else ""

    def _value(self, value: Value, package: str, folder: str) -> Any:
        if self._generation == 1:
            where = f"$(find {package})" + ("" if folder == "." else f"/{folder}")
            return _WHERE.sub(where, value.text)
        if value.typed is not None:
            plain = value.typed.value
            return list(self._text(plain)) if isinstance(plain, str) else self._plain(plain)
        parts = list(self._parts(value.parts, package, folder))
        return parts[0] if len(parts) == 1 and isinstance(parts[0], str) else parts or ""

    def _parts(self, parts: Iterable[Literal | Substitution], package: str, folder: str) -> Iterator[Any]:
        for part in parts:
            if isinstance(part, Literal):
                yield from self._text(part.text)
            elif part.command == "dirname":
                yield ["find-pkg-share", [package]]
                yield "" if folder == "." else f"/{folder}"
            elif part.command == "own" and part.words[-1][0].text in _OF_NAV2:
                yield ["unknown", [part.words[-1][0].text]]
            elif part.command == "unknown" and (found := _MARKED.match(part.arguments)):
                yield [_MEANT[found[1]], [found[2]]]
            else:
                yield [part.command, *(list(self._parts(word, package, folder)) for word in part.words)]

    def _plain(self, value: Any) -> Any:
        """What is no text, where all of it is a fact."""
        written = json.dumps(value)
        is_fact = len(written) <= 10 * _LONGEST and str(self._laid.folder) not in written
        return {"v": value} if is_fact else [["unknown", ["a value"]]]

    def _text(self, text: str) -> Iterator[Any]:
        """A text, with the folders of packages as substitutions; one that is too long is not known."""
        for piece in self._in_share.split(text):
            if piece in self._shares:
                yield ["find-pkg-share", [self._shares[piece]]]
            elif len(piece) > _LONGEST or str(self._laid.folder) in piece:
                yield ["unknown", ["a text"]]
            elif piece:
                yield piece
