"""Tables as data: one record per row, numbers unrounded, as CSV or Parquet."""

import csv
import io
from collections.abc import Sequence
from typing import Any

from memorymaze.evaluation.collision_rates import PER_DISTANCE, collision_rates
from memorymaze.extras import require_extra
from memorymaze.results.tables.bootstrap import MEASURES
from memorymaze.results.tables.inference_cost import (
    COST_COLUMNS,
    any_inference,
    inference_cost,
)
from memorymaze.results.tables.rows import (
    MeasuredRun,
    TableName,
    TableRow,
    table_rows,
)


def table_records(
    runs: Sequence[MeasuredRun], tables: Sequence[TableName]
) -> list[dict[str, Any]]:
    """Return the rows of tables as records; what a row has not is None.

    The fields are those of `columns(runs)`; see `docs/data_formats.md`.
    """
    names = columns(runs)
    costs = any_inference(runs)
    records = [
        _record(row, table, costs=costs)
        for table in tables
        for row in table_rows(runs, table)
    ]
    return [{name: record.get(name) for name in names} for record in records]


def columns(runs: Sequence[MeasuredRun]) -> list[str]:
    """Return the names of the fields of records, in order."""
    names = ["table", "study", "site", "route", "iteration", "method", "parser"]
    names += ["figures", "run", "episodes", "participants"]
    for name in MEASURES:
        names += [name, f"{name}_low", f"{name}_high"]
    names += ["instructions_written_by", "episodes_missing", "seed"]
    names += ["success_distance_m", "time_budget_s", "call_budget"]
    names += ["turning_points", "detector", "signs", "track"]
    names += ["things_per_100m", "people_per_100m2", "people", "obstacle_seed"]
    names += [f"{name}_per_100m" for name in PER_DISTANCE] + ["waiting_s_per_episode"]
    names += [f"{name}_per_episode" for name in COST_COLUMNS if any_inference(runs)]
    return names


def csv_tables(runs: Sequence[MeasuredRun], tables: Sequence[TableName]) -> str:
    """Write tables as one CSV."""
    out = io.StringIO()
    writer = csv.DictWriter(out, columns(runs), lineterminator="\n")
    writer.writeheader()
    writer.writerows(table_records(runs, tables))
    return out.getvalue()


def parquet_tables(runs: Sequence[MeasuredRun], tables: Sequence[TableName]) -> bytes:
    """Write tables as one Parquet file.

    Raises:
        SettingsError: pyarrow is not installed.
    """
    require_extra("tables", "pyarrow", purpose="Parquet")
    import pyarrow
    import pyarrow.parquet

    out = io.BytesIO()
    content = pyarrow.Table.from_pylist(table_records(runs, tables))
    pyarrow.parquet.write_table(content, out)
    return out.getvalue()


def _record(row: TableRow, table: TableName, *, costs: bool) -> dict[str, Any]:
    record: dict[str, Any] = {
        "table": table,
        "study": row.study,
        "site": "mean" if row.is_mean else row.places[0].site,
        "route": "mean" if row.is_mean else row.places[0].route,
        "iteration": row.iteration,
        "method": row.method,
        "parser": row.parser,
        "figures": "published" if row.run is None else "measured",
        "episodes": row.episodes,
        "participants": row.participants,
        "instructions_written_by": "human",
    }
    for name in MEASURES:
        estimate = row.values[name]
        record[name] = estimate.mean
        record[f"{name}_low"], record[f"{name}_high"] = estimate.low, estimate.high
    if row.run is not None:
        record |= _of_run(row, row.run)
        if costs:
            cost = inference_cost(row)
            record |= {
                f"{name}_per_episode": getattr(cost, name) for name in COST_COLUMNS
            }
    return record


def _of_run(row: TableRow, run: MeasuredRun) -> dict[str, Any]:
    settings = run.record.settings
    record: dict[str, Any] = {
        "run": run.name,
        "instructions_written_by": "+".join(
            sorted({result.source for result in run.results})
        ),
        "episodes_missing": run.missing,
        "seed": settings.seed,
        "success_distance_m": settings.success_distance,
        "time_budget_s": settings.simulation.time_budget,
        "call_budget": settings.simulation.call_budget,
        "turning_points": settings.simulation.turning_points,
        "detector": str(settings.detector),
        "signs": settings.signs,
        "track": "default" if settings.obstacles is None else "obstacles",
    }
    if settings.obstacles is not None:
        found = collision_rates(row.results)
        record |= {
            "things_per_100m": settings.obstacles.things_per_100m,
            "people_per_100m2": settings.obstacles.people_per_100m2,
            "people": settings.obstacles.people,
            "obstacle_seed": settings.obstacles.seed,
            "waiting_s_per_episode": found.waiting_s,
        }
        record |= {f"{name}_per_100m": getattr(found, name) for name in PER_DISTANCE}
    return record
