"""Mistakes of a detector, drawn by chance: misses, confusions and phantoms.

`docs/seeing.md` has the formulas. What is drawn depends on the episode's seed, the
place looked from, the words asked for and the thing alone: who asks again from the same
place gets the same mistakes, as from a real detector, and looks in between change none.
"""

import hashlib
import math
from dataclasses import dataclass, fields

import numpy as np

from memorymaze.basics.geometry.pose import Pose
from memorymaze.basics.options import check_number
from memorymaze.robot.perception.camera_view import VisibleObject, box_bearing

REFERENCE_SIZE = 64.0
"""Pixels; square root of the box's area of the reference thing."""
REFERENCE_DISTANCE = 2.0
"""Metres to the reference thing."""
CELL = 0.5
"""Metres; the robot must move so far on for other mistakes, or turn by `TURN`."""
TURN = math.radians(15)
"""Radians."""
WIDTH, HEIGHT = 640, 480
PHANTOM_SIZE = (0.2, 1.2)
"""Metres; side of the square that a phantom seems to fill, least and greatest."""
NEAREST_PHANTOM = 0.5
"""Metres."""


@dataclass(frozen=True, slots=True)
class ErrorModel:
    """How often a detector is wrong.

    The reference thing is 2 m away, 64 by 64 pixels large, and nothing hides it. For
    others the log-odds change by `size` for each halving of the apparent size, by
    `distance` for each metre farther, and by `occlusion` times the hidden share.
    """

    miss: float = 0.1
    """Probability that the reference thing goes unseen, 0 to 1."""
    confusion: float = 0.01
    """Probability that the reference thing is taken for the one asked for, 0 to 1."""
    phantoms: float = 0.02
    """Mean number per look of boxes where nothing is (Poisson)."""
    size: float = 0.7
    """Log-odds of a mistake per halving of the apparent size."""
    distance: float = 0.5
    """Log-odds of a mistake per metre of distance."""
    occlusion: float = 3.0
    """Log-odds of a mistake per share hidden, so for a wholly hidden thing."""

    def __post_init__(self) -> None:
        """Check every value."""
        for each in fields(self):
            most = 1 if each.name in ("miss", "confusion") else 100
            value = getattr(self, each.name)
            check_number(f"detector setting {each.name}", value, 0, most)

    def miss_probability(self, thing: VisibleObject) -> float:
        """Return how likely a thing goes unseen."""
        return _shifted(self.miss, self._difficulty(thing))

    def confusion_probability(self, thing: VisibleObject) -> float:
        """Return how likely a thing is taken for another."""
        return _shifted(self.confusion, self._difficulty(thing))

    def _difficulty(self, thing: VisibleObject) -> float:
        """Return by how much the log-odds of a mistake exceed the reference's."""
        left, top, right, bottom = thing.box
        apparent = math.sqrt(max((right - left) * (bottom - top), 1.0))
        return (
            self.size * math.log2(REFERENCE_SIZE / apparent)
            + self.distance * (thing.distance - REFERENCE_DISTANCE)
            + self.occlusion * (1 - thing.visible_fraction)
        )


@dataclass(frozen=True, slots=True)
class Phantom:
    """A box where nothing is."""

    box: tuple[float, float, float, float]
    """Pixels (left, top, right, bottom)."""
    distance: float
    """Metres."""
    bearing: float
    """Radians, left positive."""
    score: float


class ErrorSource:
    """Draws the mistakes of one episode."""

    def __init__(self, model: ErrorModel, rng: np.random.Generator) -> None:
        """Begin an episode; one number is drawn for its seed."""
        self.model = model
        """How often mistakes happen."""
        self._seed = int(rng.integers(2**63))

    def misses(self, thing: VisibleObject, pose: Pose, query: str) -> bool:
        """Tell whether a thing that fits the words goes unseen from a pose."""
        chance = self._uniform("miss", pose, query, _key(thing))
        return chance < self.model.miss_probability(thing)

    def confuses(self, thing: VisibleObject, pose: Pose, query: str) -> bool:
        """Tell whether a thing that does not fit the words is taken for one."""
        chance = self._uniform("confusion", pose, query, _key(thing))
        return chance < self.model.confusion_probability(thing)

    def false_score(self, thing: VisibleObject, pose: Pose, query: str) -> float:
        """Return the score of a thing taken for another, 0.5 to 0.8."""
        return 0.5 + 0.3 * self._uniform("score", pose, query, _key(thing))

    def phantoms(self, pose: Pose, query: str, range_limit: float) -> list[Phantom]:
        """Return the boxes of a look where nothing is."""
        rng = np.random.default_rng(self._digest("phantoms", pose, query, ""))
        return [
            _phantom(rng, range_limit) for _ in range(rng.poisson(self.model.phantoms))
        ]

    def _uniform(self, what: str, pose: Pose, query: str, key: str) -> float:
        return (self._digest(what, pose, query, key) >> 11) / 2**53

    def _digest(self, what: str, pose: Pose, query: str, key: str) -> int:
        """Return 64 random bits for one question from one place."""
        place = (
            math.floor(pose.x / CELL),
            math.floor(pose.y / CELL),
            math.floor(pose.heading / TURN),
        )
        asked = " ".join(query.lower().split())
        text = repr((self._seed, what, place, asked, key))
        digest = hashlib.blake2b(
            text.encode("utf-8", "backslashreplace"), digest_size=8
        )
        return int.from_bytes(digest.digest(), "big")


def _key(thing: VisibleObject) -> str:
    x, y = thing.position
    return f"{thing.description.category} {x:.2f} {y:.2f}"


def _shifted(probability: float, log_odds: float) -> float:
    """Return a probability with its log-odds changed; 0 and 1 stay."""
    if probability in (0.0, 1.0):
        return float(probability)
    return 1 / (1 + math.exp(-(math.log(probability / (1 - probability)) + log_odds)))


def _phantom(rng: np.random.Generator, range_limit: float) -> Phantom:
    distance = float(rng.uniform(min(NEAREST_PHANTOM, range_limit), range_limit))
    focal = WIDTH / 2
    side = float(rng.uniform(*PHANTOM_SIZE)) * focal / distance
    u, v = float(rng.uniform(0, WIDTH)), float(rng.uniform(0, HEIGHT))
    box = (
        max(u - side / 2, 0.0),
        max(v - side / 2, 0.0),
        min(u + side / 2, float(WIDTH)),
        min(v + side / 2, float(HEIGHT)),
    )
    return Phantom(box, distance, box_bearing(box, WIDTH), float(rng.uniform(0.5, 0.8)))
