"""What a user wants made: on which routes, how many texts, with which errors."""

from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from memorymaze.errors import SettingsError
from memorymaze.options import check_whole
from memorymaze.writing.rates import ErrorRates

GRAMMAR = "grammar"
TABLE_ONE = ErrorRates()


@dataclass(frozen=True, slots=True)
class GenerationRequest:
    """All that determines the texts, besides the code.

    Raises:
        SettingsError: A value has no meaning.
    """

    sites_folder: str | Path | None = None
    """Folder of site plans; None for the shipped ones."""
    site: str | None = None
    """Only this one."""
    route: str | None = None
    """Only this one, such as `R1`."""
    study: Literal["online", "onsite"] | None = None
    iteration: Literal[1, 2] | None = None
    per_cell: int = 10
    """Texts per route, study and iteration."""
    rates: ErrorRates = TABLE_ONE
    paired: bool = False
    """Whether every text with errors comes with the same text without."""
    seed: int = 0
    instruction_files: tuple[str, ...] = ()
    """Right instructions to put errors into; none to tell routes."""

    def __post_init__(self) -> None:
        """Refuse values without meaning."""
        check_whole("--per-cell", self.per_cell, least=1)
        check_whole("--seed", self.seed, least=0)
        if self.paired and self.rates.failure == 0:
            raise SettingsError(
                "--paired: there are no pairs without errors (--errors)"
            )
