"""What a rename comes to: edits that say of themselves why they are made, or the reason why there are none."""

from __future__ import annotations

from preflight_analysis.dataclass import dataclass
from preflight_analysis.edits.edit import Edit


class RenameRefusedError(Exception):
    """Why it cannot be renamed, in words for the user."""


@dataclass(frozen=True, slots=True)
class RenameEdit(Edit):
    """An edit of a rename. `label` says what is named at its place, `reason` why that changes with the name at the
    cursor, "" where that shows. `indirect`: it changes what the user may not think of, and is to be confirmed."""

    label: str = ""
    reason: str = ""
    indirect: bool = False
