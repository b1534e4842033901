"""Tables II and III as aligned text, Markdown and CSV."""

import csv
import io
import textwrap
from collections import Counter
from collections.abc import Iterable, Sequence
from itertools import groupby
from typing import Literal

from memorymaze.evaluation.bootstrap import MEASURES, Estimate
from memorymaze.evaluation.eyes_for_runs import eyes_notes
from memorymaze.evaluation.inference_cost import (
    COST_COLUMNS,
    COST_KEY,
    any_inference,
    cost_cells,
    cost_notes,
    inference_cost,
)
from memorymaze.evaluation.results import EpisodeResult
from memorymaze.evaluation.safety import PER_DISTANCE, safety
from memorymaze.evaluation.tables import (
    MeasuredRun,
    TableName,
    TableRow,
    table_rows,
)
from memorymaze.instructions.records import WRITTEN_BY
from memorymaze.simulation.obstacles import ObstacleSettings

__all__ = ["TableFormat", "format_tables"]

TableFormat = Literal["text", "md", "csv"]

TEXT_WIDTH = 118

TITLES = {
    "II": "Table II: methods on every route, both iterations together",
    "III": "Table III: first and second iteration on every route",
}

STUDY_TITLES = {
    "online": "Online instructions (thinking out loud)",
    "onsite": "Onsite instructions (from memory)",
}

HEADINGS = {"sr": "SR", "osr": "OSR", "spd": "SPD (m)", "cls": "CLS"}

KEY = (
    "SR success rate, OSR oracle success rate, SPD shortest walk left to the goal, CLS "
    "coverage\nweighted by length; [95 % interval], bootstrap over participants. The "
    'mean over routes is\nunweighted. Rows that begin with "paper" are published '
    "figures on human instructions."
)


def format_tables(
    runs: Sequence[MeasuredRun], tables: Sequence[TableName], style: TableFormat
) -> str:
    """Write tables, with all that one must know to read them.

    Args:
        runs: From `load_runs`; at least one.
        tables: Which of the paper's tables.
        style: Text of at most 118 columns, Markdown, or one CSV with unrounded numbers.
    """
    if style == "csv":
        found: list[tuple[TableRow, TableName]] = []
        for table in tables:
            found.extend((row, table) for row in table_rows(runs, table))
        return _csv(found, costs=any_inference(runs))
    write = _text if style == "text" else _markdown
    return "\n".join(write(table_rows(runs, table), runs, table) for table in tables)


def run_notes(run: MeasuredRun) -> list[str]:
    """Say how a run came about: settings, budgets, who wrote the instructions."""
    settings = run.record.settings
    counts = Counter(result.source for result in run.results)
    written = "; ".join(
        f"{count} written by {WRITTEN_BY[source]}" for source, count in counts.items()
    )
    files = ", ".join(stamp.name for stamp in settings.instructions)
    notes = [
        f"{run.label}: run {run.name}, {len(run.results)} episodes; instructions "
        f"({files}): {written}.",
        f"success distance {settings.success_distance:g} m, time budget "
        f"{settings.simulation.time_budget:g} s, call budget "
        f"{settings.simulation.call_budget}, seed {settings.seed}, memorymaze "
        f"{_code(run)}",
    ]
    if settings.simulation.turning_points == "lidar":
        notes.append(
            "TURNING POINTS BY LIDAR (scans and odometry), not from the site plan."
        )
    notes += eyes_notes(settings)
    if settings.obstacles is not None:
        notes += _obstacle_notes(settings.obstacles, run.results)
    if settings.agent.model is not None:
        notes.append(f"language model {settings.agent.model}")
    notes += cost_notes(run)
    if run.left_out:
        notes.append(f"{run.left_out} episodes on development texts are left out.")
    development = sum(each.split == "dev" for each in run.results)
    if development:
        notes.append(
            f"{development} episodes on development texts (split dev) are counted; "
            "--exclude-dev leaves them out."
        )
    if settings.limit is not None:
        notes.append(f"A SAMPLE of {settings.episodes} episodes (--limit).")
    if run.missing:
        notes.append(
            f"INCOMPLETE: {run.missing} of {settings.episodes} episodes are missing; "
            "finish the run with --resume."
        )
    return notes


