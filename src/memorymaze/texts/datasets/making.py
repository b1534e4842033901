"""Make a dataset: plans, texts and, if wanted, frames, in a folder that is new or whole."""

import json
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from typing import Any

from memorymaze.basics.durable_files import check_new_folder, new_folder, write_whole
from memorymaze.basics.errors import SettingsError
from memorymaze.basics.extras import require_extra
from memorymaze.basics.options import check_whole
from memorymaze.basics.tables import Table
from memorymaze.texts.corpus.files import write_instructions
from memorymaze.texts.datasets.buildings import (
    BuildingTask,
    FinishedBuilding,
    finish_building,
)
from memorymaze.texts.datasets.description import page, statistics
from memorymaze.texts.datasets.splits import FEWEST, SEEDS_APART, SPLITS, plan_buildings
from memorymaze.texts.datasets.workers import done_by_processes
from memorymaze.texts.exchange.vln_ce import STEP, TURN, write_vln_ce
from memorymaze.texts.writing import parse_rates

MARK = "dataset.json"
"""The file by which a folder is known as a dataset."""
SMALLEST, LARGEST = 64, 1920
"""Pixels of a frame's sides."""

_Progress = Callable[[int, int, str], None]


@dataclass(frozen=True, slots=True)
class DatasetRequest:
    """All that determines a dataset, besides the code.

    Raises:
        SettingsError: A value has no meaning.
    """

    buildings: int = 100
    """Kinds take turns."""
    per_route: int = 8
    """Texts of each route, shared evenly between typed and spoken ones."""
    errors: str = "published"
    """As `parse_rates` reads them."""
    seed: int = 0
    frame_size: tuple[int, int] | None = None
    """Width and height of frames, pixels; None for a dataset without frames."""

    def __post_init__(self) -> None:
        """Refuse values without meaning."""
        check_whole("--buildings", self.buildings, least=FEWEST)
        check_whole("--per-route", self.per_route, least=1)
        check_whole("--seed", self.seed, least=0)
        parse_rates(self.errors)
        if self.buildings > SEEDS_APART:
            raise SettingsError(
                f"--buildings: expected at most {SEEDS_APART}, got {self.buildings}"
            )
        for side in self.frame_size or ():
            if side % 2 or not SMALLEST <= side <= LARGEST:
                raise SettingsError(
                    f"--frame-size: expected even numbers from {SMALLEST} to {LARGEST}, "
                    f"got {side}"
                )

    @property
    def command(self) -> str:
        """The command that makes it."""
        frames = ""
        if self.frame_size is not None:
            width, height = self.frame_size
            frames = f" --frames --frame-size {width}x{height}"
        return (
            f"memorymaze dataset make --buildings {self.buildings} --per-route "
            f"{self.per_route} --errors {self.errors} --seed {self.seed}{frames} --out DIR"
        )


def check_dataset_folder(folder: str | Path, *, overwrite: bool = False) -> None:
    """Refuse a place for a dataset before anything is made for it.

    Raises:
        SettingsError: It holds something else.
    """
    check_new_folder(folder, replaces=MARK if overwrite else None)


def make_dataset(
    request: DatasetRequest,
    folder: str | Path,
    *,
    overwrite: bool = False,
    workers: int = 0,
    progress: _Progress | None = None,
) -> Table:
    """Make a dataset; the folder is there when it is whole, or as it was before.

    Args:
        request: What is wanted.
        folder: Made; must not hold anything yet.
        overwrite: Whether a dataset that is there is replaced.
        workers: Processes; 0 for one per core.
        progress: Told how many buildings of how many are done, and what is being done.

    Returns:
        Its statistics.

    Raises:
        SettingsError: The folder holds something else, or cannot be made; or frames
            are wanted without the extras `tables` and `video`.
        RenderingError: This machine cannot draw the frames; says what to install.
        MemoryMazeError: A building or a walk cannot be made.
    """
    if request.frame_size is not None:
        require_extra("tables,video", "av", "pandas", "pyarrow", purpose="--frames")
    with new_folder(folder, replaces=MARK if overwrite else None) as unfinished:
        buildings = _buildings(request, unfinished, workers, progress)
        texts = [text for each in buildings for text in each.instructions]
        for split in SPLITS:
            members = [text for text in texts if text.split == split]
            write_instructions(unfinished / f"{split}.jsonl", members)
        sites = {each.site.name: each.site for each in buildings}
        write_vln_ce(unfinished / "vln_ce", texts, sites)
        if request.frame_size is not None:
            # Most datasets have no frames, and need neither video nor table libraries.
            from memorymaze.texts.datasets.lerobot import write_frames

            for split in SPLITS:
                write_frames(
                    unfinished / "frames" / split,
                    split,
                    buildings,
                    request.frame_size,
                    workers,
                    progress,
                )
        table = statistics(buildings)
        write_whole(unfinished / "statistics.csv", table.csv().encode())
        write_whole(unfinished / "README.md", page(table, request.command))
        record = json.dumps(_record(request, buildings), indent=2) + "\n"
        write_whole(unfinished / MARK, record.encode())
    return table


def _buildings(
    request: DatasetRequest, folder: Path, workers: int, progress: _Progress | None
) -> list[FinishedBuilding]:
    (folder / "sites").mkdir()
    tasks = [
        BuildingTask(
            planned,
            folder / "sites",
            request.per_route,
            parse_rates(request.errors),
            request.seed,
            walked=request.frame_size is not None,
        )
        for planned in plan_buildings(request.buildings, request.seed)
    ]
    finished: list[FinishedBuilding] = []
    for each in done_by_processes(finish_building, tasks, workers):
        finished.append(each)
        if progress is not None:
            progress(len(finished), len(tasks), "buildings and texts")
    return finished


def _record(
    request: DatasetRequest, buildings: Sequence[FinishedBuilding]
) -> dict[str, Any]:
    """Return what `dataset.json` holds."""
    return {
        "generator": f"memorymaze {version('memorymaze')}",
        "source": "synthetic",
        "buildings": request.buildings,
        "per_route": request.per_route,
        "errors": request.errors,
        "seed": request.seed,
        "step_m": STEP,
        "turn_deg": round(math.degrees(TURN)),
        "sites": [
            {
                "site": each.site.name,
                "kind": each.planned.kind,
                "seed": each.planned.seed,
                "split": each.planned.split,
                "routes": each.splits,
            }
            for each in buildings
        ],
    }
