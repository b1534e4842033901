"""The paper's tables and comparisons of runs, grouped as the pages show them."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import groupby

from memorymaze.errors import RunFolderError
from memorymaze.instructions.records import WRITTEN_BY
from memorymaze.results.report.outcomes import ENDINGS
from memorymaze.results.report.sources import ReportRun, Sources
from memorymaze.results.tables import MeasuredRun, Place, TableName, TableRow
from memorymaze.results.tables.cells import group_title
from memorymaze.results.tables.comparison import Comparison, compare_runs
from memorymaze.results.tables.rows import table_rows


@dataclass(frozen=True, slots=True)
class TableGroup:
    """Rows of a table that stand beneath one heading."""

    study: str
    title: str
    places: tuple[Place, ...]
    is_mean: bool
    rows: tuple[TableRow, ...]


@dataclass(frozen=True, slots=True)
class Pair:
    """Two runs compared."""

    first: ReportRun
    second: ReportRun
    comparison: Comparison | None
    """None where no episode is in both."""


@dataclass(frozen=True, slots=True)
class Ending:
    """How many episodes of a run ended in a way."""

    key: str
    """Of its outcome: `arrived`, `elsewhere` or `broken`."""
    title: str
    count: int
    share: float


def table_groups(runs: Sequence[MeasuredRun], table: TableName) -> list[TableGroup]:
    """Return the rows of a table in their groups; none of studies the paper lacks."""
    rows = table_rows(runs, table)
    groups: list[TableGroup] = []
    for (study, title), chosen in groupby(rows, lambda r: (r.study, group_title(r))):
        group = tuple(chosen)
        places = max((row.places for row in group), key=len)
        groups.append(TableGroup(study, title, places, group[0].is_mean, group))
    return groups


def compare_pair(first: ReportRun, second: ReportRun) -> Pair:
    """Compare two runs on the episodes that both have."""
    try:
        comparison = compare_runs(first.measured, second.measured)
    except RunFolderError:
        comparison = None
    return Pair(first, second, comparison)


def count_endings(run: ReportRun) -> list[Ending]:
    """Count how the episodes of a run ended; what never happened is left out."""
    results = run.measured.results
    counts = Counter(
        "arrived" if each.success else f"by {each.stopped_by}" for each in results
    )
    titles = {
        "arrived": ("arrived", "arrived"),
        "by agent": ("elsewhere", "stopped elsewhere"),
    }
    titles |= {
        f"by {end}": ("broken", words)
        for end, words in ENDINGS.items()
        if end != "agent"
    }
    return [
        Ending(key, words, counts[name], counts[name] / len(results))
        for name, (key, words) in titles.items()
        if counts[name]
    ]


def written_by(sources: Sources) -> list[str]:
    """Say who wrote the instructions: `564 written by a LANGUAGE MODEL, …`."""
    texts = {
        result.instruction_id: result.source
        for run in sources.runs
        for result in run.measured.results
    }
    counts = Counter(texts.values())
    return [
        f"{count} instruction{'' if count == 1 else 's'} written by "
        f"{WRITTEN_BY[source]}"
        for source, count in sorted(counts.items())
    ]
