"""The user's own files that say what parameters of nodes mean, which the settings name."""

from __future__ import annotations

from dataclasses import replace

from preflight_analysis.dataclass import dataclass
from preflight_analysis.documents.disk import text_of
from preflight_analysis.documents.document import Document
from preflight_analysis.documents.reading import Text
from preflight_analysis.documents.span import Location
from preflight_analysis.incremental.database import Database
from preflight_analysis.incremental.query import query
from preflight_analysis.knowledge.model import Knowledge
from preflight_analysis.knowledge.read import read_knowledge
from preflight_analysis.workspace.project_settings import (
    SettingsProblem,
    document_of,
    located,
    project_settings_of,
)


@dataclass(frozen=True, slots=True)
class OwnKnowledge:
    """What the files say. `problems` is what is wrong with them and where, `documents` the texts that this is in."""

    files: tuple[Knowledge, ...] = ()
    problems: tuple[tuple[str, Location], ...] = ()
    documents: tuple[Document, ...] = ()


@query
def own_knowledge(db: Database, folder: str) -> OwnKnowledge:
    """That of a workspace; nothing where its settings name no file."""
    settings = project_settings_of(db, folder)
    files: list[Knowledge] = []
    documents: list[Document] = []
    problems: list[tuple[str, Location]] = []
    missing: list[SettingsProblem] = []
    for path, line in settings.knowledge:
        found = text_of(db, path)
        if not isinstance(found, Text):
            missing.append(SettingsProblem(f"knowledge file '{path}' {found.reason}", line))
            continue
        said = read_knowledge(found.text)
        files.append(replace(said, path=path))
        if said.problems:
            document = document_of(path, found.text)
            documents.append(document)
            problems += located(document, said.problems)
    if missing and settings.path is not None:
        document = document_of(settings.path, settings.text)
        documents.append(document)
        problems += located(document, missing)
    return OwnKnowledge(tuple(files), tuple(problems), tuple(documents))
