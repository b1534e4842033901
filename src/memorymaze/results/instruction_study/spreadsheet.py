"""The statistics as CSV: one number per row, unrounded."""

import csv
import io
import math
from collections.abc import Iterator
from dataclasses import asdict

from memorymaze.instructions.published import published_tables
from memorymaze.results.instruction_study.study import InstructionStudy

COLUMNS: tuple[str, ...] = (
    "written_by",
    "table",
    "study",
    "place",
    "route",
    "iteration",
    "key",
    "measure",
    "value",
    "published",
)
"""`key` is what else a number is about: a counting rule, a unit, a number of words."""

Row = dict[str, str | int | float | None]


def study_csv(study: InstructionStudy) -> str:
    """Return the statistics as CSV text, with who wrote the texts in every row."""
    sheet = io.StringIO()
    writer = csv.DictWriter(sheet, COLUMNS, restval="", lineterminator="\n")
    writer.writeheader()
    who = " ".join(study.written)
    rows = (
        row
        for part in (_cells, _vocabularies, _groups, _distances)
        for row in part(study)
    )
    writer.writerows({"written_by": who} | row for row in rows)
    return sheet.getvalue()


def _cells(study: InstructionStudy) -> Iterator[Row]:
    published = {
        (row.study, row.site, row.route, row.iteration): row
        for row in published_tables().descriptions
    }
    about = ("study", "site", "route", "iteration")
    for cell in study.cells:
        values = asdict(cell)
        paper = published.get((cell.study, cell.site, cell.route, cell.iteration))
        for name, value in values.items():
            if name in about or math.isnan(value):
                continue
            yield {
                "table": "table_1",
                "study": cell.study,
                "place": cell.site,
                "route": cell.route,
                "iteration": cell.iteration,
                "measure": name,
                "value": value,
                "published": getattr(paper, name, None),
            }


def _vocabularies(study: InstructionStudy) -> Iterator[Row]:
    for each in study.vocabularies:
        about: Row = {"study": each.study, "place": each.place}
        yield about | {
            "table": "distinct_words",
            "measure": "words",
            "value": each.words,
        }
        for rule, count in each.distinct.items():
            yield about | {
                "table": "distinct_words",
                "key": rule,
                "measure": "distinct_words",
                "value": count,
                "published": each.published,
            }
        curve = each.curve
        for tokens, types in zip(curve.tokens, curve.types, strict=True):
            yield about | {
                "table": "type_token_curve",
                "key": tokens,
                "measure": "distinct_words",
                "value": types,
            }


def _groups(study: InstructionStudy) -> Iterator[Row]:
    for group in study.groups:
        about: Row = {
            "table": "per_text",
            "study": group.study,
            "place": group.site or "all",
            "iteration": group.iteration or "both",
        }
        yield about | {"measure": "texts", "value": group.texts}
        yield about | {"measure": "words", "key": "mean", "value": group.words}
        for name in group.means:
            yield about | {"measure": name, "key": "mean", "value": group.means[name]}
            yield about | {
                "measure": name,
                "key": "share of texts",
                "value": group.shares[name],
            }


def _distances(study: InstructionStudy) -> Iterator[Row]:
    for each in study.distances:
        for name in ("legs", "texts", "median", "low", "high", "factor"):
            yield {
                "table": "stated_distances",
                "study": each.study,
                "key": each.unit,
                "measure": name,
                "value": getattr(each, name),
            }
