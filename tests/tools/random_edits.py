"""Random edits in a small workspace: what is remembered between them must not show.

  python tests/tools/random_edits.py FOLDER [--generation 2] [--seed N] [--edits N] [--seconds N]

FOLDER has packages, of ROS 1 or ROS 2. Each seed copies a few launch files that include each other, and the YAML files
that they name, and edits them as people do: pieces of other files typed character by character, pasted, deleted,
undone; files saved, closed, opened, created and deleted. After each edit one long-lived `Workspace` is asked about one
of its launches, and so is a new one that has just read the same texts: trees (values, problems, uses, origins),
documents and findings must be the same, also with a graph of made-up interfaces, and nothing may be logged as an error.
The texts themselves go through the server's `TextStore`, as ranges in one of LSP's encodings, and must stay those of
the editor.
"""

from __future__ import annotations

import argparse
import logging
import os
import random
import re
import shutil
import sys
import tempfile
import time
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))  # tests/, as pytest has it

from lsprotocol import types
from preflight_analysis.environment.model import Environment, Package
from preflight_analysis.environment.packages import find_packages
from preflight_analysis.evaluation.tree import LaunchNode
from preflight_analysis.tracing.interface import Endpoint, Interface, Outcome, ParamUse
from preflight_analysis.workspace.run_results import RunResults, node_keys
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Analysis, Workspace
from preflight_server.lsp.text_store import TextStore, to_uri
from support import lsp_client
from support.logged_errors import LoggedErrors

