"""Files of robot descriptions in a package of a workspace, and what is said of each for itself."""

from __future__ import annotations

import tempfile
from collections.abc import Mapping
from pathlib import Path

from preflight_analysis.documents.disk import Disk
from preflight_analysis.environment.detect import detect_environment
from preflight_analysis.findings.finding import Finding
from preflight_analysis.rules.registry import found_in_description
from preflight_analysis.workspace.sources import Sources

from support.packaging import CMAKE, lay_out


def xacro(text: str, name: str = "arm") -> str:
    """A file of xacro with this in it; one without a name is made to be included."""
    named = f' name="{name}"' if name else ""
    return f'<robot xmlns:xacro="http://www.ros.org/wiki/xacro"{named}>\n{text}\n</robot>\n'


def findings(files: Mapping[str, str], rule: str = "", folder: Path | None = None) -> list[tuple[str, Finding]]:
    """What is said of the files below the package 'arm', each with its path there."""
    with tempfile.TemporaryDirectory() as temporary:
        home = folder or Path(temporary)
        package = lay_out(home, {**CMAKE, **files})
        environment = detect_environment(str(home), {}, root=str(home / "nothing"))
        disk: Disk = Sources()
        return [
            (name, finding)
            for name in files
            if not name.endswith(".stl")
            for finding in found_in_description(disk, environment, str(package / name))
            if rule in ("", finding.rule)
        ]


def said(files: Mapping[str, str], rule: str = "") -> list[str]:
    """Likewise as texts: `file:line severity message`."""
    texts = []
    for name, finding in findings(files, rule):
        line = files[name].count("\n", 0, finding.location.span.start) + 1
        texts.append(f"{name}:{line} {finding.severity} {finding.message}")
    return texts
