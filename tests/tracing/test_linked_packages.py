"""A package that was installed by links shows the sandbox what they lead to, if that is a package."""

from __future__ import annotations

from pathlib import Path

from preflight_analysis.tracing.recipe import _linked


def test_only_manifests_lead_somewhere(tmp_path: Path) -> None:
    for name in ("source", "installed", "private"):
        (tmp_path / name).mkdir()
    (tmp_path / "source/package.xml").write_text("<package/>")
    (tmp_path / "private/key").write_text("secret")
    manifest = tmp_path / "installed/package.xml"
    manifest.symlink_to(tmp_path / "source/package.xml")
    assert list(_linked(str(manifest))) == [str(tmp_path / "source")]
    for target in ("private/key", "private/package.xml"):
        manifest.unlink()
        manifest.symlink_to(tmp_path / target)
        assert list(_linked(str(manifest))) == []