LONGEST = 6_000
"""Of a file, in characters: many edits in small files find more than few in large ones."""
EDITS_IN_ONE_WORKSPACE = 400
_FIND = re.compile(r"\$\(find(?:-pkg-share)? ([\w-]+)\)/([\w./-]+)")
_BESIDE = re.compile(r"\$\(dirname\)/([\w./-]+)")
_VALUE = re.compile(r'"([^"<]*)"')
_NAME = re.compile(r"[A-Za-z]\w*")
_ARG = re.compile(r'<arg\s+name="(\w+)"|- arg:\s*{? *name: (\w+)')
_ROS1_ODDITIES = (
    '<node pkg="p" type="t" name="$(anon n)"/>',
    '<node pkg="p" type="t" name="n"/>',
    '<node pkg="p" type="t" name="n" ns="a" machine="m" clear_params="true">\n  <param name="x" value="1"/>\n</node>',
    '<param name="~private" value="$(anon n)"/>',
    '<param name="x" value="1.0"/>',
    '<param name="x" value="1"/>',
    '<param name="x" type="str" value="1"/>',
    '<param name="x" command="echo 1"/>',
    "<rosparam>x: {y: 1}</rosparam>",
    '<rosparam command="delete" param="x"/>',
    '<rosparam subst_value="true">{x: $(arg a), y: "é𝒳"}</rosparam>',
    '<arg name="a" default="1"/>',
    '<arg name="a" value="2"/>',
    '<arg name="a"/>',
    '<remap from="x" to="y"/>',
    '<remap from="x" to="/z"/>',
    '<env name="E" value="$(arg a)"/>',
    '<machine name="m" address="localhost" default="true"/>',
    '<machine name="m" address="elsewhere"/>',
    '<group ns="g" clear_params="true">',
    "</group>",
    '<group if="$(arg a)">',
    '<group unless="$(eval a == 1)">\n</group>',
    '<include file="$(dirname)/new.launch" pass_all_args="true"/>',
    '<include file="$(dirname)/new.launch"><arg name="a" value="$(anon n)"/></include>',
    '<include file="$(dirname)/new.launch" ns="g" clear_params="true">\n  <arg name="a" value="x"/>\n</include>',
    "<!-- preflight: ignore[PKG002] not built -->",
    "<!-- preflight: ignore[LCH016, PRM002] -->",
    "<![CDATA[",
    "<!--",
    "&amp;&é𝒳\u2028",
    "\r\n",
    "\r",
    ' pass_all_args="true"',
    ' ns="𝒳"',
    ' if="$(arg a)"',
    ' value="$(find p)/x"',
    "$(arg a)",
    "key: [1, 2.0, {a: b}]\n",
    "*alias\n",
)
_ROS1_NEW = (
    '<launch>\n  <arg name="a" default="0"/>\n  <node pkg="p" type="t" name="$(anon n)"/>\n'
    '  <param name="x" value="$(arg a)"/>\n</launch>\n',
    '<launch>\n  <arg name="a"/>\n  <env name="E" value="1"/>\n  <remap from="x" to="w"/>\n'
    '  <machine name="m" address="localhost" default="true"/>\n  <param name="~private" value="new"/>\n</launch>\n',
)
_ROS2_ODDITIES = (
    '<node pkg="p" exec="t" name="$(anon n)"/>',
    '<node pkg="p" exec="t" name="n"/>',
    '<node pkg="p" exec="t" name="n" namespace="a" args="$(dirname)">\n  <param name="x" value="1"/>\n</node>',
    '<node pkg="p" exec="t"><param from="$(dirname)/new.yaml"/><param name="x" value="$(var a)"/></node>',
    '<node pkg="p" exec="$(var b)" name="m"><remap from="x" to="$(env E none)"/><env name="F" value="1"/></node>',
    '<node_container pkg="c" exec="t" name="n" namespace="/">\n<composable_node pkg="p" plugin="P" name="$(anon c)"'
    ' if="$(var a)"/>\n</node_container>',
    '<load_composable_node target="n"><composable_node pkg="p" plugin="P" name="l"/></load_composable_node>',
    '<executable cmd="echo $(var a) $(anon n)"/>',
    '<arg name="a" default="1"/>',
    '<arg name="a"/>',
    '<arg name="b" default="$(var a)$(var a)"><choice value="x"/></arg>',
    '<let name="a" value="true"/>',
    '<let name="b" value="$(var a)-$(var b \'none\')"/>',
    '<set_env name="E" value="$(var a)"/>',
    '<append_env name="E" value="é𝒳"/>',
    '<unset_env name="E"/>',
    "<reset_env/>",
    '<push_ros_namespace namespace="$(var a)"/>',
    '<set_remap from="x" to="/z"/>',
    '<set_parameter name="x" value="1"/>',
    '<set_parameter name="x" value="true"/>',
    '<set_parameter name="x" value="1.0"/>',
    '<set_parameters_from_file filename="$(dirname)/new.yaml"/>',
    '<reset><keep name="a" value="1"/></reset>',
    "<group>",
    '<group scoped="false">',
    '<group forwarding="false"><keep name="a" value="$(var b)"/>',
    "</group>",
    '<group if="$(var a)">',
    "<group unless=\"$(eval '$(var a)' == '1')\">\n</group>",
    '<timer period="1.0">',
    "</timer>",
    '<for len="2" name="i"><node pkg="p" exec="t" name="n$(index i)"/></for>',
    '<include file="$(dirname)/new.launch.xml"/>',
    '<include file="$(dirname)/new.launch.xml"><arg name="a" value="$(anon n)"/></include>',
    '<include file="$(dirname)/new.launch.xml">\n  <arg name="a" value="x"/>\n  <arg name="b" value="y"/>\n</include>',
    '<include file="$(dirname)/new.launch.yaml"/>',
    '<include file="$(var b)"/>',
    "<!-- preflight: ignore[PKG002] not built -->",
    "# preflight: ignore[PKG002]\n",
    "<![CDATA[",
    "<!--",
    "\r\n",
    ' if="$(var a)"',
    "$(var a)",
    "- node: {pkg: p, exec: t, name: $(anon n)}\n",
    "- node: &node {pkg: p, exec: t}\n- node: *node\n",
    "- let: {name: a, value: '2'}\n",
    "- include: {file: $(dirname)/new.launch.xml, arg: [{name: a, value: '3'}]}\n",
    "- set_remap: {from: x, to: $(var a)}\n",
    "- group:\n  - push_ros_namespace: {namespace: g}\n",
)
_ROS2_NEW = (
    '<launch>\n  <arg name="a" default="0"/>\n  <node pkg="p" exec="t" name="$(anon n)"/>\n'
    '  <set_parameter name="x" value="$(var a)"/>\n  <node pkg="p" exec="t" name="n" if="$(var a)"/>\n</launch>\n',
    '<launch>\n  <arg name="a"/>\n  <set_env name="E" value="1"/>\n  <set_remap from="x" to="w"/>\n'
    '  <let name="b" value="$(var a)"/>\n  <push_ros_namespace namespace="new"/>\n'
    '  <include file="$(dirname)/new.launch.yaml"/>\n</launch>\n',
)


