"""Runs beside each other on the same instructions: by route, and after equal metres."""

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import replace

from memorymaze.errors import RunFolderError
from memorymaze.evaluation.results import EpisodeResult
from memorymaze.results.tables.errors import ERROR, by_error_kind
from memorymaze.results.tables.measures import COMPARED_MEASURES, Quantity, quantity_of
from memorymaze.results.tables.questions import PairedQuestion, Pairs
from memorymaze.results.tables.reach import within_ways
from memorymaze.results.tables.runs import (
    ALL,
    STUDY,
    STUDY_OR_ALL,
    MeasuredRun,
    TablePlace,
    groups_of_places,
    place_fields,
    place_of,
    place_title,
    places_of,
    studies_of,
)
from memorymaze.tables import Column, Row

KEY = (
    "{second} - {first}: difference of the means over the same instructions, with the 95 % interval "
    "of a paired bootstrap over participants; p from flipping the signs of whole "
    "participants, two-sided, not corrected for the number of rows. The mean over "
    "routes is unweighted. Arrived: both / only {first} / only {second} / neither."
)
COUNTS = ("both", "only_a", "only_b", "neither")
"""Who arrived."""


def _by_route(_: Sequence[MeasuredRun], pairs: Pairs) -> Iterator[tuple[Row, Pairs]]:
    """Yield the pairs of each route of a study, and of all together."""
    for study in studies_of(one for one, _ in pairs):
        for group in groups_of_places(places_of((one for one, _ in pairs), study)):
            yield _about(study, group, pairs)


def _by_study(runs: Sequence[MeasuredRun], pairs: Pairs) -> Iterator[tuple[Row, Pairs]]:
    """Yield the pairs of each study."""
    for study in studies_of(one for one, _ in pairs):
        group = places_of((one for one, _ in pairs), study)
        about, chosen = _about(study, group, pairs)
        yield {"method": runs[1].label, "run": runs[1].name, **about}, chosen


def _about(study: str, group: Sequence[TablePlace], pairs: Pairs) -> tuple[Row, Pairs]:
    chosen = [
        (one, two)
        for one, two in pairs
        if one.study == study and place_of(one) in group
    ]
    outcomes = Counter((one.success, two.success) for one, two in chosen)
    counts = [outcomes[one, two] for one in (True, False) for two in (True, False)]
    about = {
        "study": study,
        "place": place_title(group),
        **place_fields(group, is_mean=len(group) > 1),
        "episodes": len(chosen),
        "participants": len({one.participant for one, _ in chosen}),
        **dict(zip(COUNTS, counts, strict=True)),
        "arrived": " / ".join(map(str, counts)),
    }
    return about, chosen


def _compared(_: MeasuredRun) -> list[Quantity[EpisodeResult]]:
    return [quantity_of(each) for each in COMPARED_MEASURES]


def _success(run: MeasuredRun) -> list[Quantity[EpisodeResult]]:
    return [each for each in _compared(run) if each.name == "sr"]


COMPARISON = PairedQuestion(
    title="Comparison of two runs",
    name="comparison",
    columns=(
        STUDY,
        Column("place", "Route", "group", is_data=False),
        Column("site"),
        Column("route"),
        Column("episodes", "n", "group"),
        Column("participants"),
        *(Column(name) for name in COUNTS),
        Column("arrived", "arrived:", "group", is_data=False),
        Column("measure", "Measure", "label", show=lambda row: row["heading"]),
    ),
    groups=_by_route,
    quantities=_compared,
    cell=place_of,
    key=KEY,
)
"""Two runs, route by route and measure by measure."""
OVERVIEW = replace(
    COMPARISON,
    title="Success of each run (B) beside {label} (A)",
    columns=(
        STUDY,
        Column("method", "B", "label"),
        Column("run"),
        Column("episodes", "n"),
        Column("arrived", "arrived:", is_data=False),
    ),
    groups=_by_study,
    quantities=_success,
)
"""The success of several runs beside that of the first, on what each shares with it."""

METRES_KEY = (
    "Texts with errors only, by kind of error; several: with more than one kind; any: all "
    "of them. A, B: success that took no longer path than so many times the way described, "
    "and the success distance on top. B - A: mean difference over the same texts, each "
    "counting alike, with the 95 % interval of a paired bootstrap over participants; p from "
    "flipping the signs of whole participants, two-sided, not corrected for the number of "
    "rows."
)


def _by_error(runs: Sequence[MeasuredRun], pairs: Pairs) -> Iterator[tuple[Row, Pairs]]:
    """Yield the pairs on texts with errors, by kind of error: of all studies, and of each."""
    wrong = [one for one, _ in pairs if one.error_kinds]
    if not wrong:
        first, second = runs
        raise RunFolderError(
            f"{first.name} and {second.name}: expected texts whose errors are labelled, got "
            "none that both have"
        )
    after = {one.episode_id: two for one, two in pairs}
    studies = studies_of(wrong)
    groups = {study: [r for r in wrong if r.study == study] for study in studies}
    if len(studies) > 1:
        groups = {ALL: wrong} | groups
    for study, results in groups.items():
        for kind, chosen in by_error_kind(results).items():
            about = {
                "run": runs[1].name,
                "study": study,
                "error": kind,
                "texts": len(chosen),
                "participants": len({each.participant for each in chosen}),
            }
            yield about, [(each, after[each.episode_id]) for each in chosen]


EQUAL_METRES = PairedQuestion(
    title="Texts with errors: success after equally many metres",
    name="equal-metres",
    columns=(
        Column("run"),
        STUDY_OR_ALL,
        replace(ERROR, role="group"),
        Column("texts", "texts", "group"),
        Column("participants"),
        Column("ways", "times the way", "label", show=lambda row: row["heading"]),
    ),
    groups=_by_error,
    quantities=lambda run: within_ways(run.record.settings.success_distance),
    key=METRES_KEY,
)
"""Two runs on texts with errors, within 1, 1.5, 2 and 3 times the way."""
