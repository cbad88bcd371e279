"""What pages are put together from. Only their own scripts and styles count, known by their digests: no name that a
file holds can add another one, and nothing is fetched."""

from __future__ import annotations

import base64
import hashlib
import re
from collections.abc import Iterable, Mapping
from importlib.resources import files

_IMPORT = re.compile(r'^import \{[^}]*\} from "\./([a-z]+\.js)";\n', re.MULTILINE)
_EXPORT = re.compile(r"^export (?:\{\};\n|(?=(?:const|function)\b))", re.MULTILINE)


def part(name: str) -> str:
    """A file of the page's folder."""
    return files(__package__).joinpath("page").joinpath(name).read_text(encoding="utf-8")


def script(name: str) -> str:
    """A script of the folder that stands alone: its modules joined, each once and after those that it imports.

    A page that is opened from a file cannot fetch modules, and its policy counts one script. No two modules have a name
    in common, none renames what it imports, and none imports in a circle: tests and Biome hold it."""
    joined: dict[str, str] = {}

    def add(module: str) -> None:
        text = part(module)
        for imported in _IMPORT.findall(text):
            if imported not in joined:
                add(imported)
        joined[module] = _EXPORT.sub("", _IMPORT.sub("", text))

    add(name)
    return '"use strict";\n(() => {\n' + "\n".join(joined.values()) + "})();\n"


def policy(styles: Iterable[str], scripts: Iterable[str]) -> str:
    """The content security policy of a page with these styles and scripts, and nothing else."""
    return (
        f"default-src 'none'; style-src {_digests(styles)}; script-src {_digests(scripts)}; "
        "base-uri 'none'; form-action 'none'"
    )


def template(name: str, values: Mapping[str, str]) -> str:
    """A file of the folder with `%NAME%` replaced; what is put in is not looked at again."""
    return "".join(values[text] if i % 2 else text for i, text in enumerate(part(name).split("%")))


def _digests(texts: Iterable[str]) -> str:
    return " ".join(f"'sha256-{base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()}'" for text in texts)
