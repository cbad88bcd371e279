from __future__ import annotations

from pathlib import Path

from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.environment.executables import ExecutableIndex
from preflight_analysis.environment.model import Executable
from support.package_folders import file, package, script, space


def index(root: Path, *spaces: Path) -> ExecutableIndex:
    """Of an environment whose packages are in `root/src`, and where nothing is installed."""
    variables = {"CMAKE_PREFIX_PATH": ":".join(map(str, spaces))}
    return ExecutableIndex(detect_environment(None, variables, [str(root / "src")], root=str(root)))


def test_script_in_the_source_folder_at_any_depth(tmp_path: Path) -> None:
    share = package(tmp_path / "src" / "p")
    path = str(script(share / "scripts" / "deep" / "node.py"))
    assert index(tmp_path).find("p", "node.py") == Executable(path, (path,), str(share))


def test_devel_space_comes_before_the_source_folder(tmp_path: Path) -> None:
    share = package(tmp_path / "src" / "p")
    source = script(share / "scripts" / "node")
    built = script(space(tmp_path / "devel", tmp_path / "src") / "lib" / "p" / "node")
    found = index(tmp_path, tmp_path / "devel").find("p", "node")
    assert (found.path, found.candidates) == (str(built), (str(built), str(source)))


def test_only_the_first_space_that_has_the_package_counts(tmp_path: Path) -> None:
    package(tmp_path / "src" / "p")
    script(space(tmp_path / "one") / "share" / "p" / "other")
    script(space(tmp_path / "two") / "lib" / "p" / "node")
    assert index(tmp_path, tmp_path / "one", tmp_path / "two").find("p", "node").path is None
    assert index(tmp_path, tmp_path / "two", tmp_path / "one").find("p", "node").path is not None


def test_file_without_permission_is_told_apart_from_none(tmp_path: Path) -> None:
    share = package(tmp_path / "src" / "p")
    plain = file(share / "scripts" / "node.py")
    found = index(tmp_path)
    assert found.find("p", "node.py") == Executable(None, (), str(share), (str(plain),))
    assert found.find("p", "other.py") == Executable(None, (), str(share))
    assert found.find("q", "node.py") == Executable(None)


def test_what_is_no_file_is_not_run(tmp_path: Path) -> None:
    share = package(tmp_path / "src" / "p")
    (share / "folder").mkdir()
    (share / "dangling").symlink_to(tmp_path / "gone")
    (share / "loop").symlink_to(share)
    script(share / ".hidden" / "node")
    found = index(tmp_path)
    assert [found.find("p", name).path for name in ("folder", "dangling", "node", "../p/x", "", ".hidden/node")] == [
        None
    ] * 6


def test_names_for_completion(tmp_path: Path) -> None:
    share = package(tmp_path / "src" / "p")
    script(share / "scripts" / "talker.py")
    file(share / "README.md")
    script(space(tmp_path / "devel") / "lib" / "p" / "driver")
    found = index(tmp_path, tmp_path / "devel")
    assert found.names("p") == ("driver", "talker.py")
    assert found.names("q") == ()


def test_a_new_index_sees_new_files(tmp_path: Path) -> None:
    share = package(tmp_path / "src" / "p")
    assert index(tmp_path).find("p", "node").path is None
    script(share / "node")
    assert index(tmp_path).find("p", "node").path == str(share / "node")
