"""Walks of people as run folders, which every table reads beside those of agents."""

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from pathlib import Path

from memorymaze.errors import SettingsError, StudyError
from memorymaze.evaluation.arena import Arena
from memorymaze.evaluation.provenance import code_stamp
from memorymaze.evaluation.results import EpisodeResult
from memorymaze.evaluation.run_folder import RunRecord, open_run_folder
from memorymaze.evaluation.settings import AgentSettings, RunDefinition
from memorymaze.evaluation.summary import summarise
from memorymaze.evaluation.trace import trace_content
from memorymaze.studies.follow_drives import Walked, finished_walks
from memorymaze.studies.follow_texts import TextsToFollow, texts_to_follow
from memorymaze.studies.follow_walk import MADE_UP, PEOPLE, walk_again
from memorymaze.studies.store import Store
from memorymaze.studies.study_file import Study


@dataclass(frozen=True, slots=True)
class ExportedWalks:
    """What was written."""

    folders: tuple[Path, ...]
    """The run of the first person on each text; those of the second and so on."""
    walks: int
    participants: int
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
    rounds = _rounds(walks)
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
        store.add_export(folder, sorted({who for who, _ in some}))
        agent = AgentSettings(MADE_UP if store.is_simulated else PEOPLE)
        settings = replace(texts.settings, agent=agent, episodes=len(some))
        _write_run(folder, [walk for _, walk in some], study, texts, settings)
    return ExportedWalks(
        tuple(folders),
        len(walks),
        len({who for who, _ in walks}),
        len(texts.episodes) - len(rounds[0]),
    )


def _rounds(walks: Sequence[tuple[str, Walked]]) -> list[list[tuple[str, Walked]]]:
    """Return the first walks on each text, the second ones, and so on."""
    followed: defaultdict[str, int] = defaultdict(int)
    rounds: list[list[tuple[str, Walked]]] = []
    for who, walk in walks:
        number = followed[walk.text]
        followed[walk.text] += 1
        if number == len(rounds):
            rounds.append([])
        rounds[number].append((who, walk))
    return rounds


def _write_run(
    folder: Path,
    walks: Sequence[Walked],
    study: Study,
    texts: TextsToFollow,
    settings: RunDefinition,
) -> None:
    now = datetime.now(UTC).isoformat(timespec="seconds")
    arena = Arena(study.site, looks=settings.looks)
    results: list[EpisodeResult] = []
    with open_run_folder(
        folder,
        RunRecord(settings=settings, code=code_stamp(), started=now),
        resume=False,
        sites=[study.site],
        instructions=[texts.episodes[walk.text].instruction for walk in walks],
    ) as run:
        for walk in walks:
            episode = texts.episodes[walk.text]
            done = walk_again(walk.commands, walk.said, episode, arena, settings)
            result = replace(done.result, wall_s=walk.seconds)
            run.add(result, trace_content(done.trace))
            results.append(result)
        run.write_summary(summarise(results, settings))
