"""A site made ready for episodes: its scene, its grid, and what scoring needs."""

from collections.abc import Callable
from functools import cached_property

import numpy as np

from memorymaze.geometry.grid import FloorGrid
from memorymaze.geometry.trajectory import Trajectory
from memorymaze.instructions.records import Episode
from memorymaze.metrics.score import MetricValues, score_walk
from memorymaze.simulation import (
    Scene,
    SimulatedRobot,
    SimulationSettings,
    TraceEvent,
    build_scene,
)
from memorymaze.sites import Site

__all__ = ["Arena"]


class Arena:
    """A site in which any number of episodes can take place, one after the other.

    What is costly is made once, when it is first needed.
    """

    def __init__(self, site: Site) -> None:
        """Stand for a site; nothing is built yet."""
        self.site = site

    @cached_property
    def scene(self) -> Scene:
        """The physics model."""
        return build_scene(self.site)

    @cached_property
    def grid(self) -> FloorGrid:
        """The 0.5 m grid of the walkable floor, with its distances."""
        return FloorGrid.from_polygon(self.site.walkable_floor)

    def robot(
        self,
        episode: Episode,
        settings: SimulationSettings,
        rng: np.random.Generator,
        on_event: Callable[[TraceEvent], None],
    ) -> SimulatedRobot:
        """Put a robot at the start of an episode."""
        return SimulatedRobot(self.scene, episode.start, settings, rng, on_event)

    def score(
        self, episode: Episode, walk: Trajectory, success_distance: float
    ) -> MetricValues:
        """Score a walk against the reference path of its episode.

        Raises:
            UndefinedMetricError: The walk or the reference path leaves the floor.
        """
        return score_walk(
            self.grid, episode.reference_path, walk.points, success_distance
        )
