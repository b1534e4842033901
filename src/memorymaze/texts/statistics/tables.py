"""The figures as tables, the same for a terminal and for a page, and as CSV."""

from dataclasses import asdict

from memorymaze.basics.tables import Column, Row, Table
from memorymaze.texts.corpus.statistics import COUNTING_RULES
from memorymaze.texts.statistics.named_things import SORTS
from memorymaze.texts.statistics.study import (
    ALL_SITES,
    InstructionStudy,
)

STUDIES = {
    "online": "online (typed while watching)",
    "onsite": "onsite (spoken from memory)",
}
THINGS = {
    "landmarks": "landmarks",
    "doors": "doors",
    "rooms": "rooms",
    "ways": "hallways",
    "floors": "floors",
    "unknown_things": "not in the plan",
}
"""Headings of things named, by measure."""
SPEECH = ("hedges", "fillers", "corrections")
TABLE_ONE_KEY = (
    "RL length of the reference route; mean, median and SD of words per text; FR share of "
    "texts with a significant error; AR share that describes another way. Published "
    "figures in brackets; (-) where the paper has none."
)
SPEECH_KEY = (
    "Per text, per 100 words (/100), and share of texts with at least one. Counted by lists of "
    "English phrases (docs/runs.md); corrections include words said twice over or "
    "broken off."
)
THINGS_KEY = (
    "Each phrase that the parser takes for a thing, once per text, by what of the site "
    f"plan it fits best ({'; '.join(f'{sort}: {says}' for sort, says in SORTS.items())}). "
    "Words that the parser misreads end up as not in the plan."
)
LENGTHS_KEY = "Distances: legs whose length is stated in metres, steps or time."
DISTANCES_KEY = (
    "Legs of texts without errors whose turns, as parsed, are in order those of the route "
    "described; [quartiles]. A step counts as 0.7 m, a second as 1 m. Vague: words such "
    'as "directly" or "a few metres", for which the parser takes a fixed length. Numbers: '
    "all but these. Spread: exponential of the standard deviation of the ratios' "
    "logarithms, lengths misread by the parser included."
)


def study_text(study: InstructionStudy) -> str:
    """Write all tables, saying first who wrote the texts."""
    tables = (table.text() for table in study_tables(study))
    return "\n".join([*study.written, "", *tables])


def study_csv(study: InstructionStudy) -> str:
    """Write the figures as CSV, with who wrote the texts in every row."""
    who = {"written_by": " ".join(study.written)}
    names = ["table", "study", "place", "route", "iteration", "key", "measure"]
    return Table(
        "Figures",
        tuple(Column(name) for name in ("written_by", *names, "value", "published")),
        tuple(who | asdict(each) for each in study.figures),
    ).csv()


def title_of_place(place: str) -> str:
    """Return the title of a site or building.

    >>> title_of_place("museum_5f")
    'Museum 5F'
    """
    return place.replace("_", " ").title()


def study_tables(study: InstructionStudy) -> list[Table]:
    """Return all tables, in the order in which they are shown."""
    tables = [_table_one(study)]
    if study.curves:
        tables.append(_vocabularies(study))
    if any(_compared(study)):
        tables.append(_rules(study))
    tables += [_speech(study), _things(study)]
    if any(text.distances for text in study.texts):
        tables.append(_distances(study))
    return tables


def _table_one(study: InstructionStudy) -> Table:
    about = ("study", "place", "route", "iteration")
    return Table(
        "Table I",
        (
            Column("study", "Study", "group", show=_study_title),
            Column("place", "route", "label", show=_route_title),
            Column("iteration", "iter.", "label"),
            Column("instructions", "n"),
            _beside_paper("route_length", "RL m", 2),
            _beside_paper("words_mean", "mean", 1),
            _beside_paper("words_median", "median", 1),
            _beside_paper("words_sd", "SD", 1),
            _beside_paper("failure_rate", "FR %", 1, scale=100),
            _beside_paper("alternative_rate", "AR %", 1, scale=100),
        ),
        tuple(study.rows("table_1", *about)),
        (TABLE_ONE_KEY,),
        "table-i",
    )


def _study_title(row: Row) -> str:
    return STUDIES.get(row["study"], str(row["study"]))


def _route_title(row: Row) -> str:
    return f"{title_of_place(row['place'])} {row['route']}"


def _beside_paper(field: str, heading: str, digits: int, *, scale: float = 1) -> Column:
    """Return a column of figures, with the paper's in brackets where it has the row."""

    def written(value: float | None) -> str:
        return "-" if value is None else f"{scale * value:.{digits}f}"

    def show(row: Row) -> str:
        is_in_paper = row.get("words_mean published") is not None
        known = f" ({written(row.get(f'{field} published'))})" if is_in_paper else ""
        return written(row.get(field)) + known

    return Column(field, heading, show=show)


def _scaled(field: str, heading: str, scale: float = 1) -> Column:
    return Column(field, heading, show=lambda row: f"{scale * row[field]:.0f}")


