"""Draw two walks of the guide: an error that it notices and repairs, and one that it cannot.

python scripts/guide_walks.py --out docs/images

Prints what the numbers in the pictures are, for docs/lab/guide.md. The plans are those that a
large language model read in the texts (recorded).
"""

import argparse
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from memorymaze.language.models.model_settings import ModelSettings
from memorymaze.runs.episodes.plan import plan_run
from memorymaze.runs.episodes.settings import AgentSettings
from memorymaze.runs.episodes.trace import read_trace
from memorymaze.runs.episodes.trace_entries import (
    EndEntry,
    NoteEntry,
    TraceEntry,
    TrajectoryEntry,
)
from memorymaze.runs.work.driver import run_plan
from memorymaze.texts.corpus import load_corpus
from memorymaze.world.drawing.plan_picture import draw_plan

WALKS = {
    "guide_repaired": "onl-museum_7f-r1-11-2",
    "guide_not_repaired": "ons-museum_7f-r2-21-1",
}
PLANS = Path(__file__).parents[1] / "examples/recorded/plans.jsonl"
SIZE = (1100, 760)
WALK, MARK = (30, 60, 160), (200, 30, 30)
RADIUS = 11
"""Pixels of a numbered mark."""
TOLD = {"doubt", "repair", "arrival", "gave_up"}


def main() -> None:
    """Walk both texts and draw the walks into a folder."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=Path("docs/images"))
    folder = parser.parse_args().out
    corpus = load_corpus()
    chosen = {e.id: e for e in corpus.episodes if e.id in WALKS.values()}
    guide = AgentSettings(
        "guide",
        options=(("reader", "model"),),
        language_model=ModelSettings(replay=str(PLANS)),
    )
    with TemporaryDirectory() as runs:
        plan = plan_run(guide, replace(corpus, episodes=tuple(chosen.values())))
        results = run_plan(plan, Path(runs) / "run", workers=1)
        for name, episode in WALKS.items():
            told = chosen[episode].instruction
            site = corpus.sites[told.site]
            [result] = [each for each in results if each.instruction_id == told.id]
            print(f"\n{name}: {told.text}\n{told.failures}")
            print(f"success {result.success}, {result.path_length:.0f} m")
            entries = list(read_trace(Path(runs) / "run", result.episode_id))
            [walk] = [each for each in entries if isinstance(each, TrajectoryEntry)]
            route = site.find_route(told.reference_route)
            path = folder / f"{name}.jpg"
            picture = _picture(site, route, np.array(walk.poses), entries)
            picture.save(path, quality=85, optimize=True)
            print(path, f"{path.stat().st_size / 1e3:.0f} kB")


def _picture(
    site: Any, route: Any, poses: np.ndarray, entries: list[TraceEntry]
) -> Image.Image:
    times, x, y = poses[:, 0], poses[:, 1], poses[:, 2]
    shown = np.vstack([np.array(route.line.coords)[:, :2], poses[:, 1:3]])
    sheet = draw_plan(site, [route], shown, SIZE)
    picture = Image.fromarray(sheet.picture)
    draw = ImageDraw.Draw(picture)
    draw.line([sheet.pixel(*at) for at in zip(x, y, strict=True)], fill=WALK, width=3)
    font = ImageFont.load_default(size=14)
    marked: list[tuple[float, float]] = []
    for number, (time, notes) in enumerate(_marks(entries), start=1):
        column, row = sheet.pixel(np.interp(time, times, x), np.interp(time, times, y))
        while any(np.hypot(column - c, row - r) < 2 * RADIUS for c, r in marked):
            column += 2 * RADIUS
        marked.append((column, row))
        box = (column - RADIUS, row - RADIUS, column + RADIUS, row + RADIUS)
        draw.ellipse(box, fill=MARK, outline="white")
        draw.text((column, row), str(number), fill="white", font=font, anchor="mm")
        print(f"{number}. {time:.0f} s:", *notes, sep="\n     ")
    return picture


def _marks(entries: list[TraceEntry]) -> Iterator[tuple[float, list[NoteEntry]]]:
    """Yield the times at which something is to be told, with the notes of that time."""
    notes = [each for each in entries if isinstance(each, NoteEntry)]
    [end] = [each.time for each in entries if isinstance(each, EndEntry)]
    times = [each.time for each in notes if each.about in TOLD]
    for time in dict.fromkeys([*times, end]):
        at_once = [each for each in notes if each.time == time]
        yield time, [each for each in at_once if each.about != "model_reply"]


if __name__ == "__main__":
    main()