def _obstacle_notes(
    obstacles: ObstacleSettings, results: Sequence[EpisodeResult]
) -> list[str]:
    """Say that a run is of the obstacle track, and how safely the robot drove."""
    crowd = f"{obstacles.people_per_100m2:g} people per 100 m2"
    if obstacles.people is not None:
        crowd = f"{obstacles.people} people"
    found = safety(results)
    return [
        "TRACK WITH OBSTACLES AND PEOPLE, not comparable with runs without: "
        f"{obstacles.things_per_100m:g} things per 100 m, {crowd}, obstacle seed "
        f"{obstacles.seed}.",
        f"per 100 m driven: {found.collisions:.3f} collisions, "
        f"{found.person_collisions:.3f} of them with people, {found.near_misses:.2f} "
        f"near misses; waiting {found.waiting_s:.1f} s per episode.",
    ]


def _code(run: MeasuredRun) -> str:
    code = run.record.code
    if code.commit is None:
        return code.version
    edited = "+" if code.commit.endswith("+") else ""
    return f"{code.version} ({code.commit[:12]}{edited})"


def _text(
    rows: Sequence[TableRow], runs: Sequence[MeasuredRun], table: TableName
) -> str:
    lines = [TITLES[table], ""]
    for run in runs:
        first, *others = run_notes(run)
        for note in (first, *(f"  {note}" for note in others)):
            lines += textwrap.wrap(note, TEXT_WIDTH, subsequent_indent="  ")
    lines += ["", KEY]
    width = max(24, *(len(row.method) + 2 for row in rows))
    for study, of_study in groupby(rows, lambda row: row.study):
        heading = _line("", "parser", "n", [HEADINGS[name] for name in MEASURES], width)
        lines += ["", STUDY_TITLES[study], heading, "-" * len(heading)]
        for title, group in groupby(of_study, _group_title):
            lines.append(title)
            lines += [
                _line(
                    "  " + row.method,
                    _parser(row),
                    _count(row),
                    [_shown(row.values[name]) for name in MEASURES],
                    width,
                )
                for row in group
            ]
    if any_inference(runs):
        lines += _inference_text(rows, width)
    return "\n".join(line.rstrip() for line in lines) + "\n"


def _inference_text(rows: Sequence[TableRow], width: int) -> list[str]:
    """Return the lines on what inference cost; the columns above leave no room."""
    lines = ["", "What inference costs", *COST_KEY.split("\n")]
    widths = [17, *(max(8, len(name)) for name in COST_COLUMNS.values())]
    names = [HEADINGS["sr"], *COST_COLUMNS.values()]
    measured = [row for row in rows if row.run is not None]
    for study, of_study in groupby(measured, lambda row: row.study):
        heading = _line("", "parser", "n", names, width, widths)
        lines += ["", STUDY_TITLES[study], heading, "-" * len(heading)]
        for title, group in groupby(of_study, _group_title):
            lines.append(title)
            lines += [
                _line(
                    "  " + row.method,
                    _parser(row),
                    _count(row),
                    [_shown(row.values["sr"]), *cost_cells(row)],
                    width,
                    widths,
                )
                for row in group
            ]
    return lines


def _line(
    method: str,
    parser: str,
    count: str,
    values: Sequence[str],
    width: int,
    widths: Sequence[int] = (17, 17, 23, 17),
) -> str:
    columns = "".join(
        f"  {value:<{wide}}" for value, wide in zip(values, widths, strict=True)
    )
    return f"{method:<{width}} {parser:<6} {count:>4}{columns}"


