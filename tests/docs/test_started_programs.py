"""The page on security lists all places that start a program outside of the sandbox: no more and no fewer."""

from __future__ import annotations

import ast
import re
from pathlib import Path

ROOT = Path(__file__).parents[2]
PACKAGES = (ROOT / "analysis/preflight_analysis", ROOT / "server/preflight_server")
INSIDE = ROOT / "analysis/preflight_analysis/tracing/agents"
"""What runs in the sandbox itself."""
_STARTING = re.compile(
    r"subprocess\.(run|Popen|call|check_call|check_output|getoutput|getstatusoutput)|pty\.\w+|multiprocessing\b.*"
    r"|os\.(system|popen|startfile|fork|forkpty|exec\w+|spawn\w+|posix_spawn\w*)"
    r"|asyncio\.(subprocess\.)?create_subprocess_\w+|concurrent\.futures\.ProcessPoolExecutor"
    r"|anyio\.(run_process|open_process)"
)


def starts(source: str) -> set[str]:
    """The names in a module that start programs, however they were imported."""
    imported: dict[str, str] = {}
    found = set()
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            imported |= {(alias.asname or alias.name.split(".")[0]): alias.name for alias in node.names}
            found |= {alias.name for alias in node.names if _STARTING.fullmatch(alias.name)}
        elif isinstance(node, ast.ImportFrom):
            imported |= {alias.asname or alias.name: f"{node.module}.{alias.name}" for alias in node.names}
            found |= {whole for alias in node.names if _STARTING.fullmatch(whole := f"{node.module}.{alias.name}")}
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Attribute):
            words = ast.unparse(node).split(".")
            whole = ".".join([imported.get(words[0], words[0]), *words[1:]])
            found |= {whole} if _STARTING.fullmatch(whole) else set()
    return found


def in_python() -> set[str]:
    return {
        str(path.relative_to(package))
        for package in PACKAGES
        for path in package.rglob("*.py")
        if not path.is_relative_to(INSIDE) and starts(_without_annotations(path.read_text(encoding="utf-8")))
    }


def _without_annotations(source: str) -> str:
    """`subprocess.Popen[bytes]` names a type only."""
    return re.sub(r"subprocess\.Popen\[\w+\]", "object", source)


def in_the_extension() -> set[str]:
    folder = ROOT / "vscode-client/src"
    runs = re.compile(r"""["'](?:node:)?child_process["']|\brun\b[^}]*\} from "\./processes"|new LanguageClient\(""")
    users = {path for path in folder.glob("*.ts") if runs.search(path.read_text(encoding="utf-8"))}
    return {f"vscode-client/src/{path.name}" for path in users if path.name != "processes.ts"}


def named_programs() -> set[str]:
    """Programs that the code names by their paths, or looks for on the `PATH`, to be part of some command line."""
    found = set()
    for package in PACKAGES:
        for path in package.rglob("*.py"):
            if path.is_relative_to(INSIDE):
                continue
            for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
                if isinstance(node, ast.Call) and ast.unparse(node.func) == "shutil.which":
                    found |= {each.value for each in node.args if isinstance(each, ast.Constant)}
                elif isinstance(node, ast.Constant) and isinstance(node.value, str):
                    found |= {node.value} if re.fullmatch(r"/(usr/)?s?bin/[\w.+-]+", node.value) else set()
    return {name if name == "/bin/sh" else name.rpartition("/")[2] for name in map(str, found)}


def listed(column: int = 1) -> set[str]:
    page = (ROOT / "docs/security.md").read_text(encoding="utf-8")
    section = page.split("## What is started outside of the sandbox")[1].split("\n## ")[0]
    return {
        name
        for row in section.splitlines()
        if row.startswith("| `")
        for name in re.findall("`([^`]+)`", row.split("|")[column])
    }


def test_the_list_is_complete_and_true() -> None:
    assert in_python() | in_the_extension() == listed()


def test_every_program_that_is_part_of_a_command_line_is_listed() -> None:
    """Also what only comes before another: a shell that enters a control group."""
    programs = named_programs()
    assert "/bin/sh" in programs
    assert programs - listed(2) == set()


def test_ways_to_start_a_program_are_seen() -> None:
    for source in (
        "import subprocess\nsubprocess.run(['x'])",
        "from subprocess import Popen as P\nP(['x'])",
        "import os as o\no.system('x')",
        "import os\nstart = os.posix_spawnp",
        "import asyncio\nasync def f(): await asyncio.create_subprocess_exec('x')",
        "import multiprocessing.pool",
        "import anyio\nasync def f(): await anyio.run_process(['x'])",
    ):
        assert starts(source), source
    assert not starts("import subprocess\nexcept_ = subprocess.TimeoutExpired\nimport os\nos.path.join('a')")