def _vocabularies(study: InstructionStudy) -> Table:
    equal = study.equal_words
    rule = COUNTING_RULES[0]

    def distinct(row: Row) -> str:
        known = row[f"distinct_words {rule.name} published"]
        count = row[f"distinct_words {rule.name}"]
        return f"{count} ({known})" if known else str(count)

    rows = study.rows("distinct_words", "place", "study")
    return Table(
        "Distinct words",
        (
            Column(
                "place", "place", "label", show=lambda r: title_of_place(r["place"])
            ),
            Column("study", "study", "label"),
            Column("texts", "texts"),
            Column("words", "words"),
            Column("distinct", "distinct", show=distinct),
            _scaled("distinct_words among equally many words", f"among {equal} words"),
        ),
        tuple(sorted(rows, key=lambda row: (row["place"], row["study"]))),
        (
            f"Words here are {rule.says}. Published counts in brackets; the paper does "
            "not state its rule.",
            "The last column compares equal amounts of text: distinct words among the "
            f"first {equal}, mean over 20 orders of the texts (type-token curve).",
        ),
        "distinct-words",
    )


def _compared(study: InstructionStudy) -> list[tuple[str, str]]:
    """Return the places and studies whose distinct words the paper counts too."""
    return sorted({
        (each.place, each.study)
        for each in study.figures
        if each.table == "distinct_words" and each.published
    })


def _rules(study: InstructionStudy) -> Table:
    """Return published counts beside those by every rule; some place has them."""
    compared = _compared(study)
    counts = {
        (str(each.key), each.place, each.study): (int(each.value), each.published)
        for each in study.figures
        if each.table == "distinct_words" and each.published
    }
    rows: list[Row] = []
    misses: dict[str, float] = {}
    for rule in COUNTING_RULES:
        found = {about: counts[rule.name, *about] for about in compared}
        offs = [abs(count / known - 1) for count, known in found.values() if known]
        misses[rule.name] = sum(offs) / len(offs)
        row = {f"{place} {study}": n for (place, study), (n, _) in found.items()}
        rows.append({"rule": rule.name, **row, "off": 100 * misses[rule.name]})
    first = COUNTING_RULES[0].name
    rows.append({
        "rule": "published",
        **{f"{p} {s}": counts[first, p, s][1] for p, s in compared},
    })
    miss, near = min((miss, name) for name, miss in misses.items())
    both = {place for place, name in compared if name == "online"}
    both &= {place for place, name in compared if name == "onsite"}
    more = [
        rule.name
        for rule in COUNTING_RULES
        if all(
            counts[rule.name, place, "onsite"] > counts[rule.name, place, "online"]
            for place in both
        )
    ]
    order = f"are by: {', '.join(more)}" if more else "are not, by any of these rules"
    onsite_over_online = (
        f"The published counts are higher onsite than online; here they {order}.",
    )
    return Table(
        "Distinct words by the usual counting rules",
        (
            Column("rule", "rule", "label"),
            *(Column(f"{p} {s}", f"{title_of_place(p)} {s}") for p, s in compared),
            Column("off", "off by %", digits=0),
        ),
        tuple(rows),
        (
            f'On these texts the rule nearest to the published counts is "{near}", off by '
            f"{100 * miss:.0f} % on average. These are other texts than the paper's, so "
            "this does not show which rule the paper used.",
            *(onsite_over_online if both else ()),
            *(f"{rule.name}: {rule.says}." for rule in COUNTING_RULES),
        ),
        "counting-rules",
    )


def _speech(study: InstructionStudy) -> Table:
    short = {name: name.replace("corrections", "corr.") for name in SPEECH}
    return Table(
        "Hedges, fillers and corrections",
        (
            *WHO,
            *(Column(f"{name} mean", name, digits=2) for name in SPEECH),
            *(
                Column(f"{name} per 100 words", f"{short[name]}/100", digits=2)
                for name in SPEECH
            ),
            *(
                _scaled(f"{name} share of texts", f"{short[name]} %", 100)
                for name in SPEECH
            ),
        ),
        _all_sites(study),
        (SPEECH_KEY,),
        "speech",
    )


def _things(study: InstructionStudy) -> Table:
    names = {**THINGS, "distances": "distances"}
    return Table(
        "Things named and distances stated, per text",
        (
            *WHO,
            *(Column(f"{name} mean", says, digits=2) for name, says in names.items()),
        ),
        _all_sites(study),
        (THINGS_KEY, LENGTHS_KEY),
        "things",
    )


WHO = (
    Column("study", "study", "label"),
    Column("iteration", "iter.", "label"),
    Column("texts", "n"),
)


def _all_sites(study: InstructionStudy) -> tuple[Row, ...]:
    return tuple(study.rows("per_text", "study", "iteration", place=ALL_SITES))


def _quartiles(row: Row) -> str:
    # These are no interval that something is uncertain within.
    return f"{row['median']:.2f} [{row['low']:.2f}, {row['high']:.2f}]"


def _distances(study: InstructionStudy) -> Table:
    return Table(
        "Stated distances over true ones",
        (
            Column("study", "study", "label"),
            Column("key", "unit", "label"),
            Column("legs", "legs"),
            Column("texts", "texts"),
            Column(
                "median",
                "median [quartiles]",
                interval=("low", "high"),
                show=_quartiles,
            ),
            Column("factor", "spread factor", digits=2),
        ),
        tuple(study.rows("stated_distances", "study", "key")),
        (DISTANCES_KEY,),
        "stated-distances",
    )