@dataclass(frozen=True)
class Language:
    """What people write in the launch files of a generation. `new`: files that come and go."""

    distro: str
    suffixes: tuple[str, ...]
    oddities: tuple[str, ...]
    new: Mapping[str, tuple[str, ...]]


LANGUAGES = {
    1: Language("noetic", (".launch",), _ROS1_ODDITIES, {"new.launch": _ROS1_NEW}),
    2: Language(
        "jazzy",
        (".launch.xml", ".launch.yaml", ".launch.yml"),
        _ROS2_ODDITIES,
        {
            "new.launch.xml": _ROS2_NEW,
            "new.launch.yaml": (
                "launch:\n- arg: {name: a, default: '0'}\n- node: {pkg: p, exec: t, name: $(var a)}\n",
            ),
            "new.yaml": ("/**:\n  ros__parameters:\n    x: 1\n", "n:\n  ros__parameters: {x: {y: 2.0}}\n"),
        },
    ),
}


class Broken(AssertionError):
    """What is remembered showed. The message has all that is needed to see it again."""


@dataclass
class Typing:
    """What is going to be typed, or deleted, character by character."""

    path: str
    at: int
    text: str = ""
    deletions: int = 0


@dataclass
class Harness:
    """An editor with some files open, and the two sides that are compared."""

    chance: random.Random
    folder: str
    environment: Environment
    roots: list[tuple[str, dict[str, str]]]
    pool: list[str]
    paths: list[str]
    encoding: str
    language: Language
    store: TextStore = field(default_factory=TextStore)
    open: dict[str, str] = field(default_factory=dict)
    undo: dict[str, list[str]] = field(default_factory=dict)
    typing: Typing | None = None
    log: list[str] = field(default_factory=list)
    changes: int = 0

    def __post_init__(self) -> None:
        self.store.encoding = self.encoding
        self.sources = Sources()
        self.workspace = Workspace(self.environment, self.sources, self.folder)
        self.originals = {path: Path(path).read_bytes().decode() for path in self.paths}

    # One thing that a user does

    def step(self) -> None:
        """Do something until a text has changed, in the editor or on the disk."""
        before = self.changes
        while self.changes == before:
            self._act()

    def _act(self) -> None:
        if self.typing is not None and self.typing.path in self.open:
            return self._type(self.typing)
        kind = self.chance.choices(
            ["type", "erase", "paste", "cut", "value", "undo", "revert", "open", "close", "save", "delete", "create"],
            [24, 6, 8, 6, 14, 8, 3, 8, 3, 4, 2, 2],
        )[0]
        self.log.append(kind)
        if kind in ("open", "close", "save", "delete", "create"):
            return self._file(kind)
        if not self.open:
            return self._file("open")
        path = self.chance.choice(list(self.open))
        text = self.open[path]
        if len(text) > LONGEST or kind == "revert":
            return self._change(path, 0, len(text), self.originals.get(path, "<launch/>"))
        at = self._place(text)
        if kind == "type":
            self.typing = Typing(path, at, self._snippet())
        elif kind == "erase":
            self.typing = Typing(path, at, deletions=self.chance.randrange(1, 15))
        elif kind == "paste":
            return self._change(path, at, at, self._snippet())
        elif kind == "cut":
            return self._change(path, at, self._place(text) if self.chance.random() < 0.1 else at + 20, "")
        elif kind == "value":
            return self._value(path, text)
        elif kind == "undo" and self.undo[path]:
            return self._change(path, 0, len(text), self.undo[path].pop(-self.chance.randrange(len(self.undo[path]))))
        return None

    def _place(self, text: str) -> int:
        """Mostly at the start of a line, where tags are put; else anywhere."""
        at = self.chance.randrange(len(text) + 1)
        return text.rfind("\n", 0, at) + 1 if self.chance.random() < 0.6 else at

    def _snippet(self) -> str:
        if self.chance.random() < 0.5:
            return self.chance.choice(self.language.oddities)
        lines = self.chance.choice(self.pool).splitlines(keepends=True) or [""]
        start = self.chance.randrange(len(lines))
        return "".join(lines[start : start + self.chance.choice((1, 1, 1, 2, 3, 6))])[:400]

    def _type(self, typing: Typing) -> None:
        if typing.deletions:
            typing.deletions -= 1
            start = max(0, typing.at - 1)
            self._change(typing.path, start, typing.at, "")
            typing.at = start
        else:
            self._change(typing.path, typing.at, typing.at, typing.text[:1])
            typing.at, typing.text = typing.at + 1, typing.text[1:]
        if not typing.deletions and (not typing.text or self.chance.random() < 0.01):
            self.typing = None

    def _value(self, path: str, text: str) -> None:
        """Another value for an attribute, one that an attribute has elsewhere."""
        mine = list(_VALUE.finditer(text))
        others = _VALUE.findall(self.chance.choice([text, *self.pool]))
        if mine and others:
            span = self.chance.choice(mine).span(1)
            if self.chance.random() < 0.5:
                self._change(path, *span, self.chance.choice(others))
            else:
                self._change(path, *span, "")
                self.typing = Typing(path, span[0], self.chance.choice(others))

    def _change(self, path: str, start: int, end: int, new: str) -> None:
        """An editor's edit: a range, which never splits a line break."""
        text = self.open[path]
        start, end = sorted((min(start, len(text)), min(end, len(text))))
        start -= text[start - 1 : start + 1] == "\r\n"
        end += text[end - 1 : end + 1] == "\r\n"
        there = types.Range(
            lsp_client.position(text, start, self.encoding), lsp_client.position(text, end, self.encoding)
        )
        self.changes += 1
        changes = [types.TextDocumentContentChangePartial(there, new)]
        document = self.store.change(to_uri(path), self.changes, changes)
        expected = text[:start] + new + text[end:]
        if document is None or document.text != expected:
            raise Broken(f"the text of {path} is not that of the editor after {there} became {new!r} in {text!r}")
        self.undo[path].append(text)
        self.open[path] = expected
        self.sources.open(path, expected)

    # Files

    def _file(self, kind: str) -> None:
        path = self.chance.choice(self.paths)
        exists = os.path.isfile(path)
        if kind == "open" and path not in self.open and exists:
            text = Path(path).read_bytes().decode()
            self.open[path], self.undo[path] = text, []
            self.store.open(to_uri(path), "roslaunch", 0, text)
            self.sources.open(path, text)
        elif kind == "close" and path in self.open:
            del self.open[path]
            self.store.close(to_uri(path))
            self.sources.close(path)
        elif kind == "save" and path in self.open:
            self._write(path, self.open[path])
        elif kind == "delete" and exists:
            os.unlink(path)
            self.workspace.refresh()
        elif kind == "create" and not exists:
            self._write(path, self.originals.get(path) or self.chance.choice(self.language.new[os.path.basename(path)]))
        else:
            return
        self.changes += 1
        self.log[-1] += " " + path

    def _write(self, path: str, text: str) -> None:
        # As editors do: a new file takes the place of the old one.
        Path(path + "~").write_bytes(text.encode())
        os.replace(path + "~", path)
        self.workspace.refresh()

    # The comparison

    def compare(self) -> None:
        """Raises `Broken` if a fresh look at the same texts tells something else."""
        root, args = self.chance.choice(self.roots)
        remembered = self.workspace.static(root, args)
        whole = _with_graph(self.workspace, remembered)
        sources = Sources()
        for path, text in self.open.items():
            sources.open(path, text)
        workspace = Workspace(self.environment, sources, self.folder)
        fresh = workspace.static(root, args)
        now, then = _state(remembered, whole), _state(fresh, _with_graph(workspace, fresh))
        for what, one in now.items():
            if one != then[what]:
                raise Broken(f"{what} of {root} with {args}:\n{_difference(one, then[what])}")


