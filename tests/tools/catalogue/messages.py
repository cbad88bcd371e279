"""Definitions of messages, services and actions, for the stand-ins of modules that are not installed."""

from __future__ import annotations

import json
import re
from pathlib import Path, PurePosixPath

from preflight_analysis.environment.packages import MANIFEST

from tools.catalogue.repositories import Snapshot
from tools.catalogue.sources import GENERATIONS, OF_TESTS, SOURCES

DEFINITIONS = Path("analysis/preflight_analysis/tracing/agents/stand_ins/definitions.json")
KINDS = ("msg", "srv", "action")
_NAME = re.compile(r"<name>\s*([\w-]+)\s*</name>")
_MEMBER = re.compile(r"[A-Za-z][\w/]*(?:<=\d+)?(?:\[(?:<=)?\d*\])?\s+[A-Za-z]\w*(?:\s*=\s*\S.*|\s+\S.*)?\Z")
_TEXT = re.compile(r"(w?string(?:<=\d+)?)\s+([A-Za-z]\w*)\s*=\s*(.*)\Z")


def write_messages(sources: Path) -> None:
    """Write the data anew."""
    found: dict[str, dict[int, str]] = {}
    made_of = []
    for repository, branches in SOURCES.items():
        for distro, branch in branches.items():
            snapshot = Snapshot.of(sources, repository, branch)
            of_repository = definitions_of(snapshot)
            if of_repository:
                made_of.append(f"{repository} {snapshot.commit}")
            for name, text in of_repository.items():
                found.setdefault(name, {}).setdefault(GENERATIONS[distro], text)
    data: dict[str, object] = {"": made_of}
    for name, texts in sorted(found.items()):
        same = len(texts) == len(GENERATIONS) and len(set(texts.values())) == 1
        data[name] = texts[1] if same else {str(generation): text for generation, text in sorted(texts.items())}
    lines = ",\n".join(f"{json.dumps(name)}: {json.dumps(of)}" for name, of in data.items())
    DEFINITIONS.parent.mkdir(parents=True, exist_ok=True)
    DEFINITIONS.write_text(f"{{\n{lines}\n}}\n")
    print(f"{DEFINITIONS.name}: {len(found)} definitions, {DEFINITIONS.stat().st_size} bytes")


def definitions_of(snapshot: Snapshot) -> dict[str, str]:
    """By full name (`std_msgs/msg/String`), without comments."""
    files = snapshot.files()
    folders = {str(PurePosixPath(path).parent) for path in files if PurePosixPath(path).name == MANIFEST}
    found: dict[str, str] = {}
    names: dict[str, str] = {}
    for path in map(PurePosixPath, files):
        kind, folder = path.parent.name, str(path.parent.parent)
        if kind in KINDS and path.suffix == f".{kind}" and folder in folders:
            if folder not in names:
                match = _NAME.search(snapshot.text(str(PurePosixPath(folder) / MANIFEST)))
                names[folder] = match[1] if match is not None else ""
            package = names[folder]
            if package and not OF_TESTS.search(package):
                found[f"{package}/{kind}/{path.stem}"] = plain(snapshot.text(str(path)))
    return found


def plain(text: str) -> str:
    """The members alone: types, names, defaults and constants, and the lines between a request and its response."""
    lines = []
    for line in map(str.strip, text.splitlines()):
        if line.startswith("---"):
            lines.append("---")
            continue
        constant = _TEXT.match(line)
        if constant is not None:  # what looks like a comment is part of a text
            lines.append(f"{constant[1]} {constant[2]}={constant[3]}")
            continue
        member = " ".join(line.partition("#")[0].split())
        if _MEMBER.match(member):
            lines.append(re.sub(r"\s*=\s*", "=", member))
    return "\n".join(lines)
