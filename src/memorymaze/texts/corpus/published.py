"""The figures of the paper's Tables I to III, to stand beside measured ones."""

import json
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Any, Literal

PublishedStudy = Literal["online", "onsite"]
PUBLISHED_MEASURES = ("sr", "osr", "spd", "cls")
"""What Tables II and III give."""


@dataclass(frozen=True, slots=True)
class PublishedDescriptions:
    """A cell of Table I: how one route was described in one iteration of a study."""

    study: PublishedStudy
    site: str
    route: str
    iteration: int
    route_length: float
    """Metres."""
    words_mean: float
    words_median: float
    words_sd: float
    failure_rate: float
    alternative_rate: float | None
    """None online, where everyone described the way shown."""


@dataclass(frozen=True, slots=True)
class PublishedResult:
    """A cell of Table II (has a method) or Table III (has an iteration)."""

    study: PublishedStudy
    site: str
    route: str
    method: str
    """`navgpt`, `navid` or `proposed`."""
    parser: bool
    """Whether the instruction was parsed first."""
    iteration: int | None
    """None in Table II, which takes both together."""
    sr: float
    osr: float
    spd: float
    """Metres."""
    cls: float


@dataclass(frozen=True, slots=True)
class PublishedTables:
    """Everything the paper says in numbers about instructions and results."""

    descriptions: tuple[PublishedDescriptions, ...]
    """Table I."""
    models: tuple[PublishedResult, ...]
    """Table II."""
    iterations: tuple[PublishedResult, ...]
    """Table III: the proposed method with its parser."""
    distinct_words: dict[tuple[str, str], int]
    """By building (`university`, `museum`) and study; the paper gives no rule."""


@cache
def published_tables() -> PublishedTables:
    """Return the paper's figures."""
    source = files("memorymaze.texts.corpus") / "data/published_tables.json"
    tables = json.loads(source.read_text(encoding="utf-8"))
    return PublishedTables(
        descriptions=tuple(
            PublishedDescriptions(**_placed(row))
            for row in tables["table_1_instructions"]
        ),
        models=tuple(
            PublishedResult(iteration=None, **_placed(row))
            for row in tables["table_2_models"]
        ),
        iterations=tuple(
            PublishedResult(method="proposed", parser=True, **_placed(row))
            for row in tables["table_3_iterations"]
        ),
        distinct_words={
            (building, study): count
            for building, counts in tables["vocabulary_distinct_words"].items()
            for study, count in counts.items()
        },
    )


def _placed(row: dict[str, Any]) -> dict[str, Any]:
    """Split `Museum 5F R1` into the site's name and the route: `museum_5f`, `R1`."""
    site, _, name = row["route"].rpartition(" ")
    return {**row, "site": site.lower().replace(" ", "_"), "route": name}
