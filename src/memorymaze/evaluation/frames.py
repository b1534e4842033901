"""Runs as pandas data frames, for analyses of one's own.

from memorymaze.evaluation.frames import episode_frame

frame = episode_frame(["runs/rules", "runs/mine"])
frame.groupby(["run", "study", "route"]).success.mean()
"""

from collections.abc import Iterable, Sequence
from dataclasses import asdict, fields
from pathlib import Path
from typing import TYPE_CHECKING

from memorymaze.evaluation.results import EpisodeResult
from memorymaze.evaluation.run_folder import read_run

if TYPE_CHECKING:
    import pandas


def episode_frame(folders: Sequence[str | Path]) -> "pandas.DataFrame":
    """Return one row per episode of some runs.

    Columns are `run` (name of the folder) and the fields of `EpisodeResult`, in that
    order; see `docs/data_formats.md`. Rows are in the order of the folders, and within
    a run in that of episode ids. A run that is still going on gives what it has.
    """
    return results_frame(
        (Path(folder).resolve().name, read_run(folder)[1]) for folder in folders
    )


def results_frame(
    runs: Iterable[tuple[str, Sequence[EpisodeResult]]],
) -> "pandas.DataFrame":
    """Return one row per result of some runs, which have these names."""
    import pandas

    rows = [
        {"run": name, **asdict(result)} for name, results in runs for result in results
    ]
    columns = ["run", *(field.name for field in fields(EpisodeResult))]
    return pandas.DataFrame(rows, columns=columns)
