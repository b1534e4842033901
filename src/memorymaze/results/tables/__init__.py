"""The paper's Tables II and III from runs, comparisons of runs, and their formats."""

from memorymaze.results.tables.rows import (
    MeasuredRun,
    Place,
    TableName,
    TableRow,
    load_runs,
    place_title,
    places_of,
    table_rows,
)

__all__ = [
    "MeasuredRun",
    "Place",
    "TableName",
    "TableRow",
    "load_runs",
    "place_title",
    "places_of",
    "table_rows",
]
