"""What the pages on whole runs show: tables, endings, distributions, errors, settings."""

import math
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from statistics import fmean
from typing import Any

import numpy as np

from memorymaze.basics.errors import RunFolderError
from memorymaze.basics.tables import Column, Table
from memorymaze.basics.wording import counted
from memorymaze.runs.episodes.in_words import ENDINGS, GAVE_UP, ending_words, outcome_of
from memorymaze.runs.episodes.results import EpisodeResult, Measure
from memorymaze.runs.report.pages import error_title
from memorymaze.runs.report.sources import ReportRun, Sources
from memorymaze.runs.tables import COMPARISON, paired_table
from memorymaze.runs.tables.measures import PAPER_QUANTITIES, mean_fields
from memorymaze.runs.work.run_folder import RunRecord
from memorymaze.texts.corpus.records import WRITTEN_BY, Failure, Instruction

BARS = 20
"""Of a distribution, about."""
NO_ERROR, ANY_ERROR = "none", "any"


@dataclass(frozen=True, slots=True)
class _ComparedRuns:
    """Two runs compared."""

    first: ReportRun
    second: ReportRun
    table: Table | None
    """None where no episode is in both."""


@dataclass(frozen=True, slots=True)
class _EndingCount:
    """How many episodes of a run ended in a way."""

    key: str
    """Of its outcome: `arrived`, `elsewhere` or `broken`."""
    title: str
    count: int
    share: float


def compare_pair(first: ReportRun, second: ReportRun) -> _ComparedRuns:
    """Compare two runs on the episodes that both have."""
    try:
        question = replace(
            COMPARISON,
            title=f"{first.title} and {second.title}",
            letters=(first.letter, second.letter),
        )
        table = paired_table([first, second], question)
    except RunFolderError:
        table = None
    return _ComparedRuns(first, second, table)


def count_endings(run: ReportRun) -> list[_EndingCount]:
    """Count how the episodes of a run ended; what never happened is left out."""
    results = run.results
    counts = Counter(
        (outcome_of(each).key, "arrived" if each.success else ending_words(each))
        for each in results
    )
    order = ["arrived", "stopped elsewhere", GAVE_UP, *ENDINGS.values()]
    return [
        _EndingCount(key, title, count, count / len(results))
        for (key, title), count in sorted(
            counts.items(), key=lambda each: order.index(each[0][1])
        )
    ]


def written_by(sources: Sources) -> list[str]:
    """Say who wrote the instructions: `564 written by a LANGUAGE MODEL, …`."""
    texts = {
        result.instruction_id: result.source
        for run in sources.runs
        for result in run.results
    }
    counts = Counter(texts.values())
    return [
        f"{counted(count, 'instruction')} written by {WRITTEN_BY[source]}"
        for source, count in sorted(counts.items())
    ]


@dataclass(frozen=True, slots=True)
class Spread:
    """A measure in one run and study."""

    run: ReportRun
    study: str
    episodes: int
    mean: float
    quantiles: tuple[float, ...]
    """Least, lower quartile, median, upper quartile, greatest."""
    edges: tuple[float, ...]
    """Of the bars; the same for every run and study of a measure."""
    counts: tuple[int, ...]
    """Episodes per bar."""
    highest: int
    """Greatest count of any bar of the measure, for a common scale."""


def spreads(runs: Sequence[ReportRun], measure: Measure) -> list[Spread]:
    """Return how a measure is spread: for every study, run by run."""
    cells: dict[tuple[str, int], list[float]] = {}
    for number, run in enumerate(runs):
        for result in run.results:
            value = float(getattr(result, measure.field))
            cells.setdefault((result.study, number), []).append(value)
    values = [value for cell in cells.values() for value in cell]
    edges = _edges(min(values), max(values))
    counted = {key: np.histogram(cell, edges)[0] for key, cell in cells.items()}
    highest = max(int(count.max()) for count in counted.values())
    return [
        Spread(
            run=runs[number],
            study=study,
            episodes=len(cell),
            mean=fmean(cell),
            quantiles=tuple(np.quantile(cell, [0, 0.25, 0.5, 0.75, 1]).tolist()),
            edges=tuple(edges),
            counts=tuple(map(int, counted[study, number])),
            highest=highest,
        )
        for (study, number), cell in sorted(cells.items())
    ]


def _edges(low: float, high: float) -> list[float]:
    """Return edges at round numbers, about `BARS` of them, that hold low and high."""
    low = min(low, 0.0)
    rough = max(high - low, 1e-6) / BARS
    power = 10.0 ** math.floor(math.log10(rough))
    step = next(
        factor * power for factor in (1, 2, 2.5, 5, 10) if factor * power >= rough
    )
    first, last = math.floor(low / step), max(math.ceil(high / step), 1)
    return [number * step for number in range(first, last + 1)]


