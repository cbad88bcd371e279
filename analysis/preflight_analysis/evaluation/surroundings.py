"""What a launch is evaluated in, beside its files."""

from __future__ import annotations

from preflight_analysis.dataclass import dataclass
from preflight_analysis.environment.model import Environment
from preflight_analysis.evaluation.commands import Commands, NoResults
from preflight_analysis.evaluation.files import Executables, Files
from preflight_analysis.knowledge.model import Knowledge

NO_RESULTS = NoResults()


@dataclass(frozen=True, slots=True, eq=False)
class Surroundings:
    """What launches are evaluated in. Equal to itself alone: what is remembered of their parts is remembered for it."""

    files: Files
    executables: Executables
    environment: Environment
    cwd: str
    """The folder that relative paths are relative to, as that of the terminal."""
    commands: Commands = NO_RESULTS
    """What commands gave: what is not there was not run."""
    knowledge: tuple[Knowledge, ...] = ()
    """That of the user's own files."""
