"""What a launch is evaluated in, beside its files."""

from __future__ import annotations

from preflight_analysis.dataclass import dataclass
from preflight_analysis.environment.model import Environment
from preflight_analysis.evaluation.commands import Commands
from preflight_analysis.evaluation.files import Executables, Files


@dataclass(frozen=True, slots=True, eq=False)
class Surroundings:
    """What launches are evaluated in. Equal to itself alone: what is remembered of their parts is remembered for it."""

    files: Files
    executables: Executables
    environment: Environment
    cwd: str
    commands: Commands
