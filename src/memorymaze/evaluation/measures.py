"""What is measured of an episode: the walk that metrics look at, and how they are told."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from memorymaze.geometry.grid import FloorGrid
from memorymaze.geometry.trajectory import Trajectory
from memorymaze.instructions.records import Episode
from memorymaze.metrics import turns
from memorymaze.metrics.score import MetricValues, score_walk
from memorymaze.metrics.turns import TurnAtPlace
from memorymaze.sites import Route, Site

Shown = Literal["paper", "compared", "spread", "episode", "costs"]


@dataclass(frozen=True)
class FinishedWalk:
    """A walk that is over, and all that metrics may compare it with."""

    site: Site
    grid: FloorGrid
    """The site's walkable floor."""
    episode: Episode
    trajectory: Trajectory
    stopped_by: str
    """Who or what ended it; only `agent` can be a success."""
    success_distance: float
    """Metres."""

    @property
    def points(self) -> NDArray[np.float64]:
        """Positions in the order of time, metres, shape (N, 2)."""
        return self.trajectory.points

    @property
    def reference_route(self) -> Route:
        """The way described."""
        return self.site.route(self.episode.instruction.reference_route)

    @cached_property
    def scores(self) -> MetricValues:
        """The published metrics; UndefinedMetricError where a path leaves the floor."""
        values = score_walk(
            self.grid, self.episode.reference_path, self.points, self.success_distance
        )
        return values if self.stopped_by == "agent" else values.without_success()

    def distances_to_goal(self, places: ArrayLike) -> NDArray[np.float64]:
        """Return the shortest walks from places, shape (k, 2), to the goal, metres."""
        return self.grid.walks.distances_to(self.episode.goal, np.asarray(places))


@dataclass(frozen=True, slots=True)
class Measure:
    """What is said of a field of `EpisodeResult`, in whose type it stands."""

    short: str = ""
    """As papers write it."""
    meaning: str = ""
    better: Literal["higher", "lower"] | None = None
    unit: str = ""
    digits: int = 2
    shown: tuple[Shown, ...] = ()
    """In the paper's tables and leaderboards; in comparisons of runs, which test it; by
    reports, as its spread over episodes and on the pages of episodes; as the costs of a
    language model. Summaries and data frames have every measure."""
    of_walk: Callable[[FinishedWalk], float] | None = None
    """Works it out; None for what the run itself counts."""
    is_amount: bool = False
    """Whether summaries tell its sum as well."""
    is_rechecked: bool = True
    """Whether `runs check` finds it again in poses of whole millimetres."""
    name: str = ""
    """In the columns of tables; that of the field where it is not given."""
    field: str = ""
    """Of `EpisodeResult`; filled in from there."""

    @property
    def heading(self) -> str:
        """What stands above its column."""
        return f"{self.short} ({self.unit})" if self.unit else self.short

    @property
    def title(self) -> str:
        """What stands above a part of a page about it."""
        return f"{self.short}: {self.meaning}"


def site_turns_taken(site: Site, walk: Trajectory) -> list[TurnAtPlace]:
    """Return the turns of a walk in the site's turning points, in their order.

    See `metrics.turns` for what a turn is.
    """
    places = [(place.id, place.polygon) for place in site.turning_points]
    return turns.turns_taken(places, walk)


def route_turns_in_order(site: Site, route: Route, walk: Trajectory) -> float:
    """Return the share of a route's turns that a walk took, in their order.

    Slight and sharp turns count as left or right. 1 for a route without turns.
    """
    wanted = [
        TurnAtPlace(turn.at, "left" if turn.direction.endswith("left") else "right")
        for turn in route.turns
    ]
    return turns.turns_in_order(wanted, site_turns_taken(site, walk))