def _with_graph(workspace: Workspace, analysis: Analysis) -> Analysis:
    """The analysis as if its nodes had been run: what they do is made up from how they are started."""
    told = dict(zip(node_keys(analysis.tree), map(_interface, analysis.tree.nodes), strict=True))
    workspace.set_results(analysis.launch, RunResults(told))
    return workspace.analysed(analysis.root, dict(analysis.args))


def _interface(node: LaunchNode) -> Interface:
    types = ("std_msgs/String", "sensor_msgs/LaserScan", None)
    kinds = ("publisher", "subscriber", "service", "client")
    words = [*_NAME.findall(node.executable + " " + node.args)[:6], "scan"]
    ends = (
        Endpoint(kinds[(len(word) + at) % 4], word if at % 2 else f"~{word}", types[len(word) % 3])
        for at, word in enumerate(words)
    )
    uses = (ParamUse(f"~{word}", "get", mandatory=len(word) % 2 == 0) for word in words)
    return Interface("trace", Outcome("spinning" if len(node.name) % 5 else "crashed"), tuple(ends), tuple(uses))


def _state(analysis: Analysis, whole: Analysis) -> dict[str, str]:
    """All of an analysis as text: unlike an equality that tells 1 from 1.0 and one order from another, and has
    locations by their spans: no line is one of another workspace's."""
    inputs = {path: version.partition(".")[0] for path, version in analysis.tree.inputs.items()}
    documents = {path: (type(d).__name__, d.digest) for path, d in analysis.documents.items()}
    graph = whole.graph
    return {
        "tree": repr(replace(analysis.tree, inputs=inputs)),
        "findings": repr(analysis.findings),
        "documents": repr((documents, list(analysis.launch_files))),
        "graph": repr((graph.topics, graph.services, graph.param_reads) if graph is not None else None),
        "findings with a graph": repr(whole.findings),
    }


