"""Types of services by their MD5 sums: what a client of roscpp sends is known by its sum alone.

The sums are those of genmsg (genmsg.gentools): of the text of a definition without comments and blanks, its constants
before its fields, a nested message in the place of its type by its own sum. http://wiki.ros.org/msg tells the language.
Where a package installed no definitions, the Python classes that were generated of them name type and sum.
"""

from __future__ import annotations

import hashlib
import os
import re
import threading
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.reading import Unreadable, read_text
from preflight_analysis.environment.model import Environment, Package
from preflight_analysis.environment.walk import is_folder
from preflight_analysis.tracing.interface import Interface

_BUILTIN = re.compile(r"(u?int(8|16|32|64)|float(32|64)|string|bool|char|byte|time|duration)\Z")
_TYPE = re.compile(r"([A-Za-z][\w/]*)((?:\[\d*\])?)\Z")
_GENERATED = re.compile(
    r"""^  _type\s*=\s*["']([A-Za-z]\w*/\w+)["']\s*\n\s*_md5sum\s*=\s*["']([0-9a-f]{32})["']\s*\n\s*_request_class""",
    re.MULTILINE,
)
_PYTHON_FOLDERS = ("lib/python3/dist-packages", "lib/python2.7/dist-packages")
_DEEPEST = 50
"""Messages in messages; those that hold each other have no sum."""


class Definitions:
    """The message and service definitions of packages, as they are on the disk now."""

    def __init__(self, packages: Mapping[str, Package]) -> None:
        self._packages = packages
        self._messages: dict[str, str | None] = {}

    def service(self, package: str, text: str) -> str | None:
        """The sum of a service with this definition, None where it is malformed or a message of it is not at hand."""
        request: list[str] = []
        response: list[str] = []
        part = request
        for line in text.split("\n"):
            if line.startswith("---"):
                part = response
            else:
                part.append(line)
        texts = [self._text(package, part, 0) for part in (request, response)]
        return None if None in texts else _sum("".join(text or "" for text in texts))

    def _message(self, type_: str, depth: int) -> str | None:
        if type_ not in self._messages:
            package, _, name = type_.partition("/")
            folder = self._packages.get(package)
            found = read_text(os.path.join(folder.share, "msg", name + ".msg")) if folder is not None else None
            text = None
            if found is not None and not isinstance(found, Unreadable) and depth < _DEEPEST:
                text = self._text(package, found.text.split("\n"), depth + 1)
            self._messages[type_] = None if text is None else _sum(text)
        return self._messages[type_]

    def _text(self, package: str, lines: Iterable[str], depth: int) -> str | None:
        """What the sum is made of."""
        constants: list[str] = []
        fields: list[str] = []
        for line in lines:
            clean = line.partition("#")[0].strip()
            if not clean:
                continue
            words = [word.strip() for word in clean.split(" ") if word.strip()]
            if "=" in clean:
                constant = _constant(line, words)
                if constant is None:
                    return None
                constants.append(constant)
                continue
            type_ = _TYPE.match(words[0])
            if type_ is None or len(words) != 2:
                return None
            if _BUILTIN.match(type_[1]):
                fields.append(f"{words[0]} {words[1]}")
                continue
            full = "std_msgs/Header" if type_[1] == "Header" else type_[1]
            nested = self._message(full if "/" in full else f"{package}/{full}", depth)
            if nested is None:
                return None
            fields.append(f"{nested} {words[1]}")
        return "\n".join(constants + fields).strip()


def _constant(line: str, words: list[str]) -> str | None:
    """In a string the sign of a comment is none."""
    if words[0] == "string":
        name, _, value = line[line.find(" ") + 1 :].partition("=")
        return f"string {name.strip()}={value.strip()}"
    parts = " ".join(words[1:]).split("=")
    return f"{words[0]} {parts[0].strip()}={parts[1].strip()}" if len(parts) == 2 else None


def _sum(text: str) -> str:
    return hashlib.md5(text.encode(), usedforsecurity=False).hexdigest()


@dataclass(frozen=True, slots=True)
class _File:
    package: str
    path: str
    modified: int
    size: int


class ServiceTypes:
    """Which service has which sum, of all packages of one environment. Thread-safe; raises nothing.

    The first question reads thousands of files, and one that cannot be answered looks at the disk again: not for what
    is done at each key.
    """

    def __init__(self, environment: Environment) -> None:
        self._environment = environment
        self._lock = threading.Lock()
        self._seen: frozenset[_File] | None = None
        self._types: dict[str, set[str]] = {}

    def of(self, md5: str) -> str | None:
        """The type, None where none or several have this sum."""
        with self._lock:
            if md5 not in self._types:
                self._read()
            types = self._types.get(md5, set())
            return next(iter(types)) if len(types) == 1 else None

    def name_clients(self, interface: Interface) -> Interface:
        """The interface with the types of clients that only told their sums."""
        return replace(
            interface,
            endpoints=tuple(
                replace(end, type=self.of(end.md5))
                if end.role == "client" and end.type is None and end.md5 and end.md5 != "*"
                else end
                for end in interface.endpoints
            ),
        )

    def _read(self) -> None:
        seen = frozenset(self._files())
        if seen == self._seen:
            return
        self._seen = seen
        self._types = {}
        definitions = Definitions(self._environment.packages)
        for file in seen:
            if file.path.endswith(".msg"):
                continue
            found = read_text(file.path)
            if isinstance(found, Unreadable):
                continue
            if file.path.endswith(".srv"):
                md5 = definitions.service(file.package, found.text)
                if md5 is not None:
                    name = os.path.basename(file.path).removesuffix(".srv")
                    self._types.setdefault(md5, set()).add(f"{file.package}/{name}")
            else:
                for type_, md5 in _GENERATED.findall(found.text):
                    self._types.setdefault(md5, set()).add(type_)

    def _files(self) -> Iterator[_File]:
        environment = self._environment
        for package in environment.packages.values():
            for folder, extension in (("srv", ".srv"), ("msg", ".msg")):
                yield from _listed(package.name, os.path.join(package.share, folder), extension)
        tops = [
            os.path.join(prefix, folder)
            for prefix in (*environment.devel_spaces, *environment.system_prefixes)
            for folder in _PYTHON_FOLDERS
        ]
        for top in dict.fromkeys([*environment.variables.get("PYTHONPATH", "").split(os.pathsep), *tops]):
            if os.path.isabs(top):
                for package_folder in _folders(top):
                    yield from _listed("", os.path.join(package_folder, "srv"), ".py")


def _folders(top: str) -> list[str]:
    try:
        with os.scandir(top) as entries:
            return [entry.path for entry in entries if is_folder(entry)]
    except OSError:
        return []


def _listed(package: str, folder: str, extension: str) -> Iterator[_File]:
    try:
        with os.scandir(folder) as entries:
            for entry in entries:
                if entry.name.endswith(extension):
                    info = entry.stat()
                    yield _File(package, entry.path, info.st_mtime_ns, info.st_size)
    except OSError:
        return
