"""What a release demands, and what images and dev containers install."""

from __future__ import annotations

import json
import os
import re
import subprocess
from pathlib import Path
from types import SimpleNamespace

import pytest
from support.packaging_scripts import PACKAGING, script

ROOT = Path(__file__).resolve().parents[2]
READY = SimpleNamespace(version="1.2.3", repository="https://github.com/someone/ros-preflight")

release = script("release")
pin = script("pin")


def test_the_section_of_the_changelog() -> None:
    text = "# Changelog\n\n## 1.2.3 (2027-01-31)\n- a\n- b\n\n## 1.2.2 (2026-01-01)\n- c\n"
    assert release.changes("1.2.3", text) == ("2027-01-31", "- a\n- b\n")
    assert release.changes("1.2.2", text) == ("2026-01-01", "- c\n")
    with pytest.raises(SystemExit, match=r"1\.2\.4"):
        release.changes("1.2.4", text)


def test_the_changelog_has_the_version() -> None:
    known = release.project()
    _, section = release.changes(known.version, (ROOT / "CHANGELOG.md").read_text())
    assert "\n- " in section


@pytest.mark.parametrize(
    ("known", "date", "git", "why"),
    [
        (READY, "2027-01-31", {"tag": "v1.2.3\n", "status": ""}, None),
        (READY, "unreleased", {"tag": "v1.2.3\n", "status": ""}, "instead of a date"),
        (READY, "2027-01-31", {"tag": "v1.2.2\n", "status": ""}, "no tag v1.2.3"),
        (READY, "2027-01-31", {"tag": "v1.2.3\n", "status": " M a\n"}, "uncommitted"),
        (
            SimpleNamespace(version="1.2.3", repository="https://github.com/OWNER/x"),
            "2027-01-31",
            {"tag": "v1.2.3\n", "status": ""},
            "placeholder",
        ),
    ],
)
def test_what_is_not_ready_is_not_released(
    known: SimpleNamespace, date: str, git: dict[str, str], why: str | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(release, "run", lambda _, verb, *rest: git[verb])
    monkeypatch.setattr(release.pin, "all_by_tag", list)
    if why is None:
        assert release.check_ready(known, date) is None
    else:
        with pytest.raises(SystemExit, match=why):
            release.check_ready(known, date)


def test_the_image_is_for_each_distribution_and_copies_what_is_there() -> None:
    text = (PACKAGING / "docker/Dockerfile").read_text()
    assert "FROM ros:${ROS_DISTRO}-ros-base" in text
    kept = re.findall(r"(?m)^!(\S+)$", (PACKAGING / "docker/Dockerfile.dockerignore").read_text())
    assert all((ROOT / name).exists() for name in kept)
    (copied,) = re.findall(r"(?m)^COPY (\S+) ", text)
    assert copied in kept
    # The build of the wheel needs them.
    assert {"pyproject.toml", "README.md", "LICENSE", "analysis", "server"} <= set(kept)


@pytest.mark.ros
def test_the_image_sources_ros_and_the_workspace(tmp_path: Path) -> None:
    (tmp_path / "install").mkdir()
    (tmp_path / "install/setup.bash").write_text("export SOURCED=yes\n")
    command = tmp_path / "ros-preflight"
    command.write_text('#!/bin/sh\necho "$SOURCED $*"\nexit 3\n')
    command.chmod(0o755)
    done = subprocess.run(
        ["bash", PACKAGING / "docker/entrypoint.sh", "check", "a b"],
        cwd=tmp_path,
        env={"PATH": f"{tmp_path}:{os.environ['PATH']}", "ROS_DISTRO": "none"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stdout) == (3, "yes check a b\n")


def test_the_feature_of_dev_containers() -> None:
    folder = PACKAGING / "devcontainer/ros-preflight"
    feature = json.loads((folder / "devcontainer-feature.json").read_text())
    # https://containers.dev/implementors/features/: these three are required, the folder has the name of the id
    assert {"id", "version", "name"} <= feature.keys()
    assert feature["id"] == folder.name
    script = (folder / "install.sh").read_text()
    assert set(re.findall(r"\$\{(SOURCE)", script)) == {name.upper() for name in feature["options"]}
    assert os.access(folder / "install.sh", os.X_OK)


PINNABLE = """\
FROM ghcr.io/astral-sh/uv:0.9 AS uv
FROM ros:${ROS_DISTRO}-ros-base
RUN --mount=from=uv true
FROM uv
      - uses: actions/checkout@v6
      - uses: a/b/c@0123456789012345678901234567890123456789 # v1
    container: debian:bookworm
      image: debian:bookworm@sha256:00
"""


def test_what_is_named_by_a_tag_is_found_and_pinned() -> None:
    assert [*pin.by_tag(PINNABLE)] == ["actions/checkout@v6", "ghcr.io/astral-sh/uv:0.9", "debian:bookworm"]
    text = pin.pinned(PINNABLE, lambda repository, tag: f"<{repository} {tag}>", lambda image: "sha256:11")
    assert (
        text
        == """\
FROM ghcr.io/astral-sh/uv:0.9@sha256:11 AS uv
FROM ros:${ROS_DISTRO}-ros-base
RUN --mount=from=uv true
FROM uv
      - uses: actions/checkout@<actions/checkout v6> # v6
      - uses: a/b/c@0123456789012345678901234567890123456789 # v1
    container: debian:bookworm@sha256:11
      image: debian:bookworm@sha256:11
"""
    )


def test_every_action_has_a_commit_and_its_tag() -> None:
    used = [line.strip() for file in pin.FILES for line in (ROOT / file).read_text().splitlines() if " uses: " in line]
    assert used
    assert [line for line in used if not re.search(r"uses: [\w/-]+@[0-9a-f]{40} # v\d", line)] == []


def test_what_has_no_digest_is_not_released(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(release, "run", lambda _, verb, *rest: {"tag": "v1.2.3", "status": ""}[verb])
    monkeypatch.setattr(release.pin, "all_by_tag", lambda: ["ci.yml: debian:bookworm"])
    with pytest.raises(SystemExit, match=r"ci\.yml: debian:bookworm is named by a tag: run `make pin`"):
        release.check_ready(READY, "2027-01-31")


def test_nothing_is_installed_by_name_where_a_release_is_built_or_published() -> None:
    workflow = (ROOT / ".github/workflows/release.yml").read_text()
    assert "npx" not in workflow
    assert all("--require-hashes" in line for line in workflow.splitlines() if "pip install" in line)
    tools = (PACKAGING / "build-requirements.txt").read_text()
    assert all(f"\n{name}==" in tools for name in ("hatchling", "cyclonedx-bom", "uv"))
    pins = re.findall(r"(?m)^[\w.-]+==[^\n]*\\\n    --hash=sha256:", tools)
    assert len(pins) == len(re.findall(r"(?m)^[\w.-]+==", tools))
    lock = json.loads((PACKAGING / "ovsx/package-lock.json").read_text())["packages"]
    assert all("integrity" in each for path, each in lock.items() if path)
    assert lock["node_modules/ovsx"]["version"] == lock[""]["dependencies"]["ovsx"]
