"""Runs in parts, for batch schedulers: each job does a shard, and shards are merged."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from memorymaze.errors import RunFolderError, SettingsError
from memorymaze.evaluation.results import EpisodeResult
from memorymaze.evaluation.run_folder import (
    RunRecord,
    open_run_folder,
    read_instructions,
    read_plans,
    read_run,
)
from memorymaze.evaluation.settings import Shard, differences
from memorymaze.evaluation.summary import summarise
from memorymaze.evaluation.trace import trace_path
from memorymaze.instructions.records import Episode
from memorymaze.wording import counted


def episodes_of_shard(
    episodes: Sequence[Episode], shard: Shard | None
) -> list[Episode]:
    """Return the episodes of a shard, in their order; all for None.

    Shards are alike in size and in what they ask: in the order of sites and routes, each
    takes one episode in turn.
    """
    if shard is None:
        return list(episodes)

    def place(episode: Episode) -> tuple[str, str, str, str]:
        told = episode.instruction
        return told.site, told.route, told.study, episode.id

    taken = sorted(episodes, key=place)[shard.number - 1 :: shard.of]
    ids = {episode.id for episode in taken}
    return [episode for episode in episodes if episode.id in ids]


@dataclass(frozen=True, slots=True)
class _Part:
    folder: Path
    record: RunRecord
    results: list[EpisodeResult]
    shard: Shard


def merge_shards(folders: Sequence[str | Path], out: str | Path) -> list[EpisodeResult]:
    """Write one run folder from those of all shards of a run.

    The folder equals that of the same run without shards, but for the order of lines and
    what was measured with a clock.
    """
    parts = [_read_part(Path(folder)) for folder in folders]
    if not parts:
        raise SettingsError("expected the run folders of all shards, got none")
    _check_alike(parts)
    _check_complete(parts)
    for part in parts:
        _check_traces(part)
    first = min(parts, key=lambda part: part.record.started)
    episodes = sum(part.record.settings.episodes for part in parts)
    settings = replace(first.record.settings, shard=None, episodes=episodes)
    sites = {
        name: site for part in parts for name, site in read_plans(part.folder).items()
    }
    told = {each.id: each for part in parts for each in read_instructions(part.folder)}
    results = sorted(
        ((each, part.folder) for part in parts for each in part.results),
        key=lambda pair: pair[0].episode_id,
    )
    with open_run_folder(
        Path(out),
        replace(first.record, settings=settings),
        resume=False,
        sites=sites.values(),
        instructions=told.values(),
    ) as run:
        for result, folder in results:
            run.add(result, trace_path(folder, result.episode_id).read_bytes())
        run.write_summary(summarise([each for each, _ in results], settings))
    return [each for each, _ in results]


def _read_part(folder: Path) -> _Part:
    record, results = read_run(folder)
    shard = record.settings.shard
    if shard is None:
        raise RunFolderError(
            f"{folder}: expected a shard of a run (evaluate --with shard=1/8), got a whole run"
        )
    if len(results) != record.settings.episodes:
        raise RunFolderError(
            f"{folder}: expected all {counted(record.settings.episodes, 'episode')} of "
            f"shard {shard}, got {len(results)}; finish it with --resume"
        )
    return _Part(folder, record, results, shard)


def _check_traces(part: _Part) -> None:
    for result in part.results:
        trace = trace_path(part.folder, result.episode_id)
        if not trace.is_file():
            raise RunFolderError(
                f"{trace}: expected the trace of episode {result.episode_id!r}, got no "
                "such file"
            )


def _check_alike(parts: Sequence[_Part]) -> None:
    first = parts[0]
    whole = replace(first.record.settings, shard=None, episodes=0)
    for part in parts[1:]:
        own = replace(part.record.settings, shard=None, episodes=0)
        found = [*map(str, differences(whole, own))]
        found += first.record.code.differences(part.record.code)
        if found:
            raise RunFolderError(
                f"{part.folder}: expected a shard of the same run as {first.folder}, got "
                "one that was made differently:\n  " + "\n  ".join(found)
            )


def _check_complete(parts: Sequence[_Part]) -> None:
    folders: dict[Shard, Path] = {}
    for part in parts:
        if part.shard in folders:
            raise RunFolderError(
                f"{part.folder}: is shard {part.shard}, as {folders[part.shard]} is; "
                "name each once"
            )
        folders[part.shard] = part.folder
    of = parts[0].shard.of
    missing = [Shard(n, of) for n in range(1, of + 1) if Shard(n, of) not in folders]
    if missing or len(folders) != of:
        raise RunFolderError(
            f"expected all {of} shards of the run, got {', '.join(map(str, folders))}"
            + (f"; missing: {', '.join(map(str, missing))}" if missing else "")
        )
