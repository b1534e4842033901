"""One robot in a building, and one instruction followed by an agent."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from memorymaze.basics.errors import SettingsError
from memorymaze.language.models.model_settings import ModelSettings
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.runs.episodes.agent_catalogue import AgentChoice
from memorymaze.runs.episodes.arena import arena_of
from memorymaze.runs.episodes.named_settings import with_choices
from memorymaze.runs.episodes.navigation import (
    draw_navigation,
    episode_on,
    navigate,
    write_navigation,
)
from memorymaze.runs.episodes.seeds import seeds_of
from memorymaze.runs.episodes.settings import OF_MANY_EPISODES, RunSettings
from memorymaze.runs.episodes.trace import plain_entries
from memorymaze.world.sites import Route, Site, load_site

if TYPE_CHECKING:
    from PIL.Image import Image

    from memorymaze.basics.geometry.trajectory import Trajectory
    from memorymaze.runs.episodes.episode import EpisodeRun, Watcher
    from memorymaze.runs.episodes.results import EpisodeResult

OF_AN_AGENT = ("ask", "isolate", "budget_by")
"""Settings that mean nothing where nobody follows an instruction."""


@dataclass(frozen=True, slots=True)
class Walk:
    """What came of one instruction: result, trajectory and trace."""

    text: str
    """The instruction."""
    site: Site
    route: Route
    """The route it was said to describe."""
    run: "EpisodeRun" = field(repr=False)
    """All that the episode left behind."""

    @property
    def result(self) -> "EpisodeResult":
        """Every measure of the walk."""
        return self.run.result

    @property
    def success(self) -> bool:
        """Whether it stopped by itself near enough to the goal."""
        return self.result.success

    @property
    def spd(self) -> float:
        """Shortest walk from where it ended to the goal, metres."""
        return self.result.spd

    @property
    def stopped_by(self) -> str:
        """Who or what ended it, such as `agent` or `budget`."""
        return self.result.stopped_by

    @property
    def trajectory(self) -> "Trajectory":
        """Where the robot went."""
        return self.run.trajectory

    @property
    def trace(self) -> tuple[dict[str, Any], ...]:
        """Every call and note in the order of time; see `docs/formats.md`."""
        return plain_entries(self.run.trace)

    def plot(self) -> "Image":
        """Draw the walk on the plan; notebooks show the picture."""
        return draw_navigation(self.run, self.site, self.route)

    def save(self, folder: str | Path) -> list[Path]:
        """Write trajectory, trace and picture into a folder; return the files.

        Raises:
            RunFolderError: The folder cannot be written.
        """
        return write_navigation(self.run, self.site, self.route, Path(folder))

    def __repr__(self) -> str:
        """Say how it ended."""
        end = "arrived" if self.success else f"ended {self.spd:.1f} m from the goal"
        return (
            f"Walk({self.site.name} {self.route.id}: {end}, stopped by "
            f"{self.stopped_by}, {self.result.path_length:.1f} m in "
            f"{self.result.duration_s:.0f} s)"
        )


def follow(
    text: str,
    agent: AgentChoice = "guide",
    *,
    site: Site | str | Path,
    route: str = "R1",
    settings: RunSettings | None = None,
    language_model: ModelSettings | None = None,
    watcher: "Watcher | None" = None,
    **choices: Any,
) -> Walk:
    """Let an agent follow one instruction from the start of a route.

    Args:
        text: The instruction.
        agent: A name, your own as `module:Class` or `file.py:Class`, a class, an object,
            or `AgentSettings` where it is given options.
        site: The building: loaded, or by name or file.
        route: Gives start and goal: `R1`, or the id of a way.
        settings: How the episode is run; the defaults when None.
        language_model: Which one the agent asks, and how, where it needs one.
        watcher: Looks on while the agent follows.
        **choices: Settings to change, such as `seed=1` or `obstacles="light"`; see
            `RunSettings` and `SimulationSettings`.

    Raises:
        MemoryMazeError: Something that was given cannot be used; what the agent does
            wrong is part of the walk.
    """
    building = site if isinstance(site, Site) else load_site(site)
    way = building.find_route(route)
    run = navigate(
        building,
        way,
        text,
        agent,
        _of_one_walk(settings, choices),
        watcher=watcher,
        language_model=language_model,
    )
    return Walk(text, building, way, run)


def make_robot(
    site: Site | str | Path,
    route: str = "R1",
    *,
    settings: RunSettings | None = None,
    **choices: Any,
) -> SimulatedRobot:
    """Put a robot at the start of a route, to be driven by hand.

    It is not guarded: its `scene` knows the building and the goal. Agents get another
    one, which does not.

    Args:
        site: The building: loaded, or by name or file.
        route: Gives the start: `R1`, or the id of a way.
        settings: What the robot can do, what sees and reads for it, its body, noise,
            things and people in the way, seed and time; defaults when None, with time
            without end.
        **choices: Settings to change, as for `follow`.

    Raises:
        MemoryMazeError: Something that was given cannot be used.
    """
    building = site if isinstance(site, Site) else load_site(site)
    chosen = _of_one_walk(settings, choices)
    unused = chosen.changed(OF_AN_AGENT)
    if unused:
        raise SettingsError(
            f"{', '.join(unused)}: expected none for a robot driven by hand; people answer "
            "an agent only, and who drives ends the walk: use follow(), obstacles to drive "
            "among people, or time_budget"
        )
    episode = episode_on(building, building.find_route(route), "driven by hand")
    seeds = seeds_of(chosen.seed, episode.id)
    return arena_of(chosen, building).robot(
        episode,
        replace(chosen.simulation, time_budget=chosen.time_budget or math.inf),
        seeds.robot,
        lambda event: None,
        seeds.detector,
    )


def _of_one_walk(
    settings: RunSettings | None, choices: Mapping[str, Any]
) -> RunSettings:
    """Return settings with some changed; refuse by name what means nothing here."""
    chosen = with_choices(RunSettings() if settings is None else settings, choices)
    changed = chosen.changed(OF_MANY_EPISODES)
    for name in OF_MANY_EPISODES:
        if name in choices or name in changed:
            raise SettingsError(
                f"setting {name}: is of runs of many episodes, and this is one walk, got "
                f"{getattr(chosen, name)}; leave it out, or use evaluate()"
            )
    return chosen
