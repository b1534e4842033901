"""What a dataset tells of itself: its statistics, and the page beside its files."""

from collections.abc import Sequence
from importlib.metadata import version
from importlib.resources import files
from statistics import fmean
from string import Template

from memorymaze.basics.tables import Column, Row, Table
from memorymaze.texts.corpus.records import WRITTEN_BY
from memorymaze.texts.corpus.statistics import distinct_words, word_count
from memorymaze.texts.datasets.buildings import FinishedBuilding
from memorymaze.texts.datasets.splits import SPLITS

MADE = (
    f"The buildings were made by a program; their texts by {WRITTEN_BY['synthetic']}."
)
COLUMNS = (
    Column("split", "split", "label"),
    Column("buildings", "buildings"),
    Column("routes", "routes"),
    Column("metres", "metres", digits=1),
    Column("turns", "turns", digits=1),
    Column("texts", "texts"),
    Column("wrong", "with errors", digits=3),
    Column("words", "words", digits=1),
    Column("vocabulary", "different words"),
)


def statistics(buildings: Sequence[FinishedBuilding]) -> Table:
    """Return a table of the splits: buildings, routes and texts, with their means."""
    rows = [_row((split,), buildings) for split in SPLITS]
    rows.append({**_row(SPLITS, buildings), "split": "all"})
    return Table(
        "Made buildings with made texts",
        COLUMNS,
        tuple(rows),
        notes=(
            MADE,
            "metres, turns: means of the routes. with errors: share of the texts. words: "
            "mean of the texts. Buildings of val_seen are also in train, with other "
            "routes.",
        ),
        name="dataset",
    )


def _row(splits: Sequence[str], buildings: Sequence[FinishedBuilding]) -> Row:
    routes = [
        (each.site, each.site.find_route(name))
        for each in buildings
        for name, split in each.splits.items()
        if split in splits
    ]
    texts = [
        text for each in buildings for text in each.instructions if text.split in splits
    ]
    return {
        "split": splits[0],
        "buildings": len({site.name for site, _ in routes}),
        "routes": len(routes),
        "metres": fmean(route.length for _, route in routes),
        "turns": fmean(len(route.turns) for _, route in routes),
        "texts": len(texts),
        "wrong": fmean(bool(text.failures) for text in texts),
        "words": fmean(word_count(text.text) for text in texts),
        "vocabulary": distinct_words(text.text for text in texts),
    }


def page(table: Table, command: str) -> bytes:
    """Return the README of a dataset."""
    template = files("memorymaze.texts.datasets") / "dataset_readme.md"
    return (
        Template(template.read_text(encoding="utf-8"))
        .substitute(
            made=MADE,
            version=version("memorymaze"),
            command=command,
            statistics=table.markdown(),
        )
        .encode()
    )
