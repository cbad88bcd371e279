"""The structure of robot descriptions in packages: links, joints, interfaces, and the macros that make them.

Of an xacro or URDF file the elements that give the robot names and relations are taken, each as a row of plain data.
Shapes, masses, places, materials, meshes, comments and values that decide none of these are not.
"""

from __future__ import annotations

import json
import re
import shutil
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath

from lxml import etree
from preflight_analysis.catalogue.descriptions import DESCRIPTIONS, SUFFIX

from tools.catalogue.repositories import Snapshot
from tools.catalogue.sources import DESCRIPTION_SOURCES

_SUFFIXES = (".xacro", ".urdf", ".gazebo")
_NO_ROBOTS = re.compile(r"(?:\A|[/_])(?:tests?|examples?|worlds?|srdf)(?=[/_.]|\Z)|\.srdf")
_XACRO = re.compile(r"\{http[^{}]*xacro/?\}")
_LONGEST = 200
"""Characters of a value that is still a fact."""
_NAMED: Mapping[str, tuple[str, ...]] = {
    "robot": ("name",),
    "link": ("name",),
    "joint": ("name", "type"),
    "parent": ("link",),
    "child": ("link",),
    "mimic": ("joint",),
    "limit": (),
    "ros2_control": ("name", "type"),
    "hardware": (),
    "plugin": ("name", "filename"),
    "sensor": ("name", "type"),
    "gpio": ("name",),
    "command_interface": ("name",),
    "state_interface": ("name",),
    "transmission": ("name",),
    "hardwareInterface": (),
    "gazebo": ("reference",),
    "frameName": (),
    "frame_name": (),
    "gz_frame_id": (),
    "ignition_frame_id": (),
}
"""The elements that are taken, each with the attributes that are."""
_WITH_TEXT = ("hardwareInterface", "frameName", "frame_name", "gz_frame_id", "ignition_frame_id")
_INSIDE: Mapping[str, tuple[str, ...]] = {
    "link": (),
    "joint": ("parent", "child", "mimic", "limit", "hardwareInterface", "command_interface", "state_interface"),
    "hardware": ("plugin",),
    "transmission": ("joint",),
    "gazebo": ("plugin", "sensor"),
    "sensor": ("plugin", "state_interface", "frameName", "frame_name", "gz_frame_id", "ignition_frame_id"),
}
"""The elements that are taken in others; in any other one all."""
_SAYS_NAMES = re.compile(r"frame|topic|space|name|joint|link|tf|param|remap|base|body|odom|type", re.I)
"""In the names of settings of plugins: those whose values are names, or decide which there are."""
_OF_XACRO = frozenset({"include", "arg", "property", "macro", "if", "unless", "insert_block", "call", "attribute"})
_EMPTY_WITHOUT = frozenset({"xacro:if", "xacro:unless", "gazebo", "sensor"})
"""Elements that mean nothing without one in them that is taken."""
_NAMES = re.compile(r"[A-Za-z_]\w*")
_COMPUTED = re.compile(r"\$\{([^}]*)\}")


@dataclass(slots=True)
class _Row:
    """An element that is taken."""

    tag: str
    attributes: dict[str, str]
    text: str = ""
    children: list[_Row] = field(default_factory=list)

    def all(self) -> Iterator[_Row]:
        """Itself and all that is in it."""
        yield self
        for child in self.children:
            yield from child.all()

    @property
    def is_call(self) -> bool:
        """Whether it calls a macro by its name."""
        return self.tag.startswith("xacro:") and self.tag.removeprefix("xacro:") not in _OF_XACRO

    def data(self, depth: int) -> Iterator[Sequence[object]]:
        """As the catalogue has it."""
        row = (depth, self.tag, self.attributes)
        yield (*row, self.text) if self.text else row
        for child in self.children:
            yield from child.data(depth + 1)


def write_descriptions(sources: Path, only: Collection[str]) -> None:
    """Write the data of all packages anew whose repositories are there."""
    for distro in sorted({distro for branches in DESCRIPTION_SOURCES.values() for distro in branches}):
        branches = {name: of[distro] for name, of in DESCRIPTION_SOURCES.items() if distro in of}
        for snapshot in Snapshot.of_all(sources, branches, only):
            for package in (DESCRIPTIONS / distro).glob("*"):
                if json.loads(next(package.rglob(f"*{SUFFIX}")).read_text())[0][0] == snapshot.repository:
                    shutil.rmtree(package)
            written = list(_write(snapshot, distro))
            print(f"{distro}: {snapshot.repository}: {len(written)} files", flush=True)


