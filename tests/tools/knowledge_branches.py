"""Compares the knowledge files with the branch of each distribution: `make knowledge SOURCES=FOLDER`.

  python tests/tools/knowledge_branches.py --sources FOLDER [--write] [PACKAGE]...

The folder has snapshots of public repositories, `OWNER+NAME/repo`, and `ros+rosdistro/repo`, which names the branches.
A file holds in a distribution where the sources of its branch have all that those it was read from have of it: the
names of executables and plugins, of parameters with their defaults, and of types. `--write` adds those distributions to
the file, with their commits. What is there already stays. What a distribution lacks is printed for reading.
"""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import yaml

sys.path.insert(0, str(Path(__file__).parents[1]))  # tests/, as pytest has it

from preflight_analysis.knowledge.model import ENTRY_KINDS, Entry, Knowledge, Meaning
from preflight_analysis.knowledge.read import read_knowledge

from tools.catalogue.repositories import Snapshot

DATA = Path(__file__).parents[2] / "analysis" / "preflight_analysis" / "knowledge" / "data"
GENERATIONS = (frozenset({"melodic", "noetic"}), frozenset({"humble", "jazzy", "kilted", "rolling"}))
DISTRIBUTIONS = ("melodic", "noetic", "humble", "jazzy", "kilted", "rolling")
_READ = re.compile(r"\.(?:cpp|hpp|h|hh|cc|py|xml|yaml|txt|cfg|in|cmake)\Z|(?:^|/)(?:scripts|bin|nodes)/[^.]+\Z")
_TEST = re.compile(r"(?:^|/)tests?/")
_NEAR = 400
"""Characters behind the name of a parameter in which its default stands."""


