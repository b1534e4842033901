"""One person who walks about: where they are, where to, and how far they have come."""

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from memorymaze.simulation.obstacles.kinds import Movable

LOOK_AHEAD = 3
"""Points of the way ahead of the nearest one at which a person aims."""
SEARCHED = 12
"""Points of the way among which the nearest is looked for."""
ARRIVED = 0.4
"""Metres from the end of the way at which a person has arrived."""


@dataclass(slots=True, eq=False)
class Person:
    """Someone in one episode; positions in metres, velocities in metres per second."""

    record: Movable
    speed: float
    """Of walking undisturbed, metres per second."""
    rng: np.random.Generator
    """Where the choices of this person come from."""
    x: float = 0.0
    y: float = 0.0
    vx: float = 0.0
    vy: float = 0.0
    heading: float = 0.0
    """The way the person faces, radians."""
    goal: tuple[float, float] = (0.0, 0.0)
    way: NDArray[np.float64] = field(default_factory=lambda: np.zeros((1, 2)))
    """Points to walk along, (N, 2)."""
    tight: NDArray[np.bool_] = field(default_factory=lambda: np.zeros(1, dtype=bool))
    """Whether walls or things are close beside each of these points, (N,)."""
    reached: int = 0
    """Number of the way's point that is nearest."""
    stands_until: float = -math.inf
    """Simulated time up to which the person stands still."""
    progress_at: float = 0.0
    """When the person last got on along the way."""
    progress: int = 0
    """How far the person had come then."""

    @property
    def radius(self) -> float:
        """Metres."""
        return self.record.radius

    @property
    def pace(self) -> float:
        """Metres per second at this moment."""
        return math.hypot(self.vx, self.vy)

    @property
    def in_tight_place(self) -> bool:
        """Whether walls or things are close here or a few steps ahead."""
        return bool(self.tight[self.reached : self.reached + LOOK_AHEAD + 1].any())

    def take(
        self,
        way: NDArray[np.float64],
        tight: NDArray[np.bool_],
        goal: tuple[float, float],
    ) -> None:
        """Begin a way."""
        self.way, self.tight, self.goal = way, tight, goal
        self.reached = self.progress = 0

    def wanted(self) -> tuple[float, float, float]:
        """Return the velocity to go on along the way, and the metres beside it."""
        window = self.way[self.reached : self.reached + SEARCHED]
        dx, dy = window[:, 0] - self.x, window[:, 1] - self.y
        squares = dx * dx + dy * dy
        nearest = int(np.argmin(squares))
        self.reached += nearest
        aside = math.sqrt(float(squares[nearest]))
        ax, ay = self.way[min(self.reached + LOOK_AHEAD, len(self.way) - 1)].tolist()
        ux, uy = ax - self.x, ay - self.y
        left = math.hypot(ux, uy)
        if left < 1e-6:
            return 0.0, 0.0, aside
        share = self.speed / left
        return ux * share, uy * share, aside

    def has_arrived(self) -> bool:
        """Whether the end of the way is reached."""
        ex, ey = self.way[-1].tolist()
        return math.hypot(ex - self.x, ey - self.y) < ARRIVED
