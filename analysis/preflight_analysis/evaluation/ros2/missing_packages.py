"""Which file an include names where its package is not here: the catalogue may have it."""

from __future__ import annotations

from preflight_analysis.catalogue.launches import CataloguedFile
from preflight_analysis.evaluation.catalogued import folder_of_missing, in_catalogue
from preflight_analysis.evaluation.ros2.context import Context
from preflight_analysis.evaluation.ros2.place import Place
from preflight_analysis.evaluation.ros2.state import State
from preflight_analysis.evaluation.ros2.substitute import SHARE, Performer
from preflight_analysis.launch.model import Substitution, Value


def named_in_catalogue(state: State, context: Context, place: Place, value: Value) -> CataloguedFile | None:
    """The file that the value of an include names, which is not known; None where the catalogue has nothing of its
    package."""
    quiet = State(state.within)
    path = _Performer(quiet, context, place).value(value)
    return in_catalogue(path.text, 2, state.environment) if path.known else None


class _Performer(Performer):
    """Has a folder for each package that is not here."""

    def instead(self, part: Substitution) -> str | None:
        text = part.text
        if part.command == "var":
            found = self.context.get(part.arguments)
            text = found.value.text if found is not None else ""
        folders = SHARE.sub(lambda match: folder_of_missing(match[1]), text)
        return folders if folders != text and "$(" not in folders.replace("$(find ", "") else None
