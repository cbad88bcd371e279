"""Regular expressions that are compiled when they are first used."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any


class _LazyPattern:
    def __init__(self, pattern: str) -> None:
        self._pattern = pattern

    def __getattr__(self, name: str) -> Any:
        # Asked for once of each name: what is found is an attribute from then on. `re` remembers the pattern.
        value = getattr(re.compile(self._pattern), name)
        setattr(self, name, value)
        return value


if TYPE_CHECKING:

    def lazy_pattern(pattern: str) -> re.Pattern[str]:
        """As `re.compile`. For the names of XML that takes some milliseconds a pattern, and most texts need few."""

else:
    lazy_pattern = _LazyPattern