def _markdown(
    rows: Sequence[TableRow], runs: Sequence[MeasuredRun], table: TableName
) -> str:
    lines = [f"### {TITLES[table]}", ""]
    for run in runs:
        first, *others = run_notes(run)
        lines += [f"- {_escaped(first)}", *(f"  {_escaped(note)}" for note in others)]
    costs = any_inference(runs)
    lines += ["", KEY.replace("\n", " ")]
    if costs:
        lines += ["", COST_KEY.replace("\n", " ")]
    columns = ["Study", "Route", "Method", "Parser", "n"]
    measured = [HEADINGS[name] for name in MEASURES]
    measured += COST_COLUMNS.values() if costs else ()
    lines += ["", "| " + " | ".join(columns + measured) + " |"]
    lines.append("|---|---|---|---|---:|" + "---:|" * len(measured))
    for row in rows:
        cells = [row.study, _group_title(row), row.method, _parser(row), _count(row)]
        cells += [_shown(row.values[name]) for name in MEASURES]
        cells += cost_cells(row) if costs else ()
        lines.append("| " + " | ".join(_escaped(cell) for cell in cells) + " |")
    return "\n".join(lines) + "\n"


def _csv(rows: Iterable[tuple[TableRow, TableName]], *, costs: bool) -> str:
    columns = ["table", "study", "site", "route", "iteration", "method", "parser"]
    columns += ["figures", "run", "episodes", "participants"]
    for name in MEASURES:
        columns += [name, f"{name}_low", f"{name}_high"]
    columns += ["instructions_written_by", "episodes_missing", "seed"]
    columns += ["success_distance_m", "time_budget_s", "call_budget"]
    columns += ["turning_points", "detector", "signs", "track"]
    columns += ["things_per_100m", "people_per_100m2", "people", "obstacle_seed"]
    columns += [f"{name}_per_100m" for name in PER_DISTANCE] + ["waiting_s_per_episode"]
    columns += [f"{name}_per_episode" for name in COST_COLUMNS] if costs else []
    out = io.StringIO()
    writer = csv.DictWriter(out, columns, lineterminator="\n")
    writer.writeheader()
    for row, table in rows:
        line: dict[str, object] = {
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
            line[name] = estimate.mean
            line[f"{name}_low"], line[f"{name}_high"] = estimate.low, estimate.high
        if row.run is not None:
            settings = row.run.record.settings
            line |= {
                "run": row.run.name,
                "instructions_written_by": "+".join(
                    sorted({result.source for result in row.run.results})
                ),
                "episodes_missing": row.run.missing,
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
                found = safety(row.results)
                line |= {
                    "things_per_100m": settings.obstacles.things_per_100m,
                    "people_per_100m2": settings.obstacles.people_per_100m2,
                    "people": settings.obstacles.people,
                    "obstacle_seed": settings.obstacles.seed,
                    "waiting_s_per_episode": found.waiting_s,
                }
                line |= {
                    f"{name}_per_100m": getattr(found, name) for name in PER_DISTANCE
                }
            if costs:
                cost = inference_cost(row)
                line |= {
                    f"{name}_per_episode": getattr(cost, name) for name in COST_COLUMNS
                }
        writer.writerow(line)
    return out.getvalue()


def _group_title(row: TableRow) -> str:
    if row.is_mean:
        title = f"Mean over {len(row.places)} routes"
    else:
        site, route = row.places[0]
        title = f"{site.replace('_', ' ').title()} {route}"
    return title if row.iteration is None else f"{title}, iteration {row.iteration}"


def _parser(row: TableRow) -> str:
    return "-" if row.parser is None else "yes" if row.parser else "no"


def _count(row: TableRow) -> str:
    return "" if row.episodes is None else str(row.episodes)


def _shown(estimate: Estimate) -> str:
    if estimate.low is None or estimate.high is None:
        return f"{estimate.mean:.2f}"
    return f"{estimate.mean:.2f} [{estimate.low:.2f}, {estimate.high:.2f}]"


def _escaped(text: str) -> str:
    return text.replace("|", "\\|")