def main() -> None:
    """Print what each file says of which distribution, and write it where asked."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sources", type=Path, required=True)
    parser.add_argument("--write", action="store_true")
    parser.add_argument("packages", nargs="*", help="all without")
    options = parser.parse_args()
    branches = _branches(options.sources)
    for path in sorted(DATA.glob("*.yaml")):
        if options.packages and path.stem not in options.packages:
            continue
        knowledge = read_knowledge(path.read_text())
        holding = _holding(options.sources, branches, knowledge)
        if options.write and holding:
            _write(path, knowledge, holding)


def _holding(sources: Path, branches: Mapping[tuple[str, str], str], knowledge: Knowledge) -> Mapping[str, str]:
    """The distributions in which the file holds, beside those that it names, with the commits."""
    try:
        read = Snapshot.of(
            sources, str(knowledge.source.get("repository", "")), str(knowledge.source.get("commit", ""))
        )
    except (FileNotFoundError, KeyError) as error:
        print(f"{knowledge.package}: {error}")
        return {}
    holding = {}
    first = _sources(read, knowledge.package)
    of_generation = [each for each in GENERATIONS if not each.isdisjoint(knowledge.distributions)]
    for distribution in sorted(frozenset[str]().union(*of_generation).difference(knowledge.distributions)):
        snapshot = _snapshot(sources, branches, knowledge, distribution)
        if snapshot is None:
            continue
        there = _sources(snapshot, knowledge.package)
        expected = set(_lacking(knowledge, distribution, first))
        lacking = [each for each in _lacking(knowledge, distribution, there) if each not in expected]
        print(f"{knowledge.package} {distribution}: {lacking or 'holds'}", flush=True)
        if not lacking:
            holding[distribution] = snapshot.commit
    return holding


def _branches(sources: Path) -> Mapping[tuple[str, str], str]:
    """The address and the branch of a repository in a distribution, by the name of the repository."""
    index = Snapshot.of(sources, "ros/rosdistro")
    found = {}
    for distribution in DISTRIBUTIONS[1:]:
        whole = yaml.load(index.text(f"{distribution}/distribution.yaml"), yaml.CSafeLoader)
        for each in whole["repositories"].values():
            source = each.get("source") or each.get("doc") or {}
            if address := re.search(r"github\.com/([^/]+/[^/]+?)(?:\.git)?/?\Z", source.get("url", "")):
                found[distribution, address[1].rpartition("/")[2].lower()] = str(source.get("version", "HEAD"))
    return found


def _snapshot(
    sources: Path, branches: Mapping[tuple[str, str], str], knowledge: Knowledge, distribution: str
) -> Snapshot | None:
    repository = _source(knowledge, "repository")
    branch = branches.get((distribution, repository.rpartition("/")[2].lower()))
    try:
        return Snapshot.of(sources, repository, branch) if branch else None
    except (FileNotFoundError, KeyError) as error:
        print(f"{knowledge.package} {distribution}: {error}")
        return None


def _source(knowledge: Knowledge, key: str) -> str:
    return str(knowledge.source.get(key, ""))


def _sources(snapshot: Snapshot, package: str) -> str:
    """The texts of the package, one behind the other."""
    files = snapshot.files()
    manifests = [each for each in files if each == "package.xml" or each.endswith("/package.xml")]
    named = re.compile(rf"<name>\s*{re.escape(package)}\s*</name>")
    folder = next((each[: -len("package.xml")] for each in manifests if named.search(snapshot.text(each))), None)
    if folder is None:
        return ""
    of_package = [each for each in files if each.startswith(folder) and _READ.search(each) and not _TEST.search(each)]
    return "\n".join(map(snapshot.text, of_package))


def _lacking(knowledge: Knowledge, distribution: str, text: str) -> Iterator[str]:
    """What the sources do not have of what the entries for the distribution say."""
    for entry in knowledge.entries:
        own = set(entry.distributions) - set(knowledge.distributions)
        if own and distribution not in own:
            continue
        yield from _lacking_of(entry, text)


def _lacking_of(entry: Entry, text: str) -> Iterator[str]:
    for kind in ENTRY_KINDS:
        for name in entry.names.get(kind, ()):
            if not re.search(rf"(?<![\w]){re.escape(name)}(?![\w])", text):
                yield name
    for meaning in entry.meanings:
        yield from _lacking_meaning(meaning, text)


def _lacking_meaning(meaning: Meaning, text: str) -> Iterator[str]:
    places: list[int] = []
    for part in meaning.pattern.split("."):
        name = re.sub(r"\{[^}]*\}|\*", "", part)
        if name:
            places = [
                each.end()
                for each in re.finditer(rf"""["'.]{re.escape(name)}["'.]|^\s*{re.escape(name)}:""", text, re.M)
            ]
            if not places:
                yield meaning.pattern
                return
    types = [meaning.type, *(each for by in meaning.type_by.values() for each in by.values())]
    for each in filter(None, types):
        if not re.search(rf"\b{re.escape(each.rpartition('/')[2])}\b", text):
            yield f"{meaning.pattern}: {each}"
    if (
        places
        and (default := _default(meaning.default))
        and not any(re.search(default, text[place : place + _NEAR].partition(";")[0]) for place in places)
    ):
        yield f"{meaning.pattern}: default {meaning.default!r}"


def _default(value: Any) -> str | None:
    """A pattern of the default's text in sources."""
    if isinstance(value, bool):
        return rf"\b{value}\b".replace("True", "(?i:true)").replace("False", "(?i:false)")
    if isinstance(value, str) and value and not value.startswith("$"):
        return re.escape(value)
    if isinstance(value, (int, float)):
        return rf"(?<![\d.]){re.escape(f'{value:g}')}(?:\.0*)?(?!\d)"
    return None


def _write(path: Path, knowledge: Knowledge, holding: Mapping[str, str]) -> None:
    """Add the distributions and, for each, its commit."""
    text = path.read_text()
    every = [each for each in DISTRIBUTIONS if each in holding or each in knowledge.distributions]
    text = re.sub(r"^distributions: \[.*\]$", f"distributions: [{', '.join(every)}]", text, count=1, flags=re.M)
    also = {**(knowledge.source.get("also") or {}), **holding}
    lines = "".join(f"    {name}: {also[name]}\n" for name in sorted(also))
    text = re.sub(r"^  also: *\{.*\}\n|^  also:\n(?:    .*\n)+", "", text, flags=re.M)
    path.write_text(re.sub(r"^(?=distributions:)", f"  also:\n{lines}", text, count=1, flags=re.M))


if __name__ == "__main__":
    main()
