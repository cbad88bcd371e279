"""How many of the recorded answers of real `ros2 launch` about Python launch files are ours too: `make corpus`.

The corpus has the answers and names the projects and commits; the files themselves come from git repositories that
are at hand, each as `<owner>+<name>/repo`, `<owner>+<name>` or `<owner>__<name>` in one folder. Without them nothing
can be compared, and this says so.
"""

from __future__ import annotations

import argparse
import csv
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

MAX_SIZE = 1_000_000
"""Of a file with its text: launch files, parameters and manifests are small, meshes and pictures are not."""


def main() -> int:
    """Take the sources over, evaluate all jobs, compare."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--corpus", type=Path, required=True, help="the recorded answers")
    parser.add_argument("--sources", type=Path, required=True, help="the folder with the git repositories")
    parser.add_argument("--compare", type=Path, required=True, help="compare_ros2.py")
    parser.add_argument("--out", type=Path, default=Path("out/ros2-python"))
    parser.add_argument("--show", default="40", help="how many differences to show")
    options = parser.parse_args()
    with (options.corpus / "repositories.tsv").open() as table:
        rows = list(csv.DictReader(table, delimiter="\t"))
    found = {row["repository"]: repository(options.sources, row["repository"], row["commit"]) for row in rows}
    missing = [name for name, git in found.items() if git is None]
    if missing:
        print(f"Python launch files are not compared: no sources of {', '.join(missing)} in {options.sources}")
        return 0
    options.out.mkdir(parents=True, exist_ok=True)
    for row in rows:
        git = found[row["repository"]]
        assert git is not None
        take_over(git, row["commit"], options.out / "src" / row["folder"])
    for name in ("jobs-python.jsonl", "packages.json"):
        shutil.copyfile(options.corpus / name, options.out / name)
    actual = options.out / "actual.jsonl"
    with actual.open("w") as output:
        batch = ["-m", "preflight_server.cli.main", "tree", "--batch", str(options.out / "jobs-python.jsonl")]
        subprocess.run([sys.executable, *batch], stdout=output, check=True)
    expected = str(options.corpus / "expected-python.jsonl")
    compare = [str(options.compare), "--root", str(options.out), "--show", options.show, expected, str(actual)]
    subprocess.run([sys.executable, *compare], check=False)
    return 0


def repository(sources: Path, name: str, commit: str) -> Path | None:
    """The git folder of `<owner>/<name>` that has the commit."""
    owner, _, project = name.partition("/")
    for folder in (
        sources / f"{owner}+{project}" / "repo",
        sources / f"{owner}+{project}",
        sources / f"{owner}__{project}",
    ):
        git = folder / ".git" if (folder / ".git").exists() else folder
        found = subprocess.run(
            ["git", f"--git-dir={git}", "cat-file", "-e", commit + "^{tree}"], capture_output=True, check=False
        )
        if found.returncode == 0:
            return git
    return None


def take_over(git: Path, commit: str, folder: Path) -> None:
    """The files of a commit, those that are large or not stored without their text; done once."""
    mark = folder.with_name(f".{folder.name}.{commit}")
    if mark.exists():
        return
    for path, mode, content in _files(git, commit):
        file = folder / path
        file.parent.mkdir(parents=True, exist_ok=True)
        if mode == "120000" and content:
            file.unlink(missing_ok=True)
            file.symlink_to(content.decode())
        else:
            file.write_bytes(content)
            file.chmod(0o755 if mode == "100755" else 0o644)
    mark.touch()


def _files(git: Path, commit: str) -> Iterator[tuple[str, str, bytes]]:
    listing = subprocess.run(
        ["git", f"--git-dir={git}", "ls-tree", "-r", "-l", "-z", commit], capture_output=True, check=True
    ).stdout.decode(errors="surrogateescape")
    wanted, large = [], []
    for line in filter(None, listing.split("\0")):
        about, path = line.split("\t", 1)
        mode, kind, blob, size = about.split()
        # What a partial copy lacks has no size.
        if kind == "blob":
            (wanted if size.isdigit() and int(size) <= MAX_SIZE else large).append((path, mode, blob))
    blobs = subprocess.run(
        ["git", f"--git-dir={git}", "cat-file", "--batch"],
        input="".join(f"{blob}\n" for _, _, blob in wanted).encode(),
        capture_output=True,
        check=True,
    ).stdout
    for path, mode, _ in large:
        yield path, mode, b""
    at = 0
    for path, mode, _ in wanted:
        end = blobs.index(b"\n", at)
        head = blobs[at:end].split()
        at = end + 1
        if head[1] == b"missing":
            yield path, mode, b""
            continue
        size = int(head[2])
        yield path, mode, blobs[at : at + size]
        at += size + 1


if __name__ == "__main__":
    sys.exit(main())
