"""An episode of a run as its folder keeps it, with the plan it took place on."""

from dataclasses import dataclass
from pathlib import Path

from memorymaze.errors import SettingsError, did_you_mean
from memorymaze.evaluation.results import EpisodeResult
from memorymaze.evaluation.run_folder import RunRecord, read_run
from memorymaze.evaluation.settings import RunDefinition, stamp_file
from memorymaze.evaluation.trace import read_trace, trace_path
from memorymaze.results.story.story import Story, story_of
from memorymaze.sites import (
    BUILTIN_SITE_NAMES,
    Route,
    Site,
    load_site,
    load_sites,
)
from memorymaze.wording import single_spaced


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
        return self.site.route(self.result.reference_route)

    @property
    def instruction(self) -> str:
        """What the agent was told."""
        return single_spaced(self.story.instruction or "")


def load_episode(
    folder: str | Path, episode_id: str, sites_folder: str | Path | None = None
) -> RecordedEpisode:
    """Read an episode from a run folder, and the plan it took place on.

    Args:
        folder: Of the run.
        episode_id: As `episodes.jsonl` has it.
        sites_folder: Folder of the run's site plans; None for the shipped ones.

    Raises:
        SettingsError: The run has no such episode, or the plan is not there or not the
            one that the run was made with.
        RunFolderError: The folder is no run, or the trace is missing or damaged.
        SitePlanError: A plan cannot be used.
    """
    path = Path(folder)
    record, results = read_run(path)
    by_id = {result.episode_id: result for result in results}
    result = by_id.get(episode_id)
    if result is None:
        raise SettingsError(_no_such_episode(path, episode_id, list(by_id)))
    trace = read_trace(path, episode_id)
    story = story_of(trace, str(trace_path(path, episode_id)))
    site = _site_of(record.settings, result.site, sites_folder)
    if not any(route.id == result.reference_route for route in site.routes):
        raise SettingsError(
            f"{path}: expected a route {result.reference_route!r} in the plan "
            f"{site.name}, got none; is {site.source} the plan of this run?"
        )
    return RecordedEpisode(record, result, story, site)


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


def _site_of(
    settings: RunDefinition, name: str, sites_folder: str | Path | None
) -> Site:
    """Return the plan of this name, if it is the one the run was made with."""
    if sites_folder is not None:
        sites = load_sites(sites_folder)
        if name not in sites:
            raise SettingsError(
                f"--sites {sites_folder}: expected the plan of {name}, got "
                f"{', '.join(sites)}"
            )
        site = sites[name]
    elif name in BUILTIN_SITE_NAMES:
        site = load_site(name)
    else:
        raise SettingsError(
            f"the episode took place in {name}, whose plan is not shipped; name the "
            "folder of the run's plans with --sites DIR"
        )
    stamp = next((each for each in settings.sites if each.name == name), None)
    if stamp is not None and stamp_file(site.source).sha256 != stamp.sha256:
        raise SettingsError(
            f"{site.source}: expected the plan that the run was made with (sha256 "
            f"{stamp.sha256[:12]}…), got another one of the same name; name the folder "
            "of the run's plans with --sites DIR"
        )
    return site
