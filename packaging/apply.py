"""Writes the version, the address of the repository and how to install into the files that state them.

The version is in `analysis/preflight_analysis/__init__.py`, the rest in `project.toml`. `make docs` calls this; a test
fails when a file is stale.
"""

from __future__ import annotations

import json
import re
import sys
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from urllib.parse import urlsplit

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

ROOT = Path(__file__).resolve().parents[1]
_VERSION = re.compile(r'^__version__ = "([^"]+)"$', re.MULTILINE)
_VENV = "~/.ros-preflight"
_LINK = f"mkdir -p ~/.local/bin && ln -sf {_VENV}/bin/ros-preflight ~/.local/bin/"
_NEEDED = "sudo apt-get install python3-venv bubblewrap"
"""On Debian and Ubuntu: without the first, `python3 -m venv` fails there."""
_FROM_CLONE = f"python3 -m venv {_VENV} && {_VENV}/bin/python -m pip install . && {_LINK}"
_FROM_PYPI = "pipx install ros-preflight"
_SITE = re.compile(r"https://github\.com/[\w.-]+/ros-preflight")
_ACTION = re.compile(r"(?m)(uses: )[\w.-]+/ros-preflight@\S+")
_HOOK = re.compile(r"(?m)^(  rev: )\S+$")
_WIDTH = 120
"""Of a line, for the formatters of the languages."""


@dataclass(frozen=True)
class Project:
    """What the texts depend on. `repository` is the address without a slash at the end."""

    version: str
    repository: str
    published: bool

    @property
    def slug(self) -> str:
        """`OWNER/NAME`."""
        return urlsplit(self.repository).path.strip("/")

    @property
    def revision(self) -> str:
        """What a configuration pins: the tag of the release, or a word to be replaced while there is none."""
        return f"v{self.version}" if self.published else "REVISION"

    @property
    def install(self) -> str:
        """The shell command that installs the server."""
        return _FROM_PYPI if self.published else _FROM_CLONE


def project(root: Path = ROOT) -> Project:
    """What the files of the repository say. Raises `ValueError` where they say nothing."""
    init = (root / "analysis/preflight_analysis/__init__.py").read_text(encoding="utf-8")
    found = _VERSION.search(init)
    if found is None:
        raise ValueError("analysis/preflight_analysis/__init__.py has no __version__")
    data = tomllib.loads((root / "packaging/project.toml").read_text(encoding="utf-8"))
    return Project(found[1], data["repository"].rstrip("/"), data["published"])


def _package_json(text: str, known: Project) -> str:
    manifest = json.loads(text)
    manifest["version"] = known.version
    manifest["homepage"] = f"{known.repository}#readme"
    manifest["repository"] = {"type": "git", "url": f"{known.repository}.git", "directory": "vscode-client"}
    manifest["bugs"] = {"url": f"{known.repository}/issues"}
    return json.dumps(manifest, indent=2, ensure_ascii=False) + "\n"


def _lock_json(text: str, known: Project) -> str:
    """npm's lock names the version of the package itself twice."""
    lock = json.loads(text)
    lock["version"] = lock["packages"][""]["version"] = known.version
    return json.dumps(lock, indent=2, ensure_ascii=False) + "\n"


def _feature_json(text: str, known: Project) -> str:
    feature = json.loads(text)
    feature["version"] = known.version
    feature["documentationURL"] = f"{known.repository}/tree/main/packaging/devcontainer"
    return json.dumps(feature, indent=2, ensure_ascii=False) + "\n"


def _addresses(text: str, known: Project) -> str:
    """Addresses, and what is named by them, wherever they stand in a text."""
    text = _SITE.sub(known.repository, text)
    text = _ACTION.sub(rf"\g<1>{known.slug}@{known.revision}", text)
    return _HOOK.sub(rf"\g<1>{known.revision}", text)


def _mason(text: str, known: Project) -> str:
    return re.sub(r"(?m)^(  id: pkg:pypi/ros-preflight@)\S+$", rf"\g<1>{known.version}", _addresses(text, known))


def _feature_install(text: str, known: Project) -> str:
    source = "ros-preflight==" + known.version if known.published else f"git+{known.repository}"
    return re.sub(r"(?m)^DEFAULT=.*$", f'DEFAULT="{source}"', text)


