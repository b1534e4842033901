"""Walks of people as run folders, which every table reads beside those of agents."""

import math
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from pathlib import Path
from typing import NamedTuple

from memorymaze.basics.errors import SettingsError, StudyError
from memorymaze.runs.episodes.arena import Arena, arena_of
from memorymaze.runs.episodes.episode import EpisodeRun
from memorymaze.runs.episodes.provenance import code_stamp
from memorymaze.runs.episodes.results import EpisodeResult
from memorymaze.runs.episodes.settings import AgentSettings, RunDefinition
from memorymaze.runs.episodes.summary import summarise
from memorymaze.runs.episodes.trace import trace_content
from memorymaze.runs.work.run_folder import RunRecord, open_run_folder
from memorymaze.texts.corpus.records import Episode
from memorymaze.web.studies.follow.drives import Walked, finished_walks
from memorymaze.web.studies.follow.texts import TextsToFollow, texts_to_follow
from memorymaze.web.studies.follow.walk import PEOPLE, walk_again
from memorymaze.web.studies.store import Store
from memorymaze.web.studies.study_file import Study

SAME_PLACE = 0.5
"""Metres by which a walk that is driven once more may end elsewhere: it rolls to rest."""


@dataclass(frozen=True, slots=True)
class ExportedWalks:
    """What was written."""

    folders: tuple[Path, ...]
    """The run of the first person on each text; those of the second and so on."""
    walks: int
    participants: int
    elsewhere: tuple[str, ...]
    """Walks left out, which end elsewhere than their drivers saw."""
    never_followed: int
    """Texts of the study that nobody has followed to an end."""


def export_walks(study: Study, store: Store, out: str | Path) -> ExportedWalks:
    """Score every walk that was ended, and write runs of the agent `people`.

    A run has one walk of each text. Where several people followed one, the second walks
    are a run of their own, `OUT-2`, and so on.
    """
    texts = texts_to_follow(study)
    routes = [each.route for each in study.design.routes]
    walks = finished_walks(store, routes)
    if not walks:
        raise StudyError(
            f"{store.folder}: expected walks that were ended, got none; the "
            "experimenter's page shows how far participants are"
        )
    agent = AgentSettings(PEOPLE)
    settings = replace(texts.settings, agent=agent)
    arena = arena_of(settings, study.site)
    # All are driven before anything is written: one that is refused leaves no half run.
    again = [
        _Driven(who, walk, _again(walk, texts.episode(walk.text), arena, settings))
        for who, walk in walks
    ]
    driven = [each for each in again if each.ends_as_seen]
    elsewhere = tuple(
        f"{each.who} on {each.walk.text}" for each in again if not each.ends_as_seen
    )
    if not driven:
        raise StudyError(
            f"{store.folder}: expected walks that end where their drivers saw them end, "
            f"got {', '.join(elsewhere)}; export them with the plan and the version of "
            "memorymaze that they were driven with"
        )
    rounds = _rounds(driven)
    folders = [
        Path(out) if number == 1 else Path(f"{out}-{number}")
        for number in range(1, len(rounds) + 1)
    ]
    for folder in folders:
        if folder.exists():
            raise SettingsError(
                f"--out: expected a folder that is not there yet, got {folder}"
            )
    for folder, some in zip(folders, rounds, strict=True):
        store.add_export(folder, sorted({each.who for each in some}))
        _write_run(folder, some, study, texts, replace(settings, episodes=len(some)))
    return ExportedWalks(
        tuple(folders),
        len(driven),
        len({each.who for each in driven}),
        elsewhere,
        len(texts.episodes) - len({walk.text for _, walk in walks}),
    )


class _Driven(NamedTuple):
    who: str
    walk: Walked
    run: EpisodeRun

    @property
    def ends_as_seen(self) -> bool:
        """Whether it ends where its driver saw it end, or nobody saw that."""
        end = self.run.trajectory.poses[-1]
        place = self.walk.place
        return place is None or math.dist(place, (end.x, end.y)) <= SAME_PLACE


def _rounds(driven: Sequence[_Driven]) -> list[list[_Driven]]:
    """Return the first walks on each text, the second ones, and so on."""
    followed: Counter[str] = Counter()
    rounds: list[list[_Driven]] = []
    for each in driven:
        number = followed[each.walk.text]
        followed[each.walk.text] += 1
        if number == len(rounds):
            rounds.append([])
        rounds[number].append(each)
    return rounds


def _write_run(
    folder: Path,
    driven: Sequence[_Driven],
    study: Study,
    texts: TextsToFollow,
    settings: RunDefinition,
) -> None:
    now = datetime.now(UTC).isoformat(timespec="seconds")
    results: list[EpisodeResult] = []
    with open_run_folder(
        folder,
        RunRecord(settings=settings, code=code_stamp(), started=now),
        resume=False,
        sites=[study.site],
        instructions=[texts.episode(each.walk.text).instruction for each in driven],
    ) as run:
        for _, walk, done in driven:
            results.append(replace(done.result, wall_s=walk.seconds))
            run.add(results[-1], trace_content(done.trace))
        run.write_summary(summarise(results, settings))


def _again(
    walk: Walked, episode: Episode, arena: Arena, settings: RunDefinition
) -> EpisodeRun:
    """Drive a walk once more; refuse one on other words than were followed."""
    if episode.instruction.text != walk.told:
        raise StudyError(
            f"text {episode.id!r}: expected it as it was followed, got other words; bring "
            "the instruction file back as it was"
        )
    return walk_again(walk.commands, walk.said, episode, arena, settings)