@dataclass(frozen=True, slots=True)
class FaultyInstruction:
    """An error of an instruction, and what became of the episode."""

    instruction: Instruction
    failure: Failure
    results: tuple[EpisodeResult | None, ...]
    """One per run; None where a run has none."""


@dataclass(frozen=True, slots=True)
class _TextsWithError:
    """Instructions with a kind of error; one with several kinds is in each."""

    kind: str
    """`none` and `any` for those without and with an error."""
    instructions: int
    results: tuple[Sequence[EpisodeResult], ...]
    """By run."""
    examples: tuple[FaultyInstruction, ...]


def error_kinds(
    runs: Sequence[ReportRun], instructions: Mapping[str, Instruction]
) -> list[_TextsWithError]:
    """Return results by kind of error: without, with any, then the commonest first."""
    results: list[dict[str, list[EpisodeResult]]] = []
    for run in runs:
        by_instruction: dict[str, list[EpisodeResult]] = {}
        for each in run.results:
            by_instruction.setdefault(each.instruction_id, []).append(each)
        results.append(by_instruction)
    followed = sorted(set[str]().union(*results))
    groups: dict[str, list[Instruction]] = {NO_ERROR: [], ANY_ERROR: []}
    for name in followed:
        told = instructions[name]
        kinds = dict.fromkeys(failure.kind for failure in told.failures)
        for kind in (ANY_ERROR, *kinds) if kinds else (NO_ERROR,):
            groups.setdefault(kind, []).append(told)
    general = [(kind, groups.pop(kind)) for kind in (NO_ERROR, ANY_ERROR)]
    by_size = sorted(groups.items(), key=lambda each: (-len(each[1]), each[0]))
    return [_kind(kind, told, results) for kind, told in (*general, *by_size) if told]


def error_table(runs: Sequence[ReportRun], kinds: Sequence[_TextsWithError]) -> Table:
    """Return the results by kind of error, all runs side by side."""
    columns: list[Column] = []
    rows: list[dict[str, Any]] = [
        {
            "kind": error_title(each.kind),
            "page": f"#kind-{number}" if each.examples else None,
            "instructions": each.instructions,
        }
        for number, each in enumerate(kinds, start=1)
    ]
    for index, run in enumerate(runs):
        head = f"{run.letter}: " if len(runs) > 1 else ""
        shown = [
            replace(
                each,
                name=f"{run.letter}_{each.name}",
                heading=f"{head}{each.heading}",
                plot=each.name == "sr",
            )
            for each in PAPER_QUANTITIES
            if each.name in {"sr", "spd"}
        ]
        columns += [Column(f"{run.letter}_episodes", f"{head}episodes"), *shown]
        for row, kind in zip(rows, kinds, strict=True):
            found = kind.results[index]
            row[f"{run.letter}_episodes"] = len(found) or None
            people = [each.participant for each in found]
            none = {each.name: None for each in shown}
            row |= mean_fields(shown, found, people) if found else none
    return Table(
        "Success rate (SR) and shortest walk left to the goal (SPD) by kind of error in "
        "the instruction",
        (
            Column("kind", "Kind of error", "label", link=lambda row: row["page"]),
            Column("instructions", "Instructions"),
            *columns,
        ),
        tuple(rows),
    )


def _kind(
    kind: str,
    told: Sequence[Instruction],
    results: Sequence[Mapping[str, Sequence[EpisodeResult]]],
) -> _TextsWithError:
    of_runs = tuple(
        [result for each in told for result in of_run.get(each.id, ())]
        for of_run in results
    )
    examples = [
        FaultyInstruction(
            each,
            failure,
            tuple(next(iter(of_run.get(each.id, ())), None) for of_run in results),
        )
        for each in told
        for failure in each.failures
        if failure.kind == kind
    ]
    return _TextsWithError(kind, len(told), of_runs, tuple(examples))


def settings_table(record: RunRecord, run: str) -> Table:
    """Return all that `run.json` says, flat: `settings.seed`, `0`, and so on."""
    rows = ({"name": name, "value": each} for name, each in _flat(asdict(record), ""))
    return Table(
        f"run.json of {run}",
        (Column("name", "Setting", "label"), Column("value", "Value")),
        tuple(rows),
    )


def _flat(value: object, name: str) -> Iterator[tuple[str, str]]:
    if isinstance(value, Mapping):
        for key, part in value.items():
            yield from _flat(part, f"{name}.{key}" if name else str(key))
    elif isinstance(value, list | tuple) and value:
        for number, part in enumerate(value):
            yield from _flat(part, f"{name}[{number}]")
    else:
        yield name, "-" if value is None or value == () or value == [] else str(value)
