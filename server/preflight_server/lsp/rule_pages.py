"""The page of a rule as a file on this machine, for editors that follow the link of a diagnostic's code."""

from __future__ import annotations

import logging
from pathlib import Path

from preflight_analysis import __version__
from preflight_analysis.environment.writing import write_file
from preflight_analysis.rules.reference import page
from preflight_analysis.rules.registry import rule_by_id
from preflight_analysis.tracing.cache_folder import cache_folder, make_private

_log = logging.getLogger(__name__)


class RulePages:
    """Pages are written into the cache folder when they are first asked for. May be used from any thread."""

    def __init__(self) -> None:
        self._uris: dict[str, str | None] = {}

    def uri(self, rule_id: str) -> str | None:
        """The URI of the page; None for what is no rule, or where nothing can be written."""
        if rule_id not in self._uris:
            self._uris[rule_id] = self._written(rule_id)
        return self._uris[rule_id]

    def _written(self, rule_id: str) -> str | None:
        rule = rule_by_id(rule_id)
        if rule is None:
            return None
        path: Path = cache_folder("rules") / __version__ / f"{rule.id}.md"
        text = page(rule)
        try:
            if not path.is_file() or path.read_text(encoding="utf-8") != text:
                make_private(path.parent)
                write_file(path, text.encode())
        except OSError as error:
            _log.info("the page of %s cannot be written: %s", rule_id, error)
            return None
        return path.as_uri()
