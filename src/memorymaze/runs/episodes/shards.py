"""Runs in parts, for batch schedulers: each job does a shard, in the folder of the run."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

from memorymaze.basics.errors import RunFolderError
from memorymaze.runs.episodes.provenance import CodeStamp
from memorymaze.runs.episodes.settings import RunDefinition, Shard, differences
from memorymaze.texts.corpus.records import Episode


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


def part_folder(folder: Path, shard: Shard | None) -> Path:
    """Return where a part of a run is written: in the folder of the run."""
    return folder if shard is None else folder / f"part-{shard.number}-of-{shard.of}"


def whole_folder(folder: Path, shard: Shard | None) -> Path:
    """Return the folder of the run that a folder is, or is a part of."""
    return folder if shard is None else folder.parent


def parts_in(folder: Path) -> list[Path]:
    """Return the folders of the parts of a run; none where it was run in one piece."""
    return sorted(each for each in folder.glob("part-*-of-*") if each.is_dir())


class PartOfRun(NamedTuple):
    """What is known of a part before it is one of a whole."""

    folder: Path
    settings: RunDefinition
    code: CodeStamp


def whole_settings(parts: Sequence[PartOfRun]) -> RunDefinition:
    """Return the settings of the run that parts make; refuse what makes none.

    Raises:
        RunFolderError: A part is missing, there twice, or was made differently.
    """
    first = parts[0]
    alike = replace(first.settings, shard=None, episodes=0)
    for part in parts:
        own = replace(part.settings, shard=None, episodes=0)
        found = [*map(str, differences(alike, own))]
        found += first.code.differences(part.code)
        if found:
            raise RunFolderError(
                f"{part.folder}: expected a part of the same run as {first.folder}, got "
                "one that was made differently:\n  " + "\n  ".join(found)
            )
    _check_complete(parts)
    return replace(alike, episodes=sum(part.settings.episodes for part in parts))


def _check_complete(parts: Sequence[PartOfRun]) -> None:
    folders: dict[Shard, Path] = {}
    for folder, settings, _ in parts:
        shard = settings.shard
        if shard is None:
            raise RunFolderError(
                f"{folder}: expected a part of a run (evaluate --with shard=1/8), got a "
                "whole run; move it elsewhere"
            )
        if shard in folders:
            raise RunFolderError(
                f"{folder}: is part {shard}, as {folders[shard]} is; move one elsewhere"
            )
        folders[shard] = folder
    of = max(shard.of for shard in folders)
    wanted = {Shard(number, of) for number in range(1, of + 1)}
    missing = sorted(wanted - set(folders), key=lambda shard: shard.number)
    if missing or len(folders) != of:
        there = ", ".join(folder.name for folder in folders.values())
        raise RunFolderError(
            f"{parts[0].folder.parent}: expected all {of} parts of the run, got {there}"
            + (f"; missing: {', '.join(map(str, missing))}" if missing else "")
        )
