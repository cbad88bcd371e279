"""Builds package folders for tests."""

from __future__ import annotations

from pathlib import Path


def package(folder: Path, name: str | None = None, *, body: str = "", version: str = "1.0.0") -> Path:
    """Make `folder` a package of that name, which is the folder's if none is given."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "package.xml").write_text(
        f"""<?xml version="1.0"?>
<package format="2">
  <name>{name or folder.name}</name>
  <version>{version}</version>
  <description>A package</description>
  <maintainer email="a@example.org">A</maintainer>
  <license>BSD</license>
{body}</package>
"""
    )
    return folder


def file(path: Path, mode: int = 0o644, text: str = "") -> Path:
    """A file of that mode, with its folders."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    path.chmod(mode)
    return path


def script(path: Path) -> Path:
    """An executable file."""
    return file(path, 0o755, "#!/usr/bin/env python3\n")


def space(folder: Path, *sources: Path) -> Path:
    """A catkin devel space of these source folders, or an install space if there are none."""
    file(folder / ".catkin", text=";".join(map(str, sources)))
    return folder
