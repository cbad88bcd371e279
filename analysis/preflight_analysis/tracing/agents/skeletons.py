"""The structure of robot descriptions in packages that are not installed, as the catalogue has it, for xacro.

A file of the catalogue is a JSON list: `[repository, commit, date, licence]`, then for each element, in document order,
`[depth, tag, attributes, text]`; the text may be left out.
"""

from __future__ import annotations

import json
import os
import re
import xml.dom.minidom
from typing import Any, Optional

PACKAGE = "preflight"
"""The attribute of links and joints with the package that the catalogue has them of."""
SUFFIX = ".json"
_MARKED = ("link", "joint")


class Skeletons:
    """`known` has `folder`, that of the data of a distribution, its name `distro`, and `packages`, those that are not
    installed; nothing is known without it."""

    def __init__(self, known: Optional[dict[str, Any]] = None) -> None:
        known = known or {}
        self._folder = str(known.get("folder", ""))
        self._packages = frozenset(known.get("packages", ()))
        self._below = re.compile(re.escape(self._folder) + r"/(\w[\w-]*)(?:/|\Z)" if self._folder else r"(?!)()")
        self.distro = str(known.get("distro", ""))

    def folder_of(self, package: str) -> str:
        """What stands for the share folder of a package; "" where nothing is known of it."""
        return os.path.join(self._folder, package) if package in self._packages else ""

    def package_of(self, path: str) -> str:
        """The package that a path stands below the folder of; "" for any other path."""
        found = self._below.match(path)
        return found[1] if found is not None else ""

    def lacks(self, path: str) -> bool:
        """Whether a path is in a package of which that file is not known."""
        return bool(self.package_of(path)) and not os.path.isfile(os.path.normpath(path) + SUFFIX)

    def document(self, path: str) -> Any:
        """The document of a file, as `xml.dom.minidom` would make it; None where a path is in no package."""
        package = self.package_of(path)
        if not package:
            return None
        with open(os.path.normpath(path) + SUFFIX, encoding="utf-8") as file:
            rows = json.load(file)[1:]
        document = xml.dom.minidom.Document()
        within: list[Any] = [document]
        for depth, tag, attributes, *text in rows:
            element = document.createElement(tag)
            for name, value in attributes.items():
                element.setAttribute(name, value)
            if tag in _MARKED:
                element.setAttribute(PACKAGE, package)
            if text:
                element.appendChild(document.createTextNode(text[0]))
            del within[depth + 1 :]
            within[-1].appendChild(element)
            within.append(element)
        return document

    def without_folders(self, text: str) -> str:
        """A text in which what names a folder of the catalogue is an expression that is not known."""
        return self._below.sub("${unknown}/", text) if self._folder in text else text
