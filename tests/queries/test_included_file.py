"""Which file an `<include>` names, also where the analysis is one of an earlier text."""

from __future__ import annotations

from pathlib import Path

from preflight_analysis.documents.reading import Unreadable
from preflight_analysis.environment.detect import detect
from preflight_analysis.queries.arguments import included_file
from preflight_analysis.workspace.sources import Sources
from preflight_analysis.workspace.workspace import Workspace


def test_what_is_written_now_counts(tmp_path: Path) -> None:
    inner, root = tmp_path / "inner.launch", tmp_path / "root.launch"
    inner.write_text('<launch><arg name="robot"/></launch>')
    sources = Sources()
    workspace = Workspace(detect(str(tmp_path)), sources)
    sources.open(str(root), f'<launch><include file="{tmp_path}/in"/></launch>')
    earlier = workspace.static(str(root))
    sources.open(str(root), f'<launch><include file="{inner}"/></launch>')
    now = sources.launch_file(str(root))
    assert not isinstance(now, Unreadable)
    assert now.document.root is not None
    (include,) = now.document.root.children
    found = included_file(earlier, sources, str(root), include)
    assert found is not None
    assert found.path == str(inner)