def _write(snapshot: Snapshot, distro: str) -> Iterator[Path]:
    packages = _packages(snapshot)
    found = dict(_files(snapshot, packages))
    roots = list(found.values())
    _leave_out_calls(roots)
    _leave_out_values(roots)
    head = (snapshot.repository, snapshot.commit, snapshot.date)
    for (package, licence, below), root in found.items():
        path = DESCRIPTIONS / distro / package / (below + SUFFIX)
        path.parent.mkdir(parents=True, exist_ok=True)
        rows = ((*head, licence), *root.data(0))
        path.write_text("[\n" + ",\n".join(json.dumps(row, ensure_ascii=False) for row in rows) + "\n]\n")
        yield path


def _packages(snapshot: Snapshot) -> Mapping[str, tuple[str, str]]:
    """Name and licence of each package by its folder."""
    found: dict[str, tuple[str, str]] = {}
    for path in snapshot.files():
        if PurePosixPath(path).name == "package.xml":
            root = etree.fromstring(snapshot.text(path).strip().encode())
            licences = sorted({(each.text or "").strip() for each in root.iter("license")})
            found[str(PurePosixPath(path).parent)] = ((root.findtext("name") or "").strip(), ", ".join(licences))
    return found


def _files(snapshot: Snapshot, packages: Mapping[str, tuple[str, str]]) -> Iterator[tuple[tuple[str, str, str], _Row]]:
    """What is taken of each file, by package, licence and place in the share folder."""
    for path in snapshot.files():
        folder = next((str(each) for each in PurePosixPath(path).parents if str(each) in packages), None)
        if folder is None or not path.endswith(_SUFFIXES):
            continue
        package, licence = packages[folder]
        below = str(PurePosixPath(path).relative_to(folder))
        if _NO_ROBOTS.search(below) or _NO_ROBOTS.search(package):
            continue
        parser = etree.XMLParser(resolve_entities=False, no_network=True, remove_comments=True, remove_pis=True)
        try:
            element = etree.fromstring(snapshot.text(path).strip().encode(), parser)
        except etree.XMLSyntaxError as error:
            print(f"  {path}: {error}")
            continue
        if element.tag == "robot" or any("xacro" in uri for uri in element.nsmap.values()):
            yield (package, licence, below), _Row("robot", _taken(element, ("name",)), "", list(_rows(element)))


def _rows(parent: etree._Element) -> Iterator[_Row]:
    for element in parent:
        if isinstance(element.tag, str):
            yield from _row(element, parent)


def _row(element: etree._Element, parent: etree._Element) -> Iterator[_Row]:
    tag = _XACRO.sub("xacro:", element.tag)
    if tag.startswith("xacro:"):
        yield from _of_xacro(element, tag)
    elif tag in _NAMED and tag in _INSIDE.get(_around(parent), _NAMED):
        text = (element.text or "").strip() if tag in _WITH_TEXT or _around(parent) == "hardware" else ""
        children = list(_settings(element) if _around(parent) in ("gazebo", "sensor") else _rows(element))
        if tag == "plugin" and _around(parent) == "hardware":
            children = []
        if tag not in _EMPTY_WITHOUT or children:
            yield _Row(tag, _taken(element, _NAMED[tag]), text, children)


def _around(element: etree._Element) -> str:
    """The tag of the element that something is in, through conditions."""
    found: etree._Element | None = element
    while found is not None and _XACRO.sub("xacro:", found.tag) in ("xacro:if", "xacro:unless"):
        found = found.getparent()
    return _XACRO.sub("xacro:", found.tag) if found is not None else ""


def _settings(element: etree._Element) -> Iterator[_Row]:
    """The settings of a plugin of a simulator that name something; of a sensor what is taken of any."""
    if element.tag != "plugin":
        yield from _rows(element)
        return
    for each in element.iterchildren():
        if isinstance(each.tag, str) and not each.tag.startswith("{"):
            yield from _setting(each)


def _setting(element: etree._Element) -> Iterator[_Row]:
    text = (element.text or "").strip()
    inside = [row for each in element if isinstance(each.tag, str) for row in _setting(each)]
    if inside:
        yield _Row(element.tag, {}, "", inside)
    elif not len(element) and 0 < len(text) <= _LONGEST and _SAYS_NAMES.search(element.tag):
        yield _Row(element.tag, {}, text)


