import shutil
from pathlib import Path

import pytest

from memorymaze.errors import RunFolderError, SettingsError
from memorymaze.evaluation.trace import trace_path
from memorymaze.results.story import RecordedEpisode, load_episode


def test_a_misspelt_episode_is_answered_with_the_nearest(
    episode: RecordedEpisode, tiny_run: Path, tiny_sites_folder: Path
) -> None:
    right = episode.result.episode_id
    with pytest.raises(SettingsError, match=f"did you mean '{right}'"):
        load_episode(tiny_run, right + "0", tiny_sites_folder)


def test_a_missing_trace_is_named(
    episode: RecordedEpisode, tiny_run: Path, tiny_sites_folder: Path, tmp_path: Path
) -> None:
    run = shutil.copytree(tiny_run, tmp_path / "run")
    trace_path(run, episode.result.episode_id).unlink()
    with pytest.raises(RunFolderError, match="no such file"):
        load_episode(run, episode.result.episode_id, tiny_sites_folder)


def test_plans_that_are_not_shipped_must_be_named(
    episode: RecordedEpisode, tiny_run: Path
) -> None:
    with pytest.raises(SettingsError, match="--sites DIR"):
        load_episode(tiny_run, episode.result.episode_id)


def test_a_plan_that_changed_since_the_run_is_refused(
    episode: RecordedEpisode, tiny_run: Path, tiny_sites_folder: Path, tmp_path: Path
) -> None:
    sites = shutil.copytree(tiny_sites_folder, tmp_path / "sites")
    plan = sites / Path(episode.site.source).name
    plan.write_text(plan.read_text("utf-8") + "\n", "utf-8")
    with pytest.raises(SettingsError, match="the plan that the run was made with"):
        load_episode(tiny_run, episode.result.episode_id, sites)


def test_a_folder_without_the_plan_is_refused(
    episode: RecordedEpisode, tiny_run: Path, tiny_sites_folder: Path, tmp_path: Path
) -> None:
    sites = shutil.copytree(tiny_sites_folder, tmp_path / "sites")
    (sites / Path(episode.site.source).name).unlink()
    with pytest.raises(SettingsError, match=f"the plan of {episode.site.name}"):
        load_episode(tiny_run, episode.result.episode_id, sites)
