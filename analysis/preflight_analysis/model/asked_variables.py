"""Environment variables that Python launch files do without where they are not set: what they are for is empty then."""

from __future__ import annotations

import re

from preflight_analysis.documents.document import Document
from preflight_analysis.findings.lack import Lack
from preflight_analysis.model.context import Context
from preflight_analysis.model.installed import lack_of_variable
from preflight_analysis.model.said import words_of

_ASKED = re.compile(
    r"""\b(?:getenv|environ\.get)\(\s*(?P<quote>['"])(?P<name>\w+)(?P=quote)\s*(?:,\s*(?:''|""|None|\[\])\s*)?\)"""
)


def lack_of_asked(context: Context, file: str, said: str | None = None) -> Lack | None:
    """The first variable that is not set, and that a launch file asks for without a value in its place; `said` are
    words of which one is the variable's name."""
    document = context.documents.get(file)
    if not isinstance(document, Document) or not file.endswith(".py"):
        return None
    words = words_of(said.upper()) if said is not None else None
    for asked in _ASKED.finditer(document.text):
        name = asked["name"]
        if name not in context.environment.variables and (words is None or name.upper() in words):
            return lack_of_variable(context, name)
    return None
