import shutil
from pathlib import Path

import pytest

from memorymaze.basics.errors import RunFolderError, SettingsError
from memorymaze.runs.episodes.trace import trace_path
from memorymaze.runs.story import RecordedEpisode, load_episode
from memorymaze.runs.story.recorded_episode import read_story


@pytest.fixture
def copied(tiny_run: Path, tmp_path: Path) -> Path:
    """A copy of the run, to be damaged."""
    return shutil.copytree(tiny_run, tmp_path / "run")


def test_a_misspelt_episode_is_answered_with_the_nearest(
    episode: RecordedEpisode, tiny_run: Path
) -> None:
    right = episode.result.episode_id
    with pytest.raises(SettingsError, match=f"did you mean '{right}'"):
        load_episode(tiny_run, right + "0")


def test_a_run_needs_nothing_but_its_folder(
    episode: RecordedEpisode, copied: Path
) -> None:
    again = load_episode(copied, episode.result.episode_id)
    assert again.site == episode.site
    assert again.route.goal == episode.route.goal
    assert again.instruction == episode.instruction


def test_a_missing_trace_is_named(episode: RecordedEpisode, copied: Path) -> None:
    trace_path(copied, episode.result.episode_id).unlink()
    with pytest.raises(RunFolderError, match="no such file"):
        load_episode(copied, episode.result.episode_id)


def test_a_flipped_byte_in_a_trace_is_named_wherever_it_is(
    episode: RecordedEpisode, copied: Path
) -> None:
    trace = trace_path(copied, episode.result.episode_id)
    whole = trace.read_bytes()
    problems: list[str] = []
    for place in range(0, len(whole), max(1, len(whole) // 300)):
        damaged = bytearray(whole)
        damaged[place] ^= 0x55
        trace.write_bytes(damaged)
        try:
            read_story(copied, episode.result.episode_id)
        except RunFolderError as error:
            problems.append(str(error))
    assert len(problems) > 250
    assert all(str(trace) in each for each in problems)


def test_a_run_without_the_plan_of_an_episode_is_refused(
    episode: RecordedEpisode, copied: Path
) -> None:
    [plan] = (copied / "plans").glob(f"{episode.site.name}.*")
    plan.unlink()
    with pytest.raises(
        RunFolderError, match=rf"plan.* of {episode.site.name}|its plans"
    ):
        load_episode(copied, episode.result.episode_id)


def test_white_space_of_typed_texts_is_single(
    episode: RecordedEpisode, copied: Path
) -> None:
    assert "  " not in episode.instruction
    assert episode.instruction == " ".join((episode.story.instruction or "").split())