def _between(mark: str, comment: str, made: Callable[[Project], str]) -> Callable[[str, Project], str]:
    """Replaces the lines between `MARK: begin` and `MARK: end`, which are comments of the file's own kind."""
    begin, end = (comment.format(f"{mark}: {which}") for which in ("begin", "end"))
    block = re.compile(rf"(?ms)^({re.escape(begin)}\n).*?^({re.escape(end)}$)")

    def replaced(text: str, known: Project) -> str:
        changed, count = block.subn(lambda found: f"{found[1]}{made(known)}{found[2]}", text)
        if count != 1:
            raise ValueError(f"{begin} ... {end} stands {count} times")
        return changed

    return replaced


def _assigned(before: str, known: Project, after: str) -> str:
    """A constant with the sentence, as the formatters break lines."""
    where = "Run" if known.published else "In a clone of the repository run"
    value = f"\"{where} '{known.install}'\"{after}"
    line = f"{before} {value}\n"
    return line if len(line) <= _WIDTH else f"{before}\n  {value}\n"


def _typescript(known: Project) -> str:
    return _assigned("const HOW_TO_INSTALL =", known, ";")


def _lua(known: Project) -> str:
    return _assigned("local HOW_TO_INSTALL =", known, "")


def _readme(known: Project) -> str:
    if known.published:
        return f"    {known.install}\n"
    return (
        f"In a clone of this repository, on Debian and Ubuntu after `{_NEEDED}`:\n\n    {known.install}\n\n"
        "Debian and Ubuntu have `~/.local/bin` on the `PATH` from the next login on.\n"
    )


def _install_page(known: Project) -> str:
    if known.published:
        return (
            "```text\n$ pipx install ros-preflight\n$ ros-preflight --version\n"
            f"ros-preflight {known.version}\n```\n"
            "[uv](https://docs.astral.sh/uv/) does the same with `uv tool install ros-preflight`.\n"
            "Use a separate virtual environment, as pipx and uv do, and\n"
        )
    return (
        f"```console\n$ python3 -m venv {_VENV}\n$ {_VENV}/bin/python -m pip install --quiet ./ros-preflight\n...\n"
        f"$ {_VENV}/bin/ros-preflight --version\nros-preflight {known.version}\n```\n"
        f"`./ros-preflight` is a clone of the repository. Debian and Ubuntu need `{_NEEDED}` before.\n"
        "Put the command on your `PATH`, for instance with\n"
        f"`{_LINK}`. Use a separate virtual environment (or pipx), and\n"
    )


_FILES: Mapping[str, tuple[Callable[[str, Project], str], ...]] = {
    "pyproject.toml": (_addresses,),
    "mkdocs.yml": (_addresses,),
    "vscode-client/package.json": (_package_json,),
    "vscode-client/package-lock.json": (_lock_json,),
    "vscode-client/src/serverSession.ts": (_between("how to install", "// {}", _typescript),),
    "server/neovim/lua/ros_preflight/client.lua": (_between("how to install", "-- {}", _lua),),
    "README.md": (_addresses, _between("how to install", "<!-- {} -->", _readme)),
    "docs/start/install.md": (_between("how to install", "<!-- {} -->", _install_page),),
    "docs/ci.md": (_addresses,),
    "packaging/devcontainer/ros-preflight/devcontainer-feature.json": (_feature_json,),
    "packaging/devcontainer/ros-preflight/install.sh": (_feature_install,),
    "packaging/editors/mason/package.yaml": (_mason,),
    "packaging/editors/nvim-lspconfig/lsp/ros_preflight.lua": (_addresses,),
}


def written(known: Project, root: Path = ROOT) -> Iterator[tuple[Path, str, str]]:
    """Each file with its text, and as it should be."""
    for name, changes in _FILES.items():
        path = root / name
        text = was = path.read_text(encoding="utf-8")
        for change in changes:
            text = change(text, known)
        yield path, was, text


def main() -> None:
    """Write what changed."""
    for path, was, text in written(project()):
        if text != was:
            path.write_text(text, encoding="utf-8")
            print(path.relative_to(ROOT))


if __name__ == "__main__":
    main()
