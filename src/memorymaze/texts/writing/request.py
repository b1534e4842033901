"""What a user wants made: on which routes, how many texts, with which errors."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from statistics import fmean
from typing import Literal

from memorymaze.basics.errors import SettingsError
from memorymaze.basics.options import check_whole
from memorymaze.texts.corpus.error_kinds import (
    ERROR_KINDS,
    SURFACE_KINDS,
)
from memorymaze.texts.corpus.published import published_tables

FAILURE, PUBLISHED, NONE = "failure", "published", "none"


@dataclass(frozen=True, slots=True)
class CellRates:
    """What Table I says of one route, study and iteration."""

    failure: float
    """Share of texts with an error."""
    alternative: float
    """Share of texts that describe another way."""
    words_mean: float
    words_sd: float


@dataclass(frozen=True, slots=True)
class ErrorRates:
    """What a user wants; None and empty for Table I's figures."""

    failure: float | None = None
    """Share of texts with one error, of a kind drawn evenly; None for Table I's."""
    kinds: Mapping[str, float] = field(default_factory=dict[str, float])
    """Share of texts with an error of a kind, each drawn by itself; where there are
    any, `failure` does not count."""
    surface: Mapping[str, float] = field(default_factory=dict[str, float])
    """Shares by the names in `SURFACE_KINDS`."""


def parse_rates(text: str) -> ErrorRates:
    """Read what was given with `--errors`.

    Args:
        text: `published`, `none`, or `NAME=SHARE` with commas between, where a name is
            a kind of error, a kind of surface, or `failure` for errors of any kind.

    Raises:
        SettingsError: It says something else, or a share is not from 0 to 1.
    """
    if text == PUBLISHED:
        return ErrorRates()
    if text == NONE:
        return ErrorRates(failure=0.0)
    known = {FAILURE, *(kind.name for kind in ERROR_KINDS), *SURFACE_KINDS}
    shares: dict[str, float] = {}
    for part in text.split(","):
        name, equals, number = part.strip().partition("=")
        name = name.strip().replace("-", "_")
        if not equals or name not in known:
            raise SettingsError(
                f"--errors: expected {PUBLISHED}, {NONE}, or NAME=SHARE with commas "
                f"between, where a name is one of {', '.join(sorted(known))}; got "
                f"{part.strip()!r}"
            )
        if name in shares:
            raise SettingsError(f"--errors: expected {name} once, got it twice")
        shares[name] = _share(name, number)
    failure = shares.pop(FAILURE, None)
    kinds = {name: share for name, share in shares.items() if name not in SURFACE_KINDS}
    if kinds and failure is not None:
        raise SettingsError(
            "--errors: expected failure (any kind) or shares of single kinds, got both"
        )
    surface = {name: share for name, share in shares.items() if name in SURFACE_KINDS}
    return ErrorRates(failure, kinds, surface)


def _share(name: str, number: str) -> float:
    try:
        share = float(number)
    except ValueError:
        share = math.nan
    if not 0 <= share <= 1:
        raise SettingsError(
            f"--errors: expected a share from 0 to 1 for {name}, got {number!r}"
        )
    return share


def cell_rates(
    study: str, iteration: int, site: str, route: str, turns: int
) -> CellRates:
    """Return what Table I says of a cell, or what it makes likely for another route.

    Routes that the paper does not have get the mean rates of the study and iteration,
    no alternative ways, and words in proportion to the number of turns.
    """
    cells = [
        cell
        for cell in published_tables().descriptions
        if (cell.study, cell.iteration) == (study, iteration)
    ]
    for cell in cells:
        if (cell.site, cell.route) == (site, route):
            return CellRates(
                cell.failure_rate,
                cell.alternative_rate or 0.0,
                cell.words_mean,
                cell.words_sd,
            )
    scale = (turns + 1) / (_published_turns() + 1)
    return CellRates(
        fmean(cell.failure_rate for cell in cells),
        0.0,
        max(8.0, scale * fmean(cell.words_mean for cell in cells)),
        scale * fmean(cell.words_sd for cell in cells),
    )


@cache
def _published_turns() -> float:
    """Return the mean number of turns of the paper's six routes."""
    from memorymaze.world.sites import load_sites

    routes = [route for site in load_sites().values() for route in site.routes]
    return fmean(len(route.turns) for route in routes if route.role == "reference")


GRAMMAR = "grammar"
TABLE_ONE = ErrorRates()
PER_CELL = 10


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
    per_cell: int | None = None
    """Texts per route, study and iteration, `PER_CELL` where None; of files one of each."""
    rates: ErrorRates = TABLE_ONE
    paired: bool = False
    """Whether every text with errors comes with the same text without."""
    seed: int = 0
    instruction_files: tuple[str, ...] = ()
    """Right instructions to put errors into; none to tell routes."""

    def __post_init__(self) -> None:
        """Refuse values without meaning."""
        if self.per_cell is not None:
            check_whole("--per-cell", self.per_cell, least=1)
            if self.instruction_files:
                raise SettingsError(
                    "--per-cell: with --from one text is made of each; leave one of them out"
                )
        check_whole("--seed", self.seed, least=0)
        if self.paired and self.rates.failure == 0:
            raise SettingsError(
                "--paired: there are no pairs without errors (--errors)"
            )
