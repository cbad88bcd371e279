"""What `.gitmodules` lists and nobody has checked out."""

from pathlib import Path

import pytest
from preflight_analysis.documents.disk import Disk
from preflight_analysis.environment.git_submodules import left_submodule, left_submodules_below

LISTS = """
[submodule "messages"]
    path = p/resources
    url = https://example.org/m.git
[submodule "q"]
    path = "q"
"""


@pytest.fixture
def repository(tmp_path: Path) -> Path:
    (tmp_path / ".gitmodules").write_text(LISTS)
    (tmp_path / "p" / "resources").mkdir(parents=True)
    return tmp_path


@pytest.mark.parametrize(
    ("path", "found"),
    [
        ("p/resources/com.yaml", "p/resources"),
        ("p/resources", "p/resources"),
        ("q/launch/q.launch.py", "q"),
        ("p/resources_of_others/com.yaml", None),
        ("p/package.xml", None),
    ],
)
def test_a_path_in_a_submodule(repository: Path, path: str, found: str | None) -> None:
    submodule = left_submodule(Disk(), str(repository / path))
    assert (submodule.path if submodule is not None else None) == found


def test_one_that_is_checked_out_is_there(repository: Path) -> None:
    (repository / "p" / "resources" / "com.yaml").touch()
    assert left_submodule(Disk(), str(repository / "p" / "resources" / "other.yaml")) is None


def test_those_below_a_folder(repository: Path) -> None:
    assert [each.path for each in left_submodules_below(Disk(), str(repository / "p"))] == ["p/resources"]
    assert left_submodules_below(Disk(), str(repository / "r")) == ()