def _difference(remembered: str, fresh: str) -> str:
    at = next(
        (at for at, (a, b) in enumerate(zip(remembered, fresh, strict=False)) if a != b),
        min(len(remembered), len(fresh)),
    )
    start = max(0, at - 300)
    return f"  remembered: ...{remembered[start : at + 300]}\n  fresh:      ...{fresh[start : at + 300]}"


def run(
    folder: Path,
    packages: Mapping[str, Package],
    seed: int,
    edits: int,
    deadline: float = float("inf"),
    generation: int = 1,
) -> int:
    """`edits` random edits from `seed` on, in as many workspaces as that takes; how many it were until the deadline."""
    errors = LoggedErrors()
    logging.getLogger().addHandler(errors)
    done = 0
    try:
        while done < edits and time.monotonic() < deadline:
            with tempfile.TemporaryDirectory() as copy:
                harness = make(folder, packages, Path(copy), seed, generation)
                for number in range(min(EDITS_IN_ONE_WORKSPACE, edits - done)):
                    try:
                        harness.step()
                        harness.compare()
                    except Exception as error:
                        raise Broken(f"seed {seed}, edit {number}, {harness.log[-12:]}: {error}") from error
                    if errors.messages:
                        raise Broken(f"seed {seed}, edit {number}, {harness.log[-12:]}: {errors.messages[0]}")
                    done += 1
            seed += 1
    finally:
        logging.getLogger().removeHandler(errors)
    return done


