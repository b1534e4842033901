"""Runs beside each other on the same instructions: by route, and after equal metres."""

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import replace

from memorymaze.basics.errors import RunFolderError
from memorymaze.basics.tables import Column
from memorymaze.runs.tables.errors import ERROR, TEXTS, by_error_kind
from memorymaze.runs.tables.measures import (
    COMPARED_QUANTITIES,
    EPISODES,
    SUCCESS,
    Fact,
    Pairs,
)
from memorymaze.runs.tables.questions import PairedQuestion, RowGroup
from memorymaze.runs.tables.reach import within_ways
from memorymaze.runs.tables.runs import (
    ALL,
    METHOD,
    OF_ROUTE,
    RUN,
    STUDY,
    STUDY_OR_ALL,
    MeasuredRun,
    groups_of_places,
    place_fields,
    place_of,
    places_of,
    studies_of,
)

KEY = (
    "{second} - {first}: difference of the means over the same instructions, with the 95 % interval "
    "of a paired bootstrap over participants; p from flipping the signs of whole "
    "participants, two-sided, not corrected for the number of rows. The mean over "
    "routes is unweighted. Arrived: both / only {first} / only {second} / neither."
)
PARTICIPANTS = Fact(
    "participants", of=lambda pairs: len({one.participant for one, _ in pairs})
)


def _by_route(_: Sequence[MeasuredRun], pairs: Pairs) -> Iterator[RowGroup]:
    """Yield the pairs of each route of a study, and of all together."""
    first = [one for one, _ in pairs]
    for study in studies_of(first):
        for group in groups_of_places(places_of(first, study)):
            about = {"study": study, **place_fields(group, is_mean=len(group) > 1)}
            own = [pair for pair in pairs if pair[0].study == study]
            yield RowGroup(about, [pair for pair in own if place_of(pair[0]) in group])


def _by_study(runs: Sequence[MeasuredRun], pairs: Pairs) -> Iterator[RowGroup]:
    """Yield the pairs of each study."""
    for study in studies_of(one for one, _ in pairs):
        about = {"study": study, "method": runs[1].label, "run": runs[1].name}
        yield RowGroup(about, [pair for pair in pairs if pair[0].study == study])


def _arrived(pairs: Pairs) -> list[int]:
    """Count the pairs of which both arrived, only the first, only the second, neither."""
    outcomes = Counter((one.success, two.success) for one, two in pairs)
    return [outcomes[one, two] for one in (True, False) for two in (True, False)]


ARRIVED = Fact(
    "arrived",
    "arrived:",
    is_data=False,
    of=lambda pairs: " / ".join(map(str, _arrived(pairs))),
)
COMPARISON = PairedQuestion(
    title="Comparison of two runs",
    name="comparison",
    columns=(
        STUDY,
        *OF_ROUTE,
        replace(EPISODES, role="group"),
        PARTICIPANTS,
        *(
            Fact(name, of=lambda pairs, number=number: _arrived(pairs)[number])
            for number, name in enumerate(("both", "only_a", "only_b", "neither"))
        ),
        replace(ARRIVED, role="group"),
        Column("measure", "Measure", "label", show=lambda row: row["heading"]),
    ),
    groups=_by_route,
    quantities=lambda _: COMPARED_QUANTITIES,
    cell=place_of,
    key=(KEY,),
)
"""Two runs, route by route and measure by measure."""
OVERVIEW = PairedQuestion(
    title="Success of each run (B) beside {label} (A)",
    columns=(STUDY, replace(METHOD, heading="B"), RUN, EPISODES, ARRIVED),
    name="comparison",
    groups=_by_study,
    quantities=lambda _: (SUCCESS,),
    cell=place_of,
    key=(KEY,),
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


def _by_error(runs: Sequence[MeasuredRun], pairs: Pairs) -> Iterator[RowGroup]:
    """Yield the pairs on texts with errors, by kind of error: of all studies, and of each."""
    wrong = [one for one, _ in pairs if one.error_kinds]
    first, second = runs
    if not wrong:
        raise RunFolderError(
            f"{first.name} and {second.name}: expected texts whose errors are labelled, got "
            "none that both have"
        )
    after = {one.episode_id: two for one, two in pairs}
    studies = studies_of(wrong)
    for study in ([ALL] if len(studies) > 1 else []) + studies:
        results = [each for each in wrong if study in (ALL, each.study)]
        for kind, chosen in by_error_kind(results).items():
            about = {"run": second.name, "study": study, "error": kind}
            yield RowGroup(about, [(each, after[each.episode_id]) for each in chosen])


EQUAL_METRES = PairedQuestion(
    title="Texts with errors: success after equally many metres",
    name="equal-metres",
    columns=(
        RUN,
        STUDY_OR_ALL,
        replace(ERROR, role="group"),
        replace(TEXTS, role="group"),
        PARTICIPANTS,
        Column("ways", "times the way", "label", show=lambda row: row["heading"]),
    ),
    groups=_by_error,
    quantities=within_ways,
    key=(METRES_KEY,),
)
"""Two runs on texts with errors, within 1, 1.5, 2 and 3 times the way."""
