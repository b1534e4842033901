"""A site made ready for episodes: its scene, its grid, and what scoring needs."""

from collections.abc import Callable, Mapping
from contextlib import suppress
from functools import cached_property

import numpy as np

from memorymaze.agents.agent import Need
from memorymaze.basics.geometry.grid import FloorGrid
from memorymaze.basics.geometry.trajectory import Trajectory
from memorymaze.language.models.building import build_language_model
from memorymaze.language.models.model import LanguageModel
from memorymaze.robot.perception.eyes import Eyes
from memorymaze.robot.simulation.obstacles import ObstacleSettings
from memorymaze.robot.simulation.own_body import CanBeClosed
from memorymaze.robot.simulation.robot import SimulatedRobot
from memorymaze.robot.simulation.scene import Scene, build_scene
from memorymaze.robot.simulation.senses.noise import NoiseSettings
from memorymaze.robot.simulation.settings import SimulationSettings
from memorymaze.robot.steering.calls import TraceEvent
from memorymaze.runs.episodes.bodies import BodyMaker, find_body
from memorymaze.runs.episodes.results import FinishedWalk
from memorymaze.runs.episodes.seeds import obstacle_generator
from memorymaze.runs.episodes.settings import AgentSettings, RunDefinition, RunSettings
from memorymaze.texts.corpus.records import Episode
from memorymaze.texts.passers_by import FloorKnowledge
from memorymaze.world.looks import OWN, Looks
from memorymaze.world.sites import Site


class Arena:
    """A site in which any number of episodes can take place, one after the other.

    What is costly is made once, when it is first needed.
    """

    def __init__(
        self,
        site: Site,
        obstacles: ObstacleSettings | None = None,
        eyes: Eyes | None = None,
        looks: Looks | None = None,
        people_model: LanguageModel | None = None,
        make_robot: Callable[..., SimulatedRobot] = SimulatedRobot,
        body: BodyMaker | None = None,
        noise: NoiseSettings | None = None,
    ) -> None:
        """Stand for a site; nothing is built yet.

        Without eyes, detector and reader of signs know the truth; without looks, things have
        our own; without a model, people one can ask find their words elsewhere; without
        noise, LiDAR and odometry are exact. Robots are made by `make_robot`, with what
        `robot` tells it, and have the simulated body or those that `body` makes.
        """
        self.site = site
        self.obstacles = obstacles
        self.eyes = eyes or Eyes()
        self.looks: Looks = looks or OWN
        self.people_model = people_model
        self._make_robot = make_robot
        self._body = body
        self._noise = noise

    @cached_property
    def scene(self) -> Scene:
        """The physics model."""
        return build_scene(self.site, self.obstacles)

    @cached_property
    def grid(self) -> FloorGrid:
        """The 0.5 m grid of the walkable floor, with its distances."""
        return FloorGrid.from_polygon(self.site.walkable_floor)

    @cached_property
    def floor(self) -> FloorKnowledge:
        """What people know of it whom one asks."""
        return FloorKnowledge(self.site, self.grid)

    def robot(
        self,
        episode: Episode,
        settings: SimulationSettings,
        rng: np.random.Generator,
        on_event: Callable[[TraceEvent], None],
        detector_rng: np.random.Generator | None = None,
    ) -> SimulatedRobot:
        """Put a robot at the start of an episode; the caller closes it.

        Without a generator of its own, the detector's mistakes are seeded with 0.

        Raises:
            RobotBodyError: Its body cannot be had.
        """
        body, placing = None, None
        if self._body is not None:
            body = self._body.make(self.site, episode.start, settings, rng)
        if self.obstacles is not None:
            placing = obstacle_generator(self.obstacles.seed, episode.id)
        try:
            return self._make_robot(
                self.scene,
                episode.start,
                settings,
                rng,
                on_event,
                detector=self.eyes.detector_for(
                    detector_rng or np.random.default_rng(0), settings.detection_range
                ),
                sign_reader=self.eyes.sign_reader(),
                obstacles_rng=placing,
                keep_free=episode.reference_path,
                lidar=None if self._noise is None else self._noise.lidar,
                odometry=None if self._noise is None else self._noise.odometry,
                looks=self.looks,
                body=body,
            )
        except BaseException:
            if isinstance(body, CanBeClosed):
                # Why it cannot begin is what is told.
                with suppress(Exception):
                    body.close()
            raise

    def finished(
        self,
        episode: Episode,
        trajectory: Trajectory,
        stopped_by: str,
        success_distance: float,
    ) -> FinishedWalk:
        """Return the walk of an episode that is over, to be measured.

        One that leaves the floor ends there, as a crash.

        Raises:
            UndefinedMetricError: The episode's reference path leaves the floor.
        """
        walk = FinishedWalk(
            self.site, self.grid, episode, trajectory, stopped_by, success_distance
        )
        return walk.while_on_floor()


def arenas_of(settings: RunSettings, sites: Mapping[str, Site]) -> dict[str, Arena]:
    """Return the arenas of a run, where this machine has what they need.

    Settings without an agent have no model that plays people.
    """
    eyes, people = checked_eyes(settings), None
    if isinstance(settings, RunDefinition):
        people = model_of_people(settings, settings.agent)
    body = find_body(settings.robot)
    obstacles, looks, noise = settings.obstacles, settings.looks, settings.noise
    return {
        name: Arena(site, obstacles, eyes, looks, people, body=body, noise=noise)
        for name, site in sites.items()
    }


def arena_of(settings: RunSettings, site: Site) -> Arena:
    """Return the arena of a single building."""
    return arenas_of(settings, {site.name: site})[site.name]


def checked_eyes(settings: RunSettings) -> Eyes:
    """Return eyes that can be used here."""
    eyes = Eyes(settings.detector, settings.signs)
    if eyes.need_pictures:
        # Only these runs load OpenGL.
        from memorymaze.world.cameras.open_gl import choose_backend

        choose_backend()
    eyes.check()
    return eyes


def looks_of_run(
    agent: AgentSettings, needs: frozenset[Need], settings: RunSettings
) -> Looks | None:
    """Return how things look to the cameras of a run; None where nothing is drawn.

    Looks that are named are checked all the same.
    """
    # An agent of a user's own that declares nothing may take pictures all the same.
    may_look = "camera" in needs or (agent.is_own and not needs)
    drawn = may_look or Eyes(settings.detector, settings.signs).need_pictures
    if not drawn and settings.looks is None:
        return None
    # Only these runs load the looks of things.
    from memorymaze.world.looks.catalogue import check_looks

    looks = check_looks(settings.looks or OWN)
    return looks if drawn else None


def model_of_people(
    settings: RunSettings, agent: AgentSettings
) -> LanguageModel | None:
    """Return the model that plays people; None where they answer otherwise.

    Raises:
        SettingsError: No model is named, or it cannot be used.
    """
    if settings.passers_by != "model":
        return None
    return build_language_model(agent.language_model)