def _of_xacro(element: etree._Element, tag: str) -> Iterator[_Row]:
    name = tag.removeprefix("xacro:")
    attributes = _taken(element, [each for each in map(str, element.attrib) if not each.startswith("{")])
    if _around(element.getparent()) in ("link", "parent", "child", "mimic"):
        return
    if name == "insert_block" and _around(element.getparent()) == "joint":
        return  # where it is
    children = list(_rows(element)) if name in _OF_XACRO else list(_blocks(element))
    if name == "property" and len(element):
        children = list(_blocks(element))
    if children or tag not in _EMPTY_WITHOUT:
        yield _Row(tag, attributes, "", children)


def _blocks(call: etree._Element) -> Iterator[_Row]:
    """The elements that a macro is given: it counts them, whatever they are."""
    for element in call:
        if isinstance(element.tag, str):
            taken = list(_row(element, call))
            yield from taken or (_Row(_XACRO.sub("xacro:", element.tag), {}),)


def _taken(element: etree._Element, names: Iterable[str]) -> dict[str, str]:
    found = {name: " ".join(value.split()) for name in names if (value := element.get(name)) is not None}
    return {name: value for name, value in found.items() if len(value) <= _LONGEST or name == "params"}


def _leave_out_calls(roots: Sequence[_Row]) -> None:
    """What calls a macro that adds nothing of what is taken, which then is nothing but its name and parameters."""
    macros: dict[str, list[_Row]] = {}
    for root in roots:
        for row in root.all():
            if row.tag == "xacro:macro":
                macros.setdefault(row.attributes.get("name", "").removeprefix("xacro:"), []).append(row)
    adds = set(macros)
    while True:
        still = {
            name
            for name in adds
            if any(_adds(child, macros, adds) for macro in macros[name] for child in macro.children)
        }
        if still == adds:
            break
        adds = still
    for name, of in macros.items():
        for macro in of if name not in adds else ():
            macro.children.clear()
    for root in roots:
        _filter(root, lambda row: not row.is_call or _called(row) not in macros or _called(row) in adds)


def _called(row: _Row) -> str:
    return row.tag.removeprefix("xacro:").rpartition(".")[2]


def _adds(row: _Row, macros: Collection[str], adds: Collection[str]) -> bool:
    """Whether an element of a macro adds something, or sets a property for whoever calls it."""
    if row.is_call:
        return (
            _called(row) not in macros
            or _called(row) in adds
            or any(_adds(each, macros, adds) for each in row.children)
        )
    if row.tag == "xacro:property":
        return "scope" in row.attributes
    if row.tag in ("xacro:if", "xacro:unless"):
        return any(_adds(each, macros, adds) for each in row.children)
    return row.tag != "xacro:macro"


def _leave_out_values(roots: Sequence[_Row]) -> None:
    """Properties that nothing of what is taken depends on."""
    properties: list[_Row] = []
    used: set[str] = set()
    for root in roots:
        for row in root.all():
            if row.tag == "xacro:property" and not row.children:
                properties.append(row)
            else:
                used |= _names_in(row)
    while more := {name for row in properties if row.attributes.get("name") in used for name in _names_in(row)} - used:
        used |= more
    kept = {
        id(row)
        for row in properties
        if row.attributes.get("name", "$").find("$") >= 0 or row.attributes["name"] in used
    }
    for root in roots:
        _filter(root, lambda row: row.tag != "xacro:property" or bool(row.children) or id(row) in kept)


def _names_in(row: _Row) -> set[str]:
    """The names that an element may ask for."""
    values = [*row.attributes.values(), row.text]
    if row.tag in ("xacro:if", "xacro:unless"):
        values.append("${" + row.attributes.get("value", "") + "}")
    found = {name for value in values for part in _COMPUTED.findall(value) for name in _NAMES.findall(part)}
    if row.tag == "xacro:insert_block":
        found.add(row.attributes.get("name", ""))
    if row.tag == "xacro:macro":
        found |= set(re.findall(r":=\^\|?(\w*)", row.attributes.get("params", "")))
        found |= set(re.findall(r"(\w+):=\^", row.attributes.get("params", "")))
    return found


def _filter(row: _Row, keeps: Callable[[_Row], bool]) -> None:
    """Takes out what is not kept, and conditions that have nothing in them then."""
    for child in row.children:
        _filter(child, keeps)
    row.children = [
        child for child in row.children if keeps(child) and (child.children or child.tag not in _EMPTY_WITHOUT)
    ]
