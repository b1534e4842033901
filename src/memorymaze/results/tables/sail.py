"""Success on SAIL by map, beside that of the people who followed the same paragraphs."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from memorymaze.errors import SettingsError
from memorymaze.evaluation.results import EpisodeResult
from memorymaze.instructions.sail import DEVELOPMENT, paragraph_of
from memorymaze.metrics.aggregate import participant_bootstrap
from memorymaze.results.tables.measures import estimate_fields, with_interval_notes
from memorymaze.results.tables.runs import MeasuredRun, run_notes
from memorymaze.tables import Column, Row, Table
from memorymaze.wording import counted

STUDY = "sail"
KEY = (
    "success: stopped by itself at the goal's node, mean over start headings; "
    "[95 % interval], bootstrap over paragraphs. people: share of followers who reached "
    "the goal, all trials on the same paragraphs taken together. usable: the corpus "
    "knows a legal path. development half: paragraphs of the writers whose texts were "
    "read while the rules agent was developed."
)


def is_sail(runs: Sequence[MeasuredRun]) -> bool:
    """Tell whether runs are on SAIL."""
    studies = {result.study == STUDY for run in runs for result in run.results}
    if len(studies) > 1:
        raise SettingsError(
            "table: expected runs on SAIL alone or none of them, got both; make a "
            "table of each"
        )
    return studies == {True}


def sail_table(run: MeasuredRun) -> Table:
    """Return success by kind of paragraph and map; the run is on SAIL."""
    metres = run.record.settings.simulation.detection_range
    seen = f"things are detected up to {metres:g} m away"
    table = Table(
        f"SAIL, final position: {run.label}",
        (
            Column("method"),
            Column("paragraphs", "paragraphs", "label"),
            Column("map", "map", "label"),
            Column("texts", "texts"),
            Column("episodes", "episodes"),
            Column("success", "success [95 %]", digits=2, interval=("low", "high")),
            Column("followers"),
            Column("people", "people", show=_people),
        ),
        tuple(_rows(run)),
        ("\n".join([*run_notes(run), seen]), KEY),
        "sail",
    )
    return with_interval_notes(table)


def _people(row: Row) -> str:
    share = row["people"]
    trials = counted(row["followers"], "trial")
    return "-" if share is None else f"{share:.2f} ({trials})"


def _rows(run: MeasuredRun) -> list[Row]:
    kinds = {
        "all": run.results,
        "usable": [r for r in run.results if r.followers and r.followers.usable],
        "development half": [r for r in run.results if r.split == DEVELOPMENT],
        "other half": [r for r in run.results if r.split != DEVELOPMENT],
    }
    rows: list[Row] = []
    for kind, results in kinds.items():
        maps = sorted({result.site for result in results})
        for site in [*maps, None] if len(maps) > 1 else maps:
            rows.append({
                "method": run.label,
                "paragraphs": kind,
                "map": "all" if site is None else site.removeprefix("sail_").title(),
                **_figures([r for r in results if site is None or r.site == site]),
            })
    return rows


def _figures(results: Sequence[EpisodeResult]) -> dict[str, Any]:
    texts = [paragraph_of(result.episode_id) for result in results]
    by_text = dict(zip(texts, results, strict=True))
    # Every paragraph counts the same, however many of its headings have been run.
    (success,) = participant_bootstrap(
        [
            [np.mean([r.success for r in results if r.instruction_id == text])]
            for text in by_text
        ],
        list(by_text),
        np.random.default_rng(0),
    )
    people = [r.followers for r in by_text.values() if r.followers is not None]
    tried = sum(each.tried or 0 for each in people)
    arrived = sum(each.arrived or 0 for each in people)
    return {
        "texts": len(by_text),
        "episodes": len(results),
        **estimate_fields("success", success, ("low", "high")),
        "followers": tried,
        "people": arrived / tried if tried else None,
    }
