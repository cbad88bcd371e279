"""The cache holds programs and what is believed of nodes: it is the user's own, or it is not used."""

from __future__ import annotations

import os
import stat
from pathlib import Path

import pytest
from preflight_analysis.tracing import cache_folder as module
from preflight_analysis.tracing.cache_folder import VARIABLE, cache_folder, make_private


@pytest.fixture(autouse=True)
def forget() -> None:
    module._in_place_of.cache_clear()


def test_each_level_is_made_for_the_user_alone(tmp_path: Path) -> None:
    before = os.umask(0)
    try:
        make_private(tmp_path / "a/b/c")
        make_private(tmp_path / "a/b/c")
    finally:
        os.umask(before)
    modes = [stat.S_IMODE((tmp_path / name).stat().st_mode) for name in ("a", "a/b", "a/b/c")]
    assert modes == [0o700] * 3


def test_another_users_folder_is_not_used(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    monkeypatch.setenv(VARIABLE, str(tmp_path / "cache"))
    assert cache_folder("traces") == tmp_path / "cache/traces"
    make_private(tmp_path / "cache/traces")
    assert cache_folder("traces") == tmp_path / "cache/traces"
    assert caplog.messages == []
    monkeypatch.setattr(os, "geteuid", lambda: tmp_path.stat().st_uid + 1)
    for _ in range(2):
        used = cache_folder("traces")
        assert not used.is_relative_to(tmp_path)
        assert stat.S_IMODE(used.parent.stat().st_mode) == 0o700
    assert len(caplog.messages) == 1
    assert "belongs to another user, so nothing is kept: remove it, or name another one" in caplog.messages[0]


@pytest.mark.parametrize("name", ["cache", "cache/traces"])
def test_a_folder_that_everybody_can_write_to_is_not_used(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    make_private(tmp_path / "cache/traces")
    (tmp_path / name).chmod(0o777)
    monkeypatch.setenv(VARIABLE, str(tmp_path / "cache"))
    assert not cache_folder("traces").is_relative_to(tmp_path)
    assert "everybody can write" in caplog.text
