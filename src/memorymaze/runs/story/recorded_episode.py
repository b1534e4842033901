"""An episode of a run as its folder keeps it, with the plan it took place on."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from memorymaze.basics.errors import RunFolderError, SettingsError, did_you_mean
from memorymaze.basics.wording import single_spaced
from memorymaze.runs.episodes.results import EpisodeResult
from memorymaze.runs.episodes.trace import read_trace, trace_path
from memorymaze.runs.story.story import Story, story_of
from memorymaze.runs.work.run_folder import RunRecord, read_plans, read_run
from memorymaze.world.sites import Route, Site


@dataclass(frozen=True, slots=True, eq=False)
class RecordedEpisode:
    """All that is known of an episode that is over."""

    record: RunRecord
    result: EpisodeResult
    story: Story
    site: Site

    @property
    def route(self) -> Route:
        """The way that the instruction describes."""
        return self.site.find_route(self.result.reference_route)

    @property
    def instruction(self) -> str:
        """What the agent was told."""
        return single_spaced(self.story.instruction or "")


def load_episode(folder: str | Path, episode_id: str) -> RecordedEpisode:
    """Read an episode from a run folder, with the plan that the folder keeps.

    Args:
        folder: Of the run.
        episode_id: As `episodes.jsonl` has it.

    Raises:
        SettingsError: The run has no such episode.
        RunFolderError: The folder is no run, keeps no plan, or is damaged.
        SitePlanError: A plan cannot be used.
    """
    path = Path(folder)
    record, results = read_run(path)
    by_id = {result.episode_id: result for result in results}
    result = by_id.get(episode_id)
    if result is None:
        raise SettingsError(_no_such_episode(path, episode_id, list(by_id)))
    story = read_story(path, episode_id)
    return RecordedEpisode(
        record, result, story, site_of(result, read_plans(path), path)
    )


def read_story(folder: Path, episode_id: str) -> Story:
    """Read the story of an episode from its trace."""
    place = str(trace_path(folder, episode_id))
    return story_of(read_trace(folder, episode_id), place)


def site_of(result: EpisodeResult, plans: Mapping[str, Site], folder: Path) -> Site:
    """Return where an episode took place."""
    site = plans.get(result.site)
    if site is None or result.reference_route not in {each.id for each in site.routes}:
        raise RunFolderError(
            f"{folder}: expected a plan of {result.site} with the route "
            f"{result.reference_route!r} in plans/, as episode {result.episode_id!r} "
            f"has it, got {', '.join(plans)} without"
        )
    return site


def _no_such_episode(path: Path, wanted: str, known: list[str]) -> str:
    if not known:
        return (
            f"{path}: expected a run with finished episodes, got none; is it going on?"
        )
    hint = did_you_mean(wanted, known) or f"; they are named like {known[0]}"
    return (
        f"episode: expected one of the {len(known)} that {path} has finished, got "
        f"{wanted!r}{hint}"
    )
