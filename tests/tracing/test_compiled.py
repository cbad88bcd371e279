"""Our own code in the sandbox is compiled once an interpreter, and by the interpreter that reads it."""

from __future__ import annotations

import os
import shutil
import threading
import time
from collections.abc import Callable
from pathlib import Path

import pytest
from preflight_analysis.tracing import compiled, run, sandbox
from preflight_analysis.tracing.backend import Visible
from preflight_analysis.tracing.compiled import Copies
from preflight_analysis.tracing.intact import Intact
from preflight_analysis.tracing.node_recipe import make
from preflight_analysis.tracing.recipe import visible_paths
from support.tracing_harness import SYSTEM_PYTHON, environment, request, write_node

pytestmark = pytest.mark.ros

VISIBLE = Visible(tuple(visible_paths(environment())))


def _compiled(folder: Path) -> list[Path]:
    return sorted(folder.glob("*/**/*.pyc"))


def test_every_module_is_compiled_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    found = Copies(tmp_path).of(SYSTEM_PYTHON, VISIBLE)
    assert found is not sandbox.AGENTS
    sources = sorted(tmp_path.glob("*/**/*.py"))
    assert len(sources) > 15
    assert [path.name.partition(".")[0] for path in _compiled(tmp_path)] == [
        path.stem for path in sorted(sources, key=lambda p: (p.parent / "__pycache__", p.name))
    ]
    monkeypatch.setattr(run, "compile_agents", lambda *_: pytest.fail("compiled again"))
    assert Copies(tmp_path).of(SYSTEM_PYTHON, VISIBLE) == found


def test_a_run_uses_the_copy(tmp_path: Path) -> None:
    """What was compiled counts, not the source beside it: that is what saves the time."""
    agents = Copies(tmp_path / "cache").of(SYSTEM_PYTHON, VISIBLE)
    assert agents is not sandbox.AGENTS  # what is written over is no source of ours
    for source in (*agents.library.glob("*.py"), *agents.aspectlib.glob("*.py")):
        source.write_text("raise SystemExit('the source was read')")
    script = write_node(tmp_path, "import rospy\nrospy.init_node('n')\nrospy.spin()")
    asked = request(script)
    visible = Visible((*visible_paths(environment(tmp_path)), str(tmp_path)))
    raw = run.execute(
        make(environment(tmp_path), asked), {}, run.Inside(visible, SYSTEM_PYTHON, threading.Event(), agents)
    )
    assert [r["own"]["status"] for r in raw.records if r.get("own", {}).get("ev") == "end"] == ["spinning"]
    assert {"node": {"ev": "woven"}} in raw.records


def whole(folder: Path) -> dict[Path, bytes]:
    """The files of a copy that is as it was made; of what is compiled each time has its own digits."""
    (place,) = folder.iterdir()
    assert Intact()(place)
    sources = {path: path.read_bytes() for path in place.rglob("*.*") if path.suffix in (".py", ".json")}
    return sources | dict.fromkeys(place.rglob("*.pyc"), b"")


def lose(path: Path) -> None:
    path.unlink()


def cut(path: Path) -> None:
    path.write_bytes(path.read_bytes()[:100])


def change(path: Path) -> None:
    path.write_bytes(bytes(path.stat().st_size))


@pytest.mark.parametrize(
    ("damage", "name"),
    [
        (lose, "*/lib/preflight_agents/stub_master.py"),
        (cut, "*/lib/preflight_agents/stand_ins/definitions.json"),
        (cut, "*/lib/preflight_agents/__pycache__/supervisor.*.pyc"),
        (change, "*/lib/preflight_agents/__pycache__/supervisor.*.pyc"),
        (lose, "*/.sha256"),
        (shutil.rmtree, "*"),
    ],
)
def test_a_copy_that_is_not_whole_is_made_again(tmp_path: Path, damage: Callable[[Path], object], name: str) -> None:
    copies = Copies(tmp_path)
    made = copies.of(SYSTEM_PYTHON, VISIBLE)
    before = whole(tmp_path)
    (damaged,) = tmp_path.glob(name)
    damage(damaged)
    if damage in (lose, cut) and not name.endswith(".sha256"):  # a process that has read it sees that
        assert copies.of(SYSTEM_PYTHON, VISIBLE) == made
        assert whole(tmp_path) == before
        damage(damaged)
    assert Copies(tmp_path).of(SYSTEM_PYTHON, VISIBLE) == made
    assert whole(tmp_path) == before


@pytest.mark.parametrize(
    "told",
    [
        {"ev": "compiled", "path": "../../escaped.pyc", "data": ""},
        {"ev": "compiled", "path": "site/__pycache__/../../../escaped.pyc", "data": ""},
        {"ev": "compiled", "path": "site/__pycache__/other.cpython-311.pyc", "data": ""},
        {"ev": "compiled", "path": "site/__pycache__/sitecustomize.py", "data": ""},
        {"ev": "compiled", "path": "site/__pycache__/sitecustomize.cpython-311.pyc", "data": "?"},
        {"ev": "compiled", "path": 7, "data": ""},
        {"ev": "compiled", "path": "site/__pycache__/sitecustomize.cpython-311.pyc", "data": ""},
    ],
)
def test_an_interpreter_that_tells_something_else_is_not_believed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, told: dict[str, object]
) -> None:
    """The interpreter may be the workspace's own."""
    monkeypatch.setattr(run, "compile_agents", lambda *_: run.RawRun(records=[{"own": told}]))
    assert Copies(tmp_path / "cache").of(SYSTEM_PYTHON, VISIBLE) is sandbox.AGENTS
    assert [path.name for path in tmp_path.rglob("*")] == ["cache"]


def test_each_interpreter_has_its_own_copy(tmp_path: Path) -> None:
    other = tmp_path / "python3"
    other.write_bytes(Path(SYSTEM_PYTHON).read_bytes())
    other.chmod(0o755)
    copies = Copies(tmp_path / "cache")
    assert copies.of(SYSTEM_PYTHON, VISIBLE) != copies.of(str(other), Visible((*VISIBLE.paths, str(tmp_path))))


def test_a_copy_that_nobody_used_for_long_goes(tmp_path: Path) -> None:
    old, young = tmp_path / "old", tmp_path / "young"
    old.mkdir()
    young.mkdir()
    then = time.time() - compiled.KEPT_SECONDS - 1
    os.utime(old, (then, then))
    used = Copies(tmp_path).of(SYSTEM_PYTHON, VISIBLE)
    assert sorted(tmp_path.iterdir()) == sorted([young, used.site.parent])


def test_without_a_cache_folder_the_sources_are_used(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    assert Copies(tmp_path / "file" / "agents").of(SYSTEM_PYTHON, VISIBLE) is sandbox.AGENTS