def make(folder: Path, packages: Mapping[str, Package], copy: Path, seed: int, generation: int = 1) -> Harness:
    """A workspace with a copy of some launch file of `folder` and what it reaches."""
    chance, language = random.Random(seed), LANGUAGES[generation]
    files = (path for path in folder.rglob("*.launch*") if path.name.endswith(language.suffixes))
    launch_files = sorted(path for path in files if path.stat().st_size < LONGEST)
    while not (found := _reached(chance.choice(launch_files), packages)):
        pass
    shares = sorted(packages.items(), key=lambda each: -len(each[1].share))
    copies: dict[str, Package] = {}
    paths: list[str] = []
    for path in found:
        name, package = next((n, p) for n, p in shares if path.is_relative_to(p.share))
        share = copy / "src" / name
        if name not in copies:
            share.mkdir(parents=True)
            shutil.copyfile(package.manifest, share / "package.xml")
            copies[name] = Package(name, str(share), str(share / "package.xml"), package.dependencies)
        target = share / path.relative_to(package.share)
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(path.read_bytes())
        paths.append(str(target))
    roots: list[tuple[str, dict[str, str]]] = [
        (path, {}) for path in paths if path.endswith((*language.suffixes, ".xml"))
    ][:3]
    declared = [name or other for name, other in _ARG.findall(Path(paths[0]).read_text())]
    if declared:
        roots.append((paths[0], {name: chance.choice(("true", "x", "1")) for name in declared[:2]}))
    environment = Environment(
        generation, language.distro, {"HOME": "/root"}, (str(copy / "src"),), copies, {}, (), (), None
    )
    pool = [p.read_text() for p in chance.sample(launch_files, min(8, len(launch_files)))]
    pool += [p.read_text() for p in found]
    encoding = chance.choice(lsp_client.ENCODINGS)
    harness = Harness(chance, str(copy), environment, roots, pool, paths, encoding, language)
    paths += (os.path.join(os.path.dirname(paths[0]), name) for name in language.new)
    return harness


def _reached(start: Path, packages: Mapping[str, Package]) -> list[Path]:
    """A launch file and the small files that it names, itself first; nothing where that is not text in a package."""
    found: list[Path] = []
    todo = [start]
    while todo and len(found) < 10:
        path = todo.pop(0)
        if path in found or not path.is_file() or path.stat().st_size > LONGEST:
            continue
        try:
            text = path.read_text()
        except UnicodeDecodeError:
            continue
        if not any(path.is_relative_to(package.share) for package in packages.values()):
            continue
        found.append(path)
        todo += [Path(packages[name].share, rest) for name, rest in _FIND.findall(text) if name in packages]
        todo += [path.parent / rest for rest in _BESIDE.findall(text)]
    return found


def main() -> None:
    """The long run."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--generation", type=int, default=1, choices=LANGUAGES)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--edits", type=int, default=50_000)
    parser.add_argument("--seconds", type=float, default=float("inf"))
    options = parser.parse_args()
    folder = options.folder.resolve()
    packages = find_packages([str(folder)]).packages
    began = time.monotonic()
    done = run(folder, packages, options.seed, options.edits, began + options.seconds, options.generation)
    print(f"{done} random edits from seed {options.seed} on, {time.monotonic() - began:.0f} s: all equal")


if __name__ == "__main__":
    main()
