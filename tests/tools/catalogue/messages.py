"""Definitions of messages, services and actions, for the stand-ins of modules that are not installed."""

from __future__ import annotations

import json
import re
from collections.abc import Collection
from pathlib import Path, PurePosixPath

from preflight_analysis.environment.packages import MANIFEST

from tools.catalogue.repositories import Snapshot
from tools.catalogue.sources import GENERATIONS, OF_TESTS, SOURCES

DEFINITIONS = Path("analysis/preflight_analysis/tracing/agents/stand_ins/definitions.json")
KINDS = ("msg", "srv", "action")
_NAME = re.compile(r"<name>\s*([\w-]+)\s*</name>")
_MEMBER = re.compile(r"[A-Za-z][\w/]*(?:<=\d+)?(?:\[(?:<=)?\d*\])?\s+[A-Za-z]\w*(?:\s*=\s*\S.*|\s+\S.*)?\Z")
_TEXT = re.compile(r"(w?string(?:<=\d+)?)\s+([A-Za-z]\w*)\s*=\s*(.*)\Z")


def write_messages(sources: Path, only: Collection[str]) -> None:
    """Write the data of all packages anew whose repositories are there."""
    kept = json.loads(DEFINITIONS.read_text()) if DEFINITIONS.exists() else {"": []}
    found: dict[str, dict[int, str]] = {}
    made_of: dict[tuple[str, int], str] = {}
    for distro, generation in GENERATIONS.items():
        branches = {repository: of_distro[distro] for repository, of_distro in SOURCES.items() if distro in of_distro}
        for snapshot in Snapshot.of_all(sources, branches, only):
            of_repository = definitions_of(snapshot)
            if of_repository:
                made_of[snapshot.repository, generation] = snapshot.commit
            for name, text in of_repository.items():
                found.setdefault(name, {}).setdefault(generation, text)
    anew = {(name.partition("/")[0], generation) for name, texts in found.items() for generation in texts}
    for name, of in kept.items():
        texts = of if isinstance(of, dict) else dict.fromkeys(map(str, GENERATIONS.values()), of)
        for generation, text in texts.items() if name else ():
            if (name.partition("/")[0], int(generation)) not in anew:
                found.setdefault(name, {})[int(generation)] = text
    renewed = {repository for repository, _ in made_of}
    rows = [row for row in kept[""] if row.partition(" ")[0] not in renewed]
    rows += [f"{repository} {commit}" for (repository, _), commit in made_of.items()]
    order = {repository: at for at, repository in enumerate(SOURCES)}
    data: dict[str, object] = {"": sorted(rows, key=lambda row: order.get(row.partition(" ")[0], -1))}
    for name, texts in sorted(found.items()):
        same = len(texts) == len(GENERATIONS) and len(set(texts.values())) == 1
        data[name] = texts[1] if same else {str(generation): text for generation, text in sorted(texts.items())}
    lines = ",\n".join(f"{json.dumps(name)}: {json.dumps(of)}" for name, of in data.items())
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
