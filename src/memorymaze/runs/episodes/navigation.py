"""One instruction on one route, looked at closely."""

import json
import os
from collections.abc import Iterable
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from memorymaze.basics.durable_files import write_whole
from memorymaze.basics.errors import RunFolderError, SettingsError
from memorymaze.basics.options import check_kind
from memorymaze.language.models.model_settings import ModelSettings
from memorymaze.runs.episodes.agent_catalogue import AgentChoice, choose_agent
from memorymaze.runs.episodes.arena import Arena, arena_of, checked_eyes
from memorymaze.runs.episodes.episode import EpisodeRun, Watcher, run_episode
from memorymaze.runs.episodes.in_words import outcome_line
from memorymaze.runs.episodes.people_to_ask import check_people
from memorymaze.runs.episodes.plan import define_run
from memorymaze.runs.episodes.settings import RunSettings
from memorymaze.runs.episodes.trace import trace_lines
from memorymaze.runs.episodes.trace_entries import (
    NearMissEntry,
    PeopleEntry,
    ThingsEntry,
    TraceEntry,
)
from memorymaze.texts.corpus.corpus import episodes
from memorymaze.texts.corpus.records import Episode, Instruction
from memorymaze.world.drawing.shapes import Met, ThingInTheWay
from memorymaze.world.sites import Route, Site

if TYPE_CHECKING:
    from PIL.Image import Image

FILES = ("trajectory.json", "trace.jsonl", "picture.png")


def check_folder(folder: Path) -> None:
    """Refuse a folder that cannot be written, or has a walk, before an episode is run."""
    there = next(each for each in (folder, *folder.absolute().parents) if each.exists())
    if not there.is_dir() or not os.access(there, os.W_OK | os.X_OK):
        what = "a folder without leave to write" if there.is_dir() else "a file"
        raise RunFolderError(
            f"{folder}: expected a folder to write to, got {what} at {there}; choose "
            "another one with --out"
        )
    kept = [name for name in FILES if (folder / name).exists()]
    if kept:
        raise RunFolderError(
            f"{folder}: has a walk already ({', '.join(kept)}); choose another folder with "
            "--out, or delete it"
        )


def navigate(
    site: Site,
    route: Route,
    text: str,
    agent: AgentChoice,
    settings: RunSettings | None = None,
    *,
    watcher: Watcher | None = None,
    arena: Arena | None = None,
    language_model: ModelSettings | None = None,
) -> EpisodeRun:
    """Let an agent follow one instruction from the start of a route.

    Several walks share what is costly of a building by an arena of it.
    """
    check_kind("text", text, str, "an instruction as a text")
    if not text.strip():
        raise SettingsError("text: expected an instruction, got nothing")
    settings = settings or RunSettings()
    settings.check_budget()
    checked_eyes(settings)
    chosen = choose_agent(agent, language_model)
    check_people(settings, chosen)
    plans = [site.source] if site.source else []
    ready = chosen.make(isolate=settings.isolate, kept_from=plans)
    definition = define_run(chosen.settings, settings, chosen.needs, [site])
    episode = episode_on(site, route, text)
    if arena is None:
        arena = arena_of(definition, site)
    return run_episode(
        ready.in_episode(episode),
        episode,
        arena,
        definition,
        watcher,
        captions=ready.captions,
    )


def episode_on(site: Site, route: Route, text: str) -> Episode:
    """Return the episode of a text as the instruction that describes a route."""
    told = Instruction(
        id=f"{site.name}-{route.id}",
        site=site.name,
        route=route.route,
        text=text,
        reference_route=route.id,
    )
    [episode] = episodes([told], {site.name: site})
    return episode


def _met_in(trace: Iterable[TraceEntry]) -> Met:
    """Return the things and people that a trace tells of."""
    things: list[ThingInTheWay] = []
    walks: list[NDArray[np.float64]] = []
    close: list[tuple[float, float]] = []
    for entry in trace:
        match entry:
            case ThingsEntry():
                things += [each.shape for each in entry.things]
            case PeopleEntry():
                walks += [np.array(walk)[:, 1:] for walk in entry.walks.values()]
            case NearMissEntry():
                close.append(entry.pose[:2])
            case _:
                pass
    return Met(things, walks, close)


def draw_navigation(run: EpisodeRun, site: Site, route: Route) -> "Image":
    """Draw the walk on the part of the plan where it was."""
    from memorymaze.world.drawing.plan_picture import draw_walk, picture_of

    sheet = draw_walk(
        site,
        route,
        run.trajectory,
        instruction=run.opening.instruction,
        outcome=outcome_line(run.result),
        arrived=run.result.success,
        met=_met_in(run.trace),
    )
    return picture_of(sheet)


def write_navigation(
    run: EpisodeRun, site: Site, route: Route, folder: Path
) -> list[Path]:
    """Write `trajectory.json`, `trace.jsonl` and `picture.png` into a folder."""
    content: dict[str, Any] = {
        "site": site.name,
        "route": route.id,
        "instruction": run.opening.instruction,
        "result": asdict(run.result),
        "columns": ["time", "x", "y", "heading"],
        "poses": [list(pose) for pose in run.trajectory.poses],
    }
    files = [folder / name for name in FILES]
    try:
        folder.mkdir(parents=True, exist_ok=True)
        text = json.dumps(content, ensure_ascii=False) + "\n"
        write_whole(files[0], text.encode("utf-8", "backslashreplace"))
        write_whole(files[1], trace_lines(run.trace))
        # Last, so that no picture that fails loses a walk.
        picture = draw_navigation(run, site, route)
        picture.save(files[2], dpi=picture.info["dpi"])
    except OSError as error:
        raise RunFolderError(
            f"{folder}: cannot be written ({error.strerror})"
        ) from None
    return files
